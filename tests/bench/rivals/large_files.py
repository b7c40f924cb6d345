"""Files of any number of triangles or points, for bench-large: a bumpy ball as STL, GLB, PLY and OBJ, and a cloud of its
points in random order as PLY. All arrays are written in parts."""
import json
import os
import struct

import numpy as np

ROWS_AT_ONCE = 64


def sides(triangles):
    """Rows and columns of a grid of at least that many triangles."""
    rows = max(int((triangles / 4) ** 0.5), 2)
    return rows, -(-triangles // (2 * rows))


def places(rows, columns, first, count):
    """Positions of the vertices in rows first .. first + count - 1, each of columns + 1."""
    v = np.arange(first, first + count, dtype=np.float64)[:, None] / rows * np.pi
    u = np.arange(columns + 1, dtype=np.float64)[None, :] % columns / columns * 2 * np.pi
    radius = 1 + 0.05 * np.sin(9 * u) * np.sin(7 * v) + 0.004 * np.sin(61 * u + 3 * v) * np.sin(53 * v)
    return np.stack([radius * np.sin(v) * np.cos(u), radius * np.sin(v) * np.sin(u), radius * np.cos(v) + 0 * u], axis=2).astype(np.float32)


def faces(columns, first, count):
    """Corners of the triangles between rows first .. first + count, as numbers of vertices."""
    at = (np.arange(first, first + count, dtype=np.int64)[:, None] * (columns + 1) + np.arange(columns)[None, :]).ravel()
    below = at + columns + 1
    return np.stack([at, below, at + 1, at + 1, below, below + 1], axis=1).reshape(-1, 3).astype(np.uint32)


def parts(rows):
    return [(first, min(ROWS_AT_ONCE, rows - first)) for first in range(0, rows, ROWS_AT_ONCE)]


def write_stl(path, triangles):
    rows, columns = sides(triangles)
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", 2 * rows * columns))
        for first, count in parts(rows):
            at = places(rows, columns, first, count + 1).reshape(-1, 3)
            block = np.zeros(2 * count * columns, dtype=[("normal", "<f4", 3), ("at", "<f4", (3, 3)), ("word", "<u2")])
            block["at"] = at[faces(columns, 0, count)]
            file.write(block.tobytes())


def write_ply(path, triangles):
    rows, columns = sides(triangles)
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                   b"element face %d\nproperty list uchar int vertex_indices\nend_header\n" % ((rows + 1) * (columns + 1), 2 * rows * columns))
        for first, count in parts(rows + 1):
            file.write(places(rows, columns, first, count).tobytes())
        for first, count in parts(rows):
            block = np.zeros(2 * count * columns, dtype=[("count", "u1"), ("at", "<i4", 3)])
            block["count"] = 3
            block["at"] = faces(columns, first, count)
            file.write(block.tobytes())


def write_glb(path, triangles):
    rows, columns = sides(triangles)
    vertices, count = (rows + 1) * (columns + 1), 6 * rows * columns
    size = 12 * vertices + 4 * count
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3", "min": [-2, -2, -2], "max": [2, 2, 2]},
                      {"bufferView": 1, "componentType": 5125, "count": count, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 12 * vertices}, {"buffer": 0, "byteOffset": 12 * vertices, "byteLength": 4 * count}],
        "buffers": [{"byteLength": size}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<IIIII", 0x46546C67, 2, 28 + len(text) + size, len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", size, 0x004E4942))
        for first, some in parts(rows + 1):
            file.write(places(rows, columns, first, some).tobytes())
        for first, some in parts(rows):
            file.write(faces(columns, first, some).tobytes())


def write_obj(path, triangles):
    rows, columns = sides(triangles)
    with open(path, "w") as file:
        for first, count in parts(rows + 1):
            file.write("".join("v %.6g %.6g %.6g\n" % tuple(p) for p in places(rows, columns, first, count).reshape(-1, 3).tolist()))
        for first, count in parts(rows):
            file.write("".join("f %d %d %d\n" % tuple(f) for f in (faces(columns, first, count) + 1).tolist()))


def write_cloud(path, points):
    """Random places on the ball and within it, with colours, in random order."""
    random = np.random.default_rng(1)
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                   b"property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n" % points)
        for first in range(0, points, 1 << 20):
            count = min(1 << 20, points - first)
            way = random.normal(size=(count, 3))
            at = way / np.linalg.norm(way, axis=1)[:, None] * (1 + 0.05 * np.sin(9 * way[:, :1]) * np.sin(7 * way[:, 1:2]))
            block = np.zeros(count, dtype=[("at", "<f4", 3), ("color", "u1", 3)])
            block["at"] = at
            block["color"] = np.clip(127 + 127 * at, 0, 255)
            file.write(block.tobytes())


WRITERS = {"stl": write_stl, "ply": write_ply, "glb": write_glb, "obj": write_obj, "cloud": write_cloud}


def path_of(folder, kind, count):
    """Writes the file unless it is there. Returns its path."""
    path = os.path.join(folder, f"{count}-{kind}.{'ply' if kind == 'cloud' else kind}")
    if not os.path.exists(path):
        os.makedirs(folder, exist_ok=True)
        WRITERS[kind](path + ".part", count)
        os.rename(path + ".part", path)
    return path
