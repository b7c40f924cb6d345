"""Compares the loading of one mesh as GLB, PLY and STL with other programs, in turn.

    loading.py BUILD MESH.obj     prints rows like those of compare.py; make bench-rivals runs it

Pictures: zraster and F3D write 512x512 pixels, one process per picture. Facts: zraster info is one process per file,
and also measures areas and volumes. The loaders of three, trimesh and meshio (tests/reference/loaders) count triangles
and measure bounds in one process that is kept.
"""
import array
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile

import compare

LOADERS = os.path.join(compare.here, "..", "..", "reference", "loaders")
TYPES = ("glb", "ply", "stl")


def mesh_of(path):
    """Returns the positions of an OBJ file as a flat array of floats, and the corners of its triangles."""
    points, corners = array.array("f"), array.array("I")
    with open(path, encoding="latin-1") as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                points.extend(map(float, words[1:4]))
            elif words[:1] == ["f"]:
                face = [int(word.split("/")[0]) - 1 for word in words[1:]]
                for i in range(2, len(face)):
                    corners.extend((face[0], face[i - 1], face[i]))
    return points, corners


def write_ply(file, points, corners):
    file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
               b"property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n" %
               (len(points) // 3, len(corners) // 3) + points.tobytes())
    for i in range(0, len(corners), 3):
        file.write(struct.pack("<B3i", 3, *corners[i:i + 3]))


def write_stl(file, points, corners):
    file.write(bytes(80) + struct.pack("<I", len(corners) // 3))
    for i in range(0, len(corners), 3):
        file.write(struct.pack("<12fH", 0, 0, 0, *(x for k in corners[i:i + 3] for x in points[3 * k:3 * k + 3]), 0))


def write_glb(file, points, corners):
    body = points.tobytes() + corners.tobytes()
    split, bounds = 4 * len(points), [[least(points[k::3]) for k in range(3)] for least in (min, max)]
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": split},
             {"buffer": 0, "byteOffset": split, "byteLength": len(body) - split}]
    accessors = [{"bufferView": 0, "componentType": 5126, "count": len(points) // 3, "type": "VEC3", "min": bounds[0],
                  "max": bounds[1]},
                 {"bufferView": 1, "componentType": 5125, "count": len(corners), "type": "SCALAR"}]
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "accessors": accessors,
        "bufferViews": views, "buffers": [{"byteLength": len(body)}]}).encode()
    text += b" " * (-len(text) % 4)
    file.write(struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(body), len(text), 0x4e4f534a) + text)
    file.write(struct.pack("<II", len(body), 0x004e4942) + body)


class Kept:
    """A process that prints a line of facts for each name on its input."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True)

    def facts(self, path):
        self.process.stdin.write(path + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline() or '{"error": "it ended"}')

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def command(*words):
    return subprocess.run([f"{compare.build}/zraster", *words], check=True, capture_output=True).stdout


def info_of(path):
    return json.loads(command("info", path, "--json", "--render", "false"))


def rounds(name, ours, theirs, must, note):
    for _ in range(2):
        ours()
        theirs()
    pairs = [(compare.timed(ours), compare.timed(theirs)) for _ in range(compare.ROUNDS)]
    compare.row(name, *zip(*pairs), must, note)


def compare_pictures(files, folder):
    if not shutil.which("f3d"):
        print("LEFT OUT: F3D is not installed", file=sys.stderr)
        return
    for path in files:
        rounds(f"{os.path.basename(path)} to a picture, F3D",
               lambda: command("render", path, "-o", f"{folder}/ours.png", "-s", "512"),
               lambda: compare.f3d_round(folder, path), 2, "one process each; studio, --ssao --fxaa --tone-mapping")


def compare_facts(files):
    loaders = {"three in Node": (TYPES, ["node", f"{LOADERS}/three.mjs", f"{compare.build}/loaders/node_modules"]),
               "trimesh": (TYPES, [sys.executable, f"{LOADERS}/read.py", "trimesh"]),
               "meshio": (("ply",), [sys.executable, f"{LOADERS}/read.py", "meshio"])}
    for name, (types, words) in loaders.items():
        kept = Kept(words)
        for path in (path for path in files if path.endswith(types)):
            title, triangles = os.path.basename(path), sum(part["triangles"] for part in info_of(path)["parts"])
            theirs = kept.facts(path)
            if theirs.get("triangles") != triangles:
                print(f"LEFT OUT: {title}, {name}: {theirs.get('error', 'other triangles')}", file=sys.stderr)
                break
            rounds(f"{title}: facts, {name}", lambda: info_of(path), lambda: kept.facts(path), 0.5,
                   "ours: one process per file, with volumes; theirs: one process")
        kept.close()


def main():
    with tempfile.TemporaryDirectory() as folder:
        mesh, files = mesh_of(compare.mesh), [f"{folder}/mesh.{kind}" for kind in TYPES]
        for path, write in zip(files, (write_glb, write_ply, write_stl)):
            with open(path, "wb") as file:
                write(file, *mesh)
        print(f"{'loading':<40}{'ours ms':>9}{'theirs ms':>10}{'ratio':>9}{'must':>7}")
        compare_pictures(files, folder)
        compare_facts(files)


if __name__ == "__main__":
    main()
