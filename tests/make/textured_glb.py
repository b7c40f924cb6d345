"""textured_glb.py IMAGE.png OUT.glb: writes a square with this picture as its base colour."""
import json
import struct
import sys

points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
parts = [
    b"".join(struct.pack("<3f", *point) for point in points),
    b"".join(struct.pack("<2f", x, 1 - y) for x, y, _ in points),
    struct.pack("<6I", 0, 1, 2, 0, 2, 3),
    open(sys.argv[1], "rb").read(),
]
parts = [part + bytes(-len(part) % 4) for part in parts]
starts = [sum(map(len, parts[:i])) for i in range(len(parts))]
tree = {
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0}], "images": [{"bufferView": 3, "mimeType": "image/png"}],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
        {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
        {"bufferView": 2, "componentType": 5125, "count": 6, "type": "SCALAR"},
    ],
    "bufferViews": [{"buffer": 0, "byteOffset": start, "byteLength": len(part)} for start, part in zip(starts, parts)],
    "buffers": [{"byteLength": sum(map(len, parts))}],
}
head = json.dumps(tree).encode()
head += b" " * (-len(head) % 4)
body = struct.pack("<I4s", len(head), b"JSON") + head + struct.pack("<I4s", sum(map(len, parts)), b"BIN\0") + b"".join(parts)
open(sys.argv[2], "wb").write(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)
