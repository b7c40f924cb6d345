"""mcp.py BUILD ROUNDS MODEL...: the time of a call of /mcp beside that of /v1/render with the same scene, in turns: the least of each, and
the median of the daemon's processor time, which other programs hardly change. The last model is also drawn as a GLB. Ends with 1 if that time
is more than 1.1 times as much and 1 ms."""
import base64
import glob
import http.client
import json
import os
import re
import statistics
import struct
import subprocess
import sys
import time

build, rounds, models = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
outputs = [{"channel": "color", "encoding": "png"}, {"channel": "info"}]


def as_glb(text):
    """Returns the triangles of an OBJ as a GLB."""
    corners, triangles = [], []
    for words in map(bytes.split, text.splitlines()):
        if words[:1] == [b"v"]:
            corners.append([float(word) for word in words[1:4]])
        elif words[:1] == [b"f"]:
            face = [int(word.split(b"/")[0]) - 1 for word in words[1:]]
            triangles += [(face[0], a, b) for a, b in zip(face[1:], face[2:])]
    places = b"".join(struct.pack("<3f", *corner) for corner in corners)
    indices = b"".join(struct.pack("<3I", *triangle) for triangle in triangles)
    ends = [[pick(corner[axis] for corner in corners) for axis in range(3)] for pick in (min, max)]
    tree = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(corners), "type": "VEC3", "min": ends[0], "max": ends[1]},
            {"bufferView": 1, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": len(places)}, {"buffer": 0, "byteOffset": len(places), "byteLength": len(indices)}],
        "buffers": [{"byteLength": len(places) + len(indices)}],
    }
    head = json.dumps(tree).encode()
    head += b" " * (-len(head) % 4)
    chunks = struct.pack("<I4s", len(head), b"JSON") + head + struct.pack("<I4s", len(places) + len(indices), b"BIN\0") + places + indices
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def bodies(model, views):
    """Returns the two requests for a picture: path, headers, body."""
    scene = {
        "outputs": outputs, "meshes": [{"asset": "model"}], "window": {"width": 640, "height": 480}, "look": "studio", "up": "y",
        "view": {"preset": "isometric", "orthographic": {}}, **({"views": views} if views else {"sheet": "balanced", "window": {"width": 1024, "height": 768}}),
    }
    parts = b"".join(b'--b\r\nContent-Disposition: form-data; name="%s"\r\n\r\n%s\r\n' % part for part in ((b"scene", json.dumps(scene).encode()), (b"model", model)))
    arguments = {"model": {"base64": base64.b64encode(model).decode()}, **({"views": views, "width": 640, "height": 480} if views else {})}
    call = {"jsonrpc": "2.0", "id": 1, "method": "tools/call", "params": {"name": "render", "arguments": arguments}}
    return (
        ("/v1/render", {"Content-Type": "multipart/form-data; boundary=b"}, parts + b"--b--\r\n"),
        ("/mcp", {"Content-Type": "application/json"}, json.dumps(call).encode()),
    )


daemon = subprocess.Popen([os.path.join(build, "zrasterd"), "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
bad = 0
try:
    host = re.search(r"http://(\S+)", daemon.stdout.readline()).group(1)
    connection = http.client.HTTPConnection(host)

    def spent():
        """Returns the processor time of the daemon's threads, in ms."""
        total = 0
        for path in glob.glob(f"/proc/{daemon.pid}/task/*/schedstat"):
            with open(path) as file:
                total += int(file.read().split()[0])
        return total / 1e6

    def run(path, headers, body):
        before, began = spent(), time.perf_counter()
        connection.request("POST", path, body, headers)
        answer = connection.getresponse()
        data = answer.read()
        assert answer.status == 200 and b'"isError":true' not in data, data[:500]
        return 1000 * (time.perf_counter() - began), spent() - before

    print(f"{'model':20} {'views':>6} | least time: {'/v1/render':>10} {'/mcp':>9} | processor: {'/v1/render':>10} {'/mcp':>9}  of 1.1 x + 1 ms")
    files = []
    for path in models:
        with open(path, "rb") as file:
            files.append((os.path.basename(path), file.read()))
    files.append((files[-1][0].replace(".obj", ".glb"), as_glb(files[-1][1])))
    for name, model in files:
        for views in (None, ["front"], ["front", "top"]):
            plain, call = bodies(model, views)
            for _ in range(5):
                run(*plain), run(*call)
            pairs = [(run(*plain), run(*call)) for _ in range(rounds)]
            least = [min(pair[k][0] for pair in pairs) for k in (0, 1)]
            work = [statistics.median(pair[k][1] for pair in pairs) for k in (0, 1)]
            share = work[1] / (1.1 * work[0] + 1)
            bad += share > 1
            print(f"{name:20} {len(views) if views else 'sheet':>6} | {least[0]:20.2f} ms {least[1]:6.2f} ms | {work[0]:18.2f} ms {work[1]:6.2f} ms  {share:.2f}")
finally:
    daemon.terminate()
    daemon.wait()
sys.exit(bad > 0)
