"""solids.py ZRASTER BUNNY.obj ROUNDS: least processor time of the bunny minus three spheres beside the bunny alone, in studio at 512 x 512, and of its
features beside its facts without them. Processes in turns. The bunny's open loops are closed by fans."""
import json
import os
import subprocess
import sys
import tempfile

program, path, rounds = sys.argv[1], sys.argv[2], int(sys.argv[3])


def read(name):
    positions, faces = [], []
    with open(name) as lines:
        for words in map(str.split, lines):
            if words[:1] == ["v"]:
                positions.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return positions, faces


def close(positions, faces):
    edges = {(face[k], face[(k + 1) % len(face)]) for face in faces for k in range(len(face))}
    after = {b: a for a, b in edges if (b, a) not in edges}
    while after:
        loop = [next(iter(after))]
        while after[loop[-1]] != loop[0]:
            loop.append(after[loop[-1]])
        positions.append([sum(positions[i][k] for i in loop) / len(loop) for k in range(3)])
        faces += [[loop[k], loop[(k + 1) % len(loop)], len(positions) - 1] for k in range(len(loop))]
        for corner in loop:
            del after[corner]


def processor_ms(*words):
    child = subprocess.Popen([program, *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    fault = child.stderr.read().decode()
    _, status, usage = os.wait4(child.pid, 0)
    if status:
        sys.exit(f"{' '.join(words)}: {fault}")
    return 1000 * (usage.ru_utime + usage.ru_stime)


positions, faces = read(path)
close(positions, faces)
low, high = ([f(p[k] for p in positions) for k in range(3)] for f in (min, max))
size = max(high[k] - low[k] for k in range(3))
bunny = {"name": "bunny", "positions": positions, "faces": faces}
scene = {"look": "studio", "window": {"width": 512, "height": 512}, "meshes": [bunny], "nodes": [{"mesh": "bunny"}]}
spheres = [{"name": f"s{i}", "mesh": "sphere", "translation": [low[k] + share[k] * (high[k] - low[k]) for k in range(3)]}
           for i, share in enumerate([(0.3, 0.8, 0.6), (0.6, 0.4, 0.8), (0.4, 0.3, 0.7)])]
cut = {**scene, "meshes": [bunny, {"name": "sphere", "shape": {"type": "sphere", "radius": 0.15 * size}}],
       "nodes": scene["nodes"] + spheres, "csg": {"difference": ["bunny", "s0", "s1", "s2"]}}
with tempfile.TemporaryDirectory() as folder:
    for name, text in (("bunny", scene), ("cut", cut)):
        with open(f"{folder}/{name}.json", "w") as file:
            json.dump(text, file)
    works = {
        "bunny": (f"{folder}/bunny.json", f"{folder}/a.png", "-j", "1"),
        "bunny minus three spheres": (f"{folder}/cut.json", f"{folder}/b.png", "-j", "1"),
        "facts of the bunny": (path, "-c", "info", "-o", f"{folder}/a.json", "-j", "1"),
        "facts and features": (path, "-c", "info", "--features", "true", "-o", f"{folder}/b.json", "-j", "1"),
    }
    least = dict.fromkeys(works, float("inf"))
    for _ in range(rounds):
        for name, words in works.items():
            least[name] = min(least[name], processor_ms(*words))
for name, ms in least.items():
    print(f"{name:28}{ms:8.0f} ms")
print(f"solid beside bunny: {least['bunny minus three spheres'] / least['bunny']:.2f} (3); "
      f"features: {least['facts and features'] - least['facts of the bunny']:.0f} ms (150)")
