"""hostile.py FOLDER: writes scenes whose time is hard to predict, for tests/bench/alone/costs (make bench-costs-hostile).

Most are usual ones with one thing in plenty: faces, lights, channels, sections, parts. Those named hostile have faces
that cut one another, needles, nested boxes, polygons of many corners, many layers."""
import json
import math
import os
import random
import sys

folder = sys.argv[1]
os.makedirs(folder, exist_ok=True)
rng = random.Random(55)


def triangles(count, size, flat=False):
    positions, indices = [], []
    for i in range(count):
        at = [rng.uniform(-1, 1) for _ in range(3)]
        for _ in range(3):
            positions.append([round(x + rng.uniform(-size, size) * (k < 2 or not flat), 4) for k, x in enumerate(at)])
        indices.append([3 * i, 3 * i + 1, 3 * i + 2])
    return {"positions": positions, "faces": indices}


def grid(side, height=0.1):
    positions = [[x / side, y / side, round(height * math.sin(7 * x / side) * math.cos(5 * y / side), 5)]
                 for y in range(side + 1) for x in range(side + 1)]
    at = lambda x, y: y * (side + 1) + x
    indices = [face for y in range(side) for x in range(side)
               for face in ([at(x, y), at(x + 1, y), at(x + 1, y + 1)], [at(x, y), at(x + 1, y + 1), at(x, y + 1)])]
    return {"positions": positions, "faces": indices}


BOX = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6],
       [1, 3, 5], [3, 7, 5]]


def boxes(list_of_boxes):
    """Boxes (low, high) of one mesh."""
    positions, indices = [], []
    for low, high in list_of_boxes:
        first = len(positions)
        positions += [[(high if k >> axis & 1 else low)[axis] for axis in range(3)] for k in range(8)]
        indices += [[first + corner for corner in face] for face in BOX]
    return {"positions": positions, "faces": indices}


def nested(count):
    return boxes([([-1 - i / count] * 3, [1 + i / count] * 3) for i in range(count)])


def needles(count):
    return boxes([([x, y, -1], [x + 1e-3, y + 1e-3, 1]) for x, y in
                  ((rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(count))])


def plates(count):
    return boxes([([-1, -1, z], [1, 1, z + 1e-3]) if i % 2 else ([z, -1, -1], [z + 1e-3, 1, 1])
                  for i, z in ((i, rng.uniform(-1, 1)) for i in range(count))])


def overlapping(at):
    return boxes([([at, 0, 0], [at + 1, 1, 1]), ([at + 0.5, 0.5, 0.5], [at + 1.5, 1.5, 1.5])])


def star(corners):
    return {"polygons": [{"vertices": [[round((1 + i % 2) * math.cos(2 * math.pi * i / corners), 5),
                                        round((1 + i % 2) * math.sin(2 * math.pi * i / corners), 5), 0]
                                       for i in range(corners)]}]}


written = 0


def write(kind, mesh, width=320, height=240, **keys):
    global written
    scene = {"window": {"width": width, "height": height}, "view": {"preset": "isometric"}}
    scene.update({"meshes": [mesh]} if "positions" in mesh else mesh)
    scene.update(keys)
    written += 1
    with open(os.path.join(folder, f"{kind}-{written:03d}.json"), "w") as out:
        json.dump(scene, out)


INFO = {"outputs": [{"channel": "info"}]}
SVG = {"outputs": [{"channel": "color", "encoding": "svg"}]}
LOOKS = ["textbook", "studio", "technical", "blueprint", "metal", "clay"]
CHANNELS = ["depth", "position", "normals", "faceId", "barycentrics", "layers", "distance", "thickness"]

for side in (10, 40, 100):
    for look in LOOKS:
        for width in (64, 640, 1280):
            write("grid", grid(side), width, 3 * width // 4, look=look)
for count in (100, 1000, 5000):
    for channel in CHANNELS:
        write("channel", triangles(count, 0.1), outputs=[{"channel": channel}])
for algorithm in ("halfspace", "edgelist", "trapezoid", "scanline", "painter"):
    for count in (50, 500):
        write("algorithm", triangles(count, 0.1), algorithm=algorithm)
for count in (1, 8, 64):
    lights = [{"type": "point", "position": [i % 5, 2, 3], "intensity": 1} for i in range(count)]
    write("lights", grid(40), look="studio", lights=lights)
    write("shadows", grid(40), look="studio",
          lights=[{"type": "directional", "direction": [0.1 * i - 0.3, -1, -1], "shadows": True}
                  for i in range(min(count, 8))])
for side in (10, 60, 120):
    write("sections", grid(side), sections={"planes": [{"axis": "x", "fraction": 0.5}]})
    write("info", grid(side), **INFO)
    write("svg", grid(side), look="technical", **SVG)
    write("parts", boxes([([i, 0, 0], [i + 0.9, 1, 1]) for i in range(side)]), **INFO)

for count in (50, 100, 200, 400, 700):
    write("hostile-painter", triangles(count, 0.5), 200, 150, algorithm="painter")
for size in (0.3, 1.0):
    for count in (250, 500, 1000, 2000):
        write("hostile-lines", triangles(count, size), 512, 512, look="technical")
        write("hostile-svg", triangles(count, size), 512, 512, look="technical", **SVG)
for count in (200, 2000, 8000):
    write("hostile-nested", nested(count), **INFO)
    write("hostile-needles", needles(count), **INFO)
    write("hostile-plates", plates(count), **INFO)
for count in (10, 50):
    write("hostile-nested-parts", {"meshes": [dict(nested(count), name=f"part {i}") for i in range(100)]}, **INFO)
for count in (1, 30, 1000):
    write("hostile-overlaps", {"meshes": [dict(overlapping(i), name=f"part {i}") for i in range(count)]}, **INFO)
for corners in (200, 1000):
    write("hostile-star", star(corners), 1280, 960)
    write("hostile-star-lines", star(corners), look="technical")
for count in (500, 2000):
    write("hostile-layers", dict(triangles(count, 1.0), material="glass"), 640, 480,
          materials=[{"name": "glass", "baseColorFactor": [1, 0, 0, 0.5], "alphaMode": "BLEND"}])
    write("hostile-needle-lines", needles(count), look="technical")
    write("hostile-all-layers", triangles(count, 1.0), outputs=[{"channel": "layers"}])
print(written, "scenes")
