"""support.py: paths, meshes and a daemon for the tests of the Python package."""
import os
import re
import struct
import unittest
import urllib.request

import daemon

try:
    import numpy
except ImportError:
    numpy = None

here = os.path.dirname(os.path.abspath(__file__))
root = os.path.normpath(os.path.join(here, "../.."))
build = daemon.build
models = os.path.join(os.environ.get("ZRASTER_DATA", os.path.join(root, "../shared/data")), "models")
scenes = os.path.join(root, "tests/scenes")
needs_numpy = unittest.skipUnless(numpy, "there is no numpy (python3-numpy)")

LOOKS = ["studio", "technical", "clay", "dark", "metal", "outdoor", "blueprint", "xray", "textbook"]
OBJ = b"v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3 4\n"
SCENE = {
    "window": {"width": 60, "height": 40},
    "meshes": [
        {"name": "low", "positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]]},
        {"name": "high", "positions": [[0, 0, 1], [1, 0, 1], [1, 1, 1]], "faces": [[0, 1, 2]]},
    ],
    "nodes": [{"name": "a", "mesh": "low"}, {"name": "b", "mesh": "high"}],
}


def read(path):
    with open(path, "rb") as file:
        return file.read()


def stl(side=8):
    """Returns a binary STL of 2 side² triangles: a bumpy sheet."""
    height = lambda x, y: ((x * 7 + y * 3) % 5) * 0.2
    corners = []
    for x in range(side):
        for y in range(side):
            a, b, c, d = [(i, j, height(i, j)) for i, j in ((x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1))]
            corners += [(a, b, c), (a, c, d)]
    body = b"".join(struct.pack("<3f9fH", 0, 0, 1, *p, *q, *r, 0) for p, q, r in corners)
    return bytes(80) + struct.pack("<I", len(corners)) + body


def slow():
    """Returns a scene whose drawing takes some 10 s: 60 bumpy sheets above each other."""
    heights = [[((x * 7 + y * 3) % 5) * 0.2 for x in range(20)] for y in range(20)]
    nodes = [{"mesh": "sheet", "translation": [0, 0, i * 0.01]} for i in range(60)]
    scene = {"samples": 16, "window": {"width": 2000, "height": 2000}}
    return {**scene, "view": {"preset": "top"}, "meshes": [{"name": "sheet", "heights": heights}], "nodes": nodes}


class Daemon(daemon.Daemon):
    """A daemon on a free port, until a `with` ends."""

    def __enter__(self):
        return self

    def post(self, body, query="", type_="application/octet-stream"):
        request = urllib.request.Request(f"{self.address}/v1/render?{query}", body, {"Content-Type": type_})
        with urllib.request.urlopen(request) as answer:
            return answer.read()

    def __exit__(self, *_):
        self.stop()


def rss_kb():
    """Returns the resident memory of this process."""
    with open("/proc/self/status") as file:
        return int(re.search(r"VmRSS:\s+(\d+)", file.read()).group(1))
