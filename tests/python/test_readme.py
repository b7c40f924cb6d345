"""The expressions of clients/python/README.md, run in its order. tests/clients/test_docs.sh runs its blocks."""
import ast
import os
import re
import struct
import tempfile
import unittest
import warnings

import zraster
from support import SCENE, needs_numpy, numpy, read, root

PAGE = os.path.join(root, "clients/python/README.md")
FEWER = {"1000": "2", "orbit(100)": "orbit(3)", "(36)": "(3)"}  # views that the page draws, and those drawn here
TRIANGLES = (((0, 0, 0), (0, 1, 0), (1, 0, 0)), ((0, 0, 0), (1, 0, 0), (0, 0, 1)), ((0, 0, 0), (0, 0, 1), (0, 1, 0)), ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
WITHOUT = {"zraster.trimesh.save_image(scene, (640, 480))", "zraster.mujoco.Renderer(model)"}  # scenes of others


def expressions():
    """Yields the inline code that is an expression with a name and a call or an index, such as `scene.orbit(100)`."""
    text = re.sub(r"```.*?```", "", read(PAGE).decode(), flags=re.S)
    for code in re.findall(r"`([^`]+)`", text):
        try:
            tree = ast.parse(code.replace("...", '"front"'), mode="eval").body
        except SyntaxError:
            continue
        if isinstance(tree, (ast.Call, ast.Subscript)) and code not in WITHOUT and not code.startswith("help("):
            yield code


@needs_numpy
class Readme(unittest.TestCase):
    def test_expressions(self):
        """each expression of the page runs, in a folder of its own"""
        scene = zraster.Scene({**SCENE, "nodes": [{"name": "cup", "mesh": "low"}, {"name": "b", "mesh": "high"}]})
        picture = scene.render(["color", "depth", {"channel": "masks", "encoding": "zip"}])
        names = {"zraster": zraster, "scene": scene, "picture": picture, "views": scene.views(["front"], ["color", "depth"])}
        names.update({name: getattr(zraster, name) for name in zraster.__all__})
        before, count = os.getcwd(), 0
        with tempfile.TemporaryDirectory() as folder:
            try:
                os.chdir(folder)
                for name in ("a.stl", "b.stl", "part.stl"):
                    with open(name, "wb") as file:
                        file.write(bytes(80) + struct.pack("<I", len(TRIANGLES)))
                        for corners in TRIANGLES:
                            file.write(struct.pack("<12fH", 0, 0, 0, *(number for corner in corners for number in corner), 0))
                for code in expressions():
                    for given, fewer in FEWER.items():
                        code = code.replace(given, fewer)
                    with self.subTest(code), warnings.catch_warnings():
                        warnings.simplefilter("ignore")
                        eval(code.replace("...", ""), dict(names))
                        count += 1
                self.assertTrue(os.path.exists("cups/train_pbr/000000/scene_gt.json"))
            finally:
                os.chdir(before)
        self.assertGreater(count, 8)
        self.assertIsInstance(names["views"]["depth"], numpy.ndarray)
