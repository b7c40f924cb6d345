"""Several views of a scene: sequences of pictures, arrays, animations, sheets."""
import json
import os
import tempfile
import unittest
import warnings

import support
import zraster
from support import OBJ, SCENE, needs_numpy, numpy

FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
SOLID = {
    "window": {"width": 200, "height": 150},
    "meshes": [
        {"name": "low", "positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": FACES},
        {"name": "high", "positions": [[0, 0, 1], [2, 0, 1], [0, 1, 1], [0, 0, 2]], "faces": FACES},
    ],
    "nodes": SCENE["nodes"],
}
PLAIN = {key: value for key, value in SOLID.items() if key != "nodes"}
SOURCES = {"dict": SOLID, "json": json.dumps(PLAIN).encode(), "mesh": OBJ + b"v 0 0 3\nf 1 2 5\nf 2 3 5\n"}


@needs_numpy
class Views(unittest.TestCase):
    def test_equal(self):
        """a view has the pixels of a picture for it alone, in each channel"""
        for name, source in SOURCES.items():
            scene = zraster.Scene(source, size=(120, 90))
            look = {"look": "clay"} if name == "mesh" else {}  # in scenes, presets keep its projection
            views = scene.views(["front", "top"], ["color", "depth", "faceId", "info"], **look)
            self.assertEqual((len(views), views.names), (2, ["front", "top"]))
            for side, picture in zip(views.names, views):
                alone = scene.render(["color", "depth", "faceId", "info"], preset=side, **look)
                with self.subTest(name, view=side):
                    self.assertEqual(list(picture), ["color", "depth", "faceId", "info"])
                    for channel in ("color", "depth", "faceId"):
                        numpy.testing.assert_array_equal(picture[channel], alone[channel])
                    self.assertEqual(picture.info["camera"], alone.info["camera"])
            self.assertEqual(views["depth"].shape, (2, 90, 120))
            self.assertEqual(views["color"].shape, (2, 90, 120, 3))
            numpy.testing.assert_array_equal(views["faceId"][1], views[-1]["faceId"])
            numpy.testing.assert_array_equal(numpy.asarray(views), views.array)
            self.assertEqual([len(part) for part in (views[1:], views[:5])], [1, 2])

    def test_keys(self):
        """views change keys of a scene, and poses move nodes in all of them"""
        moved = [[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
        items = [{"name": "far", "view": {"preset": "top"}, "look": "clay"}, {"hide": "a"}]
        views = zraster.Scene(SOLID).views(items, poses={"b": moved}, size=(60, 50))
        self.assertEqual(views.names, ["far", "0002"])
        scene = zraster.Scene(SOLID, size=(60, 50))
        self.assertEqual(views[0].content, scene.render(view="top", look="clay", poses={"b": moved}).content)
        self.assertEqual(views[1].content, scene.render(hide="a", poses={"b": moved}).content)

    def test_turntable(self):
        """a turntable has its frames, and a notebook gets all of them as one animated PNG"""
        for name, source in SOURCES.items():
            turn = zraster.Scene(source).turntable(4, ["color", "depth"], size=60, seconds=1, elevation=20)
            files = zraster.render(source, ["color", "depth"], size=60, turntable=4, turntable_elevation=20)
            with self.subTest(name):
                self.assertEqual((turn["color"].shape, turn["depth"].shape), ((4, 60, 60, 3), (4, 60, 60)))
                numpy.testing.assert_array_equal(turn["depth"], files["depth"])
                for number, picture in zip(turn.names, turn):
                    numpy.testing.assert_array_equal(picture["color"], files[f"{number}.color"])
                    self.assertEqual(picture.png[:4], b"\x89PNG")
                self.assertIn(b"acTL", turn._repr_png_())
                self.assertEqual(turn._repr_png_(), turn.animation().content)
                webp = turn.animation("webp", lossless=True)
                self.assertEqual((webp.content_type, webp.content[:4]), ("image/webp", b"RIFF"))
                self.assertEqual(webp.content.count(b"ANMF"), 4)

    def test_sheet(self):
        """a notebook gets the sheet of other views; without room, or without colours, none"""
        scene = zraster.Scene(SOLID)
        views = scene.views()
        self.assertEqual(views._repr_png_(), zraster.render(SOLID, views=list(views.names), sheet="views").content)
        self.assertEqual(views.sheet((320, 200)).array.shape, (200, 320, 3))
        self.assertEqual(views.sheet().content, views._repr_png_())
        self.assertIsNone(scene.views(size=30)._repr_png_())
        self.assertIsNone(scene.orbit(3, "depth")._repr_png_())
        self.assertIsNone(scene.orbit(65, size=8)._repr_png_())
        self.assertEqual(scene.orbit(3, "depth", distance=9).array.shape, (3, 150, 200))

    def test_save(self):
        """the ending of a path selects the file"""
        scene = zraster.Scene(SOLID, size=80)
        turn, views = scene.turntable(3, ["color", "depth"]), scene.views(["front", "top"])
        with tempfile.TemporaryDirectory() as folder:
            def saved(made, name):
                made.save(os.path.join(folder, name))
                return support.read(os.path.join(folder, name))

            self.assertEqual(saved(turn, "t.png"), turn._repr_png_())
            self.assertEqual(saved(turn, "t.APNG"), turn._repr_png_())
            self.assertEqual(saved(turn, "t.webp"), turn.animation("webp").content)
            self.assertEqual(saved(turn, "t.gif")[:6], b"GIF89a")
            self.assertEqual(saved(views, "v.png"), views.sheet().content)
            self.assertIn(b"acTL", saved(views, "v.apng"))
            saved(turn, "t.npz")
            arrays = numpy.load(os.path.join(folder, "t.npz"))
            numpy.testing.assert_array_equal(arrays["depth"], turn["depth"])
            saved(views, "v.npy")
            numpy.testing.assert_array_equal(numpy.load(os.path.join(folder, "v.npy")), views["color"])
            turn.save(os.path.join(folder, "all/"))
            names = sorted(f"000{i}.{channel}" for i in (1, 2, 3) for channel in ("color.png", "depth.npy"))
            self.assertEqual(sorted(os.listdir(os.path.join(folder, "all"))), names)
            self.assertEqual(support.read(os.path.join(folder, "all/0002.color.png")), turn[1].file("color"))
            self.assertEqual(saved(turn, "t.zip")[:4], b"PK\3\4")
            for made, name, why in ((turn, "t.npy", "has all"), (turn, "t.bmp", "but .png"), (views, "v.webp", "apng is allowed")):
                with self.assertRaisesRegex(zraster.OptionError, why):
                    saved(made, name)

    def test_server(self):
        """a server gives the same views"""
        with support.Daemon() as daemon:
            for name, source in SOURCES.items():
                here, there = (zraster.Scene(source, size=40, server=server) for server in (None, daemon.address))
                for draw in (lambda s: s.turntable(2, ["color", "depth"]), lambda s: s.views(["top", "front"]), lambda s: s.orbit(2, "depth")):
                    first, second = draw(here), draw(there)
                    with self.subTest(name, views=repr(first)):
                        self.assertEqual(first.look, second.look)
                        for a, b in zip(first, second):
                            self.assertEqual({channel: a.file(channel) for channel in a}, {channel: b.file(channel) for channel in b})
                        self.assertEqual(first._repr_png_(), second._repr_png_())

    def test_refusals(self):
        """wrong views are refused at once, with the place of the fault"""
        scene = zraster.Scene(SOLID)
        with self.assertRaisesRegex(zraster.SceneError, "/views/1/view/eyes"):
            scene.views(["front", {"view": {"eyes": [0, 0, 1]}}])
        for wrong in ("front", [], 3):
            with self.assertRaisesRegex(TypeError, "views: a list of presets"):
                scene.views(wrong)
        for wrong in (0, 1.5, True):
            with self.assertRaisesRegex(TypeError, "frames: a whole number"):
                scene.turntable(wrong)
        with self.assertRaisesRegex(zraster.OptionError, "did you mean samples"):
            scene.turntable(3, sample=4)
        with self.assertRaisesRegex(zraster.OptionError, "a mesh have parameters only"):
            zraster.Scene(OBJ).views(lights=[{"type": "directional", "direction": [0, 0, -1]}])
        views = scene.views([{"name": "a", "window": {"width": 9, "height": 9}}, "front"])
        self.assertEqual(views[0].array.shape, (9, 9, 3))
        with self.assertRaisesRegex(zraster.OptionError, "windows of the views differ"):
            views.array
        with self.assertRaisesRegex(KeyError, "the views have color"):
            views["depth"]
        with self.assertRaises(IndexError):
            views[2]

    def test_warnings(self):
        """a warning is issued once, at the caller's line"""
        with warnings.catch_warnings(record=True) as issued:
            warnings.simplefilter("always")
            turn = zraster.Scene(SCENE).turntable(3)  # one-sided faces
            turn._repr_png_(), turn.animation("webp"), turn[0].png
        self.assertEqual([(os.path.basename(w.filename), w.category) for w in issued], [("test_views.py", zraster.Warning)])
        self.assertEqual(turn.warnings, [str(issued[0].message)])


class Render(unittest.TestCase):
    def test_mesh(self):
        """render draws all views of a mesh, of a file in JSON and of a dict, also with several channels"""
        for name, source in SOURCES.items():
            picture = zraster.render(source, ["color", "depth"], turntable=2, size=20)
            with self.subTest(name):
                self.assertEqual(list(picture), ["0001.color", "0002.color", "depth"])
        outputs = [{"channel": "color", "encoding": "webp", "lossless": True}, "depth"]
        picture = zraster.render(SOURCES["mesh"], outputs, turntable=2, size=20)
        self.assertEqual(picture.file("color")[:4], b"RIFF")
        with self.assertRaisesRegex(zraster.OptionError, "several views of a mesh have one space"):
            outputs = [{"channel": "normals", "space": "world"}, {"channel": "position", "space": "object"}]
            zraster.render(SOURCES["mesh"], outputs, views=["front", "top"])
