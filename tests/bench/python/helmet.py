"""helmet.py FILE.glb: writes a model like DamagedHelmet of Khronos' samples: a closed surface of 15 552 triangles in
six charts, with five textures of 2048 x 2048 texels. `make bench-looks` draws it.
"""
import json
import os
import struct
import sys
import zlib

import numpy

SIDE, CELLS = 2048, 36
TEXTURES = ("base", "metals", "normals", "occlusion", "emission")


def cloud(random):
    """Smooth noise of three sizes, 0 .. 255."""
    total = numpy.zeros((SIDE, SIDE))
    for cell, weight in ((128, 0.5), (16, 0.3), (2, 0.2)):
        lattice = random.random((SIDE // cell, SIDE // cell))
        total += weight * numpy.kron(lattice, numpy.ones((cell, cell)))
    return (255 * total).astype(numpy.uint8)


def picture(random, name):
    texels = numpy.stack([cloud(random) for _ in range(3)], axis=-1)
    if name == "normals":
        texels = 96 + texels // 4
        texels[..., 2] = 255
    if name == "emission":
        texels[texels < 192] = 0
    return png(texels.astype(numpy.uint8))


def png(texels):
    def block(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    rows = numpy.concatenate([numpy.zeros((SIDE, 1), numpy.uint8), texels.reshape(SIDE, -1)], axis=1)
    head = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 2, 0, 0, 0)
    blocks = [(b"IHDR", head), (b"IDAT", zlib.compress(rows.tobytes(), 1)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(block(kind, body) for kind, body in blocks)


def chart(side):
    """A face of a cube, bent to a dented ball: points, normals, texcoords, triangles."""
    u, v = (axis.ravel() for axis in numpy.meshgrid(*2 * [numpy.linspace(-1, 1, CELLS + 1)]))
    across = numpy.stack([numpy.ones_like(u), numpy.tan(u * numpy.pi / 4), numpy.tan(v * numpy.pi / 4)], axis=-1)
    across *= (1, 1, 1) if side % 2 == 0 else (-1, 1, -1)
    normals = numpy.roll(across / numpy.linalg.norm(across, axis=-1, keepdims=True), side // 2, axis=-1)
    points = normals * (1 + 0.05 * numpy.sin(normals * 9).prod(axis=-1, keepdims=True))
    texcoords = numpy.stack([(side % 3 + 0.02 + 0.48 * (1 + u)) / 3, (side // 3 + 0.02 + 0.48 * (1 + v)) / 2], axis=-1)
    first = (numpy.arange(CELLS)[:, None] * (CELLS + 1) + numpy.arange(CELLS)).ravel()
    triangles = [[first, first + 1, first + CELLS + 2], [first, first + CELLS + 2, first + CELLS + 1]]
    return points, normals, texcoords, numpy.transpose(triangles, (2, 0, 1)).reshape(-1, 3)


def arrays():
    charts = [chart(side) for side in range(6)]
    points, normals, texcoords = (numpy.concatenate([c[i] for c in charts]).astype("<f4") for i in range(3))
    triangles = numpy.concatenate([c[3] + i * (CELLS + 1) ** 2 for i, c in enumerate(charts)]).astype("<u4")
    return points, normals, texcoords, triangles.ravel()


def document(parts, meshes):
    views, offset = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(part)})
        offset += len(part)
    points = meshes[0]
    kinds = ((5126, "VEC3"), (5126, "VEC3"), (5126, "VEC2"), (5125, "SCALAR"))
    accessors = [{"bufferView": i, "componentType": kind[0], "count": len(array), "type": kind[1]}
                 for i, (kind, array) in enumerate(zip(kinds, meshes))]
    accessors[0].update(min=points.min(axis=0).tolist(), max=points.max(axis=0).tolist())
    at = {name: {"index": i} for i, name in enumerate(TEXTURES)}
    material = {"pbrMetallicRoughness": {"baseColorTexture": at["base"], "metallicRoughnessTexture": at["metals"]},
                "normalTexture": at["normals"], "occlusionTexture": at["occlusion"],
                "emissiveTexture": at["emission"], "emissiveFactor": [1, 1, 1]}
    primitive = {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}
    return {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0, "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [primitive]}], "materials": [material],
            "textures": [{"source": i, "sampler": 0} for i in range(len(TEXTURES))],
            "samplers": [{"magFilter": 9729, "minFilter": 9987}],
            "images": [{"bufferView": len(meshes) + i, "mimeType": "image/png"} for i in range(len(TEXTURES))],
            "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": offset}]}


def chunk(kind, body, filler):
    body += filler * (-len(body) % 4)
    return struct.pack("<I4s", len(body), kind) + body


def main(path):
    random = numpy.random.default_rng(1)
    meshes = arrays()
    parts = [array.tobytes() for array in meshes] + [picture(random, name) for name in TEXTURES]
    parts = [part + bytes(-len(part) % 4) for part in parts]
    text = json.dumps(document(parts, meshes)).encode()
    chunks = chunk(b"JSON", text, b" ") + chunk(b"BIN\0", b"".join(parts), b"\0")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


if __name__ == "__main__":
    main(sys.argv[1])
