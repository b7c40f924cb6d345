"""render, Picture, errors and warnings."""
import glob
import io
import json
import os
import pickle
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import support
import zraster
from support import OBJ, SCENE, needs_numpy, numpy

quiet = warnings.catch_warnings


def gltf(uri):
    return json.dumps({
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": uri}],
    }).encode()  # fmt: skip


class Neighbours(unittest.TestCase):
    def setUp(self):
        self.top = tempfile.TemporaryDirectory()
        self.addCleanup(self.top.cleanup)
        self.folder = os.path.join(self.top.name, "model")
        os.makedirs(os.path.join(self.folder, "maps"))
        self.buffer = struct.pack("9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
        for name in ("maps/a b.bin", "../far.bin"):
            with open(os.path.join(self.folder, name), "wb") as file:
                file.write(self.buffer)

    def path(self, uri):
        path = os.path.join(self.folder, "x.gltf")
        with open(path, "wb") as file:
            file.write(gltf(uri))
        return path

    def test_folder(self):
        """files that a path's file refers to are read from its folder"""
        wanted = zraster.render(gltf("b"), parts={"b": self.buffer}, size=9).content
        for uri in ("maps/a%20b.bin", "MAPS/A%20B.BIN", "C:/art/maps/a b.bin"):
            with self.subTest(uri):
                if uri.startswith("C:"):
                    os.rename(os.path.join(self.folder, "maps/a b.bin"), os.path.join(self.folder, "a b.bin"))
                self.assertEqual(zraster.render(self.path(uri), size=9, strict=True).content, wanted)
        zraster.Scene(self.path("C:/art/maps/a b.bin"))
        with support.Daemon() as daemon:
            drawn = zraster.render(self.path("a b.bin"), size=9, strict=True, server=daemon.address)
            self.assertEqual(drawn.content, wanted)

    def test_root(self):
        """files outside of the folder are read below root only"""
        path = self.path("../far.bin")
        with quiet(record=True) as issued, self.assertRaisesRegex(zraster.SceneError, "far.bin"):
            warnings.simplefilter("always")
            zraster.render(path)
        zraster.render(path, root=self.top.name, strict=True)
        with open(os.path.join(self.folder, "far.obj"), "w") as file:
            file.write("mtllib /etc/none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        with quiet(record=True) as issued:
            warnings.simplefilter("always")
            zraster.render(file.name, size=9)
        self.assertIn("is not read", str(issued[0].message))
        with self.assertRaisesRegex(zraster.SceneError, "is not read"):
            zraster.render(file.name, size=9, strict=True)
        with self.assertRaises(zraster.OptionError):
            zraster.render(OBJ, root=self.top.name)

    def test_scene(self):
        """so are those that the file of a scene names; parts= wins"""
        path, scene = os.path.join(self.folder, "x.json"), {"window": {"width": 9, "height": 9}, "meshes": [{"asset": "maps/a.obj"}]}
        with open(path, "w") as file:
            json.dump(scene, file)
        with self.assertRaisesRegex(zraster.SceneError, "'maps/a.obj'; parts= gives it, and a scene by path reads it from its folder"):
            zraster.render(path)
        with open(os.path.join(self.folder, "maps/a.obj"), "wb") as file:
            file.write(OBJ)
        wanted, other = (zraster.render(scene, parts={"maps/a.obj": body}).content for body in (OBJ, support.stl()))
        self.assertNotEqual(wanted, other)
        self.assertEqual(zraster.render(path, strict=True).content, wanted)
        self.assertEqual(zraster.Scene(path).render().content, wanted)
        self.assertEqual(zraster.render(path, parts={"maps/a.obj": support.stl()}).content, other)
        with self.assertRaises(zraster.SceneError):
            zraster.render(scene)

    def test_gltf_bytes(self):
        """bytes of glTF without a type are a mesh, and take parameters of meshes"""
        drawn = zraster.render(gltf("b"), parts={"b": self.buffer}, look="clay", size=(20, 10))
        self.assertEqual(drawn.look, "clay@1")


class SameBytes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = support.Daemon().__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.__exit__()

    def test_scenes(self):
        """scenes by path, bytes and dict give the daemon's bytes"""
        paths = sorted(glob.glob(os.path.join(support.scenes, "*.json")))
        self.assertGreater(len(paths), 140)
        for path in paths:
            body = support.read(path)
            wanted = self.daemon.post(body)
            for source in (path, body, json.loads(body)):
                with self.subTest(path, source=type(source)), quiet():
                    warnings.simplefilter("ignore")
                    self.assertTrue(zraster.render(source).content == wanted)

    def test_looks(self):
        """so do meshes in every look"""
        self.assertLessEqual(set(support.LOOKS), {pin.split("@")[0] for pin in zraster.Renderer().tables["looks"]})
        for body in (OBJ, support.stl()):
            for look in support.LOOKS:
                with self.subTest(look):
                    wanted = self.daemon.post(body, f"look={look}&width=90&height=70")
                    self.assertEqual(zraster.render(body, look=look, size=(90, 70)).content, wanted)

    @unittest.skipUnless(os.path.isdir(support.models), f"there is no {support.models}")
    def test_models(self):
        """so do three models"""
        for name in ("stanford-bunny", "teapot", "suzanne"):
            body = support.read(os.path.join(support.models, name + ".obj"))
            for look in support.LOOKS:
                with self.subTest(name, look=look):
                    wanted = self.daemon.post(body, f"look={look}&width=150&height=100")
                    self.assertTrue(zraster.render(body, look=look, size=(150, 100)).content == wanted)

    def test_server(self):
        """server= sends the same calls"""
        sources = [
            (SCENE, {"channels": ["color", "depth", "info"], "look": "clay"}),
            (json.dumps(SCENE).encode(), {"size": 30, "view": "top"}),
            (os.path.join(support.scenes, "look-studio.json"), {}),
            (OBJ, {"look": "technical", "samples": 4, "color": "#ff6347"}),
            (support.stl(), {"size": (40, 30), "type": "stl"}),
            (support.stl(), {"size": 30, "view": {"eye": [9, 8, 20]}, "samples": 4, "look": "clay"}),
            (support.stl(), {"size": 30, "type": "stl", "view": [[1, 0, 0, 3], [0, 1, 0, -2], [0, 0, 1, 20], [0, 0, 0, 1]]}),
            (OBJ, {"size": 30, "view": "front", "channels": ["color", "depth"], "background": "white", "isolate": "*"}),
            (OBJ, {"size": 30, "lights": [{"type": "directional", "direction": [0, 1, -1]}], "look": "clay", "roughness": 0.4}),
            (OBJ, {"size": 30, "lights": [{"type": "directional", "direction": [0, 0, -1]}, {"type": "point", "position": [1, 2, 3]}]}),
            (OBJ, {"size": 30, "highlight": {"parts": 1, "color": "red"}, "light_direction": [0, 1, -1]}),
            (OBJ, {"size": 30, "cancel": zraster.Cancel(), "renderer": zraster.Renderer(threads=1)}),
        ]
        for source, options in sources:
            with self.subTest(str(options)), quiet():
                warnings.simplefilter("ignore")
                here = zraster.render(source, **options)
                there = zraster.render(source, server=self.daemon.address, **options)
                self.assertEqual(there.content, here.content)
                self.assertEqual((there.look, there.warnings, list(there)), (here.look, here.warnings, list(here)))

    def test_server_cancel(self):
        """a Cancel ends a call of a server, which then stops drawing; another call of the server is not ended"""
        cancel = zraster.Cancel()
        timer = threading.Timer(0.3, cancel.cancel)
        timer.start()
        with self.assertRaises(zraster.Cancelled):
            zraster.render(support.slow(), server=self.daemon.address, cancel=cancel)
        timer.join()
        self.assertEqual(len(zraster.render(SCENE, "depth", server=self.daemon.address, cancel=zraster.Cancel())), 1)
        with self.assertRaises(zraster.Cancelled):
            zraster.Scene(SCENE, server=self.daemon.address).render(cancel=cancel)
        with self.assertRaisesRegex(zraster.OptionError, "roughness: with server= and view, a mesh does not take it; a scene does"):
            zraster.render(OBJ, server=self.daemon.address, view="front", roughness=0.5)

    @needs_numpy
    def test_server_arrays(self):
        """pictures of a server have the same arrays, channels of a mesh, too"""
        channels = ["color", "depth", "normals", "instanceId"]
        for source in (SCENE, OBJ):
            for background in ("white", "#ff000080", {"top": "#123456", "bottom": "#fedcba"}):
                if source is OBJ and isinstance(background, dict):
                    continue
                here = zraster.render(source, channels, look="studio", background=background, size=50)
                there = zraster.render(
                    source, channels, look="studio", background=background, size=50, server=self.daemon.address
                )
                for channel in channels:
                    with self.subTest(channel, background=background):
                        numpy.testing.assert_array_equal(there[channel], here[channel])
                        self.assertEqual(there[channel].dtype, here[channel].dtype)

    def test_server_errors(self):
        """a server's errors are those of render"""
        for source, options in (
            ({"polygons": [{"vertices": [1]}]}, {}),
            (OBJ, {"look": "tecnical"}),
            (b"{", {}),
            (OBJ, {"line_width": 99}),
        ):
            with self.subTest(str(options)):
                errors = []
                for server in (None, self.daemon.address):
                    with self.assertRaises(zraster.Error) as caught:
                        zraster.render(source, server=server, **options)
                    errors.append(caught.exception)
                self.assertEqual(type(errors[0]), type(errors[1]))
                self.assertEqual(errors[0].faults, errors[1].faults)
        with self.assertRaisesRegex(zraster.ServerError, "nothing answers at http://127.0.0.1:1 "):
            zraster.render(OBJ, server="127.0.0.1:1")


class Errors(unittest.TestCase):
    def refused(self, kind, pattern, source, *arguments, **options):
        with self.assertRaisesRegex(kind, pattern) as caught:
            zraster.render(source, *arguments, **options)
        return caught.exception

    def test_pointers(self):
        """faults have JSON Pointers"""
        scene = {"polygons": [{"vertices": [[0, 0, 0], [1, 0], [0, 1, 0]], "colour": "red"}], "samples": 5}
        error = self.refused(zraster.SceneError, "/polygons/0/vertices/1: ", scene)
        self.assertEqual(error.pointer, "/polygons/0/vertices/1")
        pointers = [fault.pointer for fault in error.faults]
        self.assertEqual(pointers, ["/polygons/0/vertices/1", "/polygons/0/colour", "/samples"])
        self.assertIn("color", error.faults[1].detail)
        self.assertIsInstance(error, ValueError)
        copy = pickle.loads(pickle.dumps(error))
        self.assertEqual((type(copy), str(copy), copy.faults), (type(error), str(error), error.faults))

    def test_options(self):
        """options that are unknown or wrong are explained"""
        self.refused(zraster.OptionError, r"unknown option: lok \(did you mean look\?\)", OBJ, lok="clay")
        self.refused(zraster.OptionError, r"did you mean line_width\?", OBJ, lineWidth=2)
        self.refused(zraster.OptionError, r"did you mean technical\?", OBJ, look="tecnical")
        self.refused(zraster.OptionError, "^samples: .* 64", OBJ, samples=5)
        self.refused(zraster.OptionError, "^line_width: ", OBJ, line_width=100)
        for size in ("big", "64", b"@0", True, 64.5, (64.5, 64), (64, "48"), (64, False), [1, 2, 3], {64, 48}, (), {}):
            for source in (OBJ, SCENE):
                error = self.refused(
                    zraster.OptionError, r"size: .* is neither \(width, height\) nor", source, size=size
                )
                self.assertIsInstance(error, zraster.OptionTypeError)
                self.assertIsInstance(error, TypeError)
        for size in (0, -1, (-1, 5), (5, 0)):
            for source in (OBJ, SCENE):
                self.refused(zraster.OptionError, "size: .*: 1 to 8192 pixels per side", source, size=size)
        self.refused(zraster.SceneError, "1 to 8192", SCENE, size=9000)
        self.refused(zraster.OptionError, "size: width and height", OBJ, size=3, width=3)
        self.refused(zraster.OptionError, "color: for meshes without a scene", SCENE, color="red")
        for source in (OBJ, SCENE, json.dumps(SCENE).encode()):
            for view in ("front", "top", {"eye": [1, 2, 3]}, [[1, 0, 0, 0]] * 4):
                self.refused(zraster.OptionError, "preset: view is given, too", source, view=view, preset="top")
        self.refused(zraster.OptionError, "channels: the list is empty", OBJ, [])
        self.refused(zraster.OptionError, "give one of them", OBJ, ["depth"], channel="depth")
        self.refused(zraster.SceneError, "colour", SCENE, ["colour"])
        self.refused(zraster.OptionTypeError, "int is no source", 3)
        for wrong, words in (
            ({"renderer": 1}, "renderer: a Renderer expected, got int"),
            ({"cancel": 1}, "cancel: a Cancel expected, got int"),
            ({"server": 1}, "server: an address such as .* expected, got int"),
            ({"parts": [b""]}, "parts: a dict of bytes or arrays by name expected, got list"),
            ({"parts": {"a": 3}}, "parts: a: bytes or an array expected, got int"),
            ({"parts": {3: b""}}, "parts: names as str expected, got int"),
            ({"channels": 3}, "channels: a name such as 'depth', or a list of them expected, got int"),
            ({"channels": ["color", 3]}, "channels: names or dicts such as .* expected, got int"),
        ):
            self.refused(zraster.OptionTypeError, words, OBJ, **wrong)
        for wrong in (-1, 1 << 32, 0.5):
            with self.assertRaisesRegex(zraster.OptionError, "threads: .* is no whole number"):
                zraster.Renderer(threads=wrong)
        self.refused(zraster.OptionTypeError, "view: give a dict", OBJ, view=3)
        self.refused(zraster.OptionTypeError, "look: object is no value of a parameter", OBJ, look=object())
        self.refused(zraster.SceneError, "/view/yfov", SCENE, view={"yfov": 1})

    def test_named_parts(self):
        """for scenes and files, keys of parts take names, lists of names, and the objects of scenes"""
        both = OBJ + b"o far\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 5 6 7\n"
        for source, first, last in ((SCENE, "a", "b"), (both, "far", 1)):

            def picture(**options):
                return zraster.render(source, size=(60, 40), **options).png

            whole = picture()
            hidden = picture(hide=first)
            self.assertNotEqual(hidden, whole)
            self.assertEqual(picture(hide=[first]), hidden)
            self.assertEqual(picture(isolate=[last]), hidden)
            red = picture(highlight={"parts": [first], "color": "red"})
            self.assertNotEqual(red, whole)
            self.assertEqual(picture(highlight=first, highlight_color="red"), red)
            self.assertEqual(picture(highlight=[first], highlight_color="red"), red)
            self.assertEqual(picture(highlight=[{"parts": first, "color": "red"}]), red)
            moved = picture(explode=0.5)
            self.assertNotEqual(moved, whole)
            self.assertEqual(picture(explode={"factor": 0.5}), moved)
            self.assertEqual(picture(explode={"factor": 1, "axis": "z"}), picture(explode=1, explode_axis="z"))
            self.assertNotEqual(picture(colors="parts"), whole)
            self.refused(zraster.SceneError, "no part has the name 'aa'", source, hide="aa")

    def test_sources(self):
        """sources that cannot be read are explained"""
        self.refused(FileNotFoundError, "nothing.stl", "nothing.stl")
        self.refused(zraster.SceneError, "XML or HTML", b"<html></html>")
        self.refused(zraster.SceneError, "", b"")
        self.refused(zraster.SceneError, "line 1|byte", b'{"meshes": [}')
        self.refused(zraster.SceneError, "/nodes/0/scale/1: a finite number", {"nodes": [{"scale": [1, float("nan")]}]})
        self.refused(zraster.SceneError, "object is no value of a scene", {"meshes": object()})

    def test_strict(self):
        """warnings are Python's, at the caller's line, or errors with strict"""
        scene = {**SCENE, "meshes": SCENE["meshes"] + [{"positions": [[0, 0, 0]], "points": [0], "pointSize": 1}]}
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            picture = zraster.render(scene)
        self.assertEqual([str(one.message) for one in caught], picture.warnings)
        self.assertEqual(len(caught), 1)
        self.assertIs(caught[0].category, zraster.Warning)
        self.assertEqual(caught[0].filename, __file__)
        self.refused(zraster.SceneError, "", scene, strict=True)

    def test_memory(self):
        """a renderer's limits hold"""
        with self.assertRaises(zraster.MemoryLimitError):
            zraster.render(OBJ, size=2000, renderer=zraster.Renderer(memory_max=1 << 20))
        with self.assertRaisesRegex(zraster.SceneError, "100"):
            zraster.render(OBJ, size=200, renderer=zraster.Renderer(window_side_max=100))

    def test_import(self):
        """importing starts no thread and reads no numpy, and pictures need none"""
        code = (
            "import os, sys, zraster\n"
            "assert len(os.listdir('/proc/self/task')) == 1\n"
            "assert zraster.render(b'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3').png[1:4] == b'PNG'\n"
            "assert 'numpy' not in sys.modules\n"
        )
        subprocess.run([sys.executable, "-c", code], check=True)


    def test_without_numpy(self):
        """arrays name numpy and the ways without it"""
        code = (
            "import sys, zraster\n"
            "sys.modules['numpy'] = None\n"
            "picture = zraster.render(b'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3', ['depth', 'color'], size=9)\n"
            "assert picture.file('depth')[1:6] == b'NUMPY'\n"
            "for get in (lambda: picture['depth'], lambda: picture.view('color'), lambda: picture.array):\n"
            "    try:\n"
            "        get()\n"
            "        assert False\n"
            "    except ImportError as error:\n"
            "        assert 'arrays need numpy' in str(error) and 'picture.file(channel)' in str(error)\n"
        )
        subprocess.run([sys.executable, "-c", code], check=True)


class Pictures(unittest.TestCase):
    def test_save(self):
        """the ending of a file selects what is saved"""
        picture = zraster.render(SCENE, ["color", "depth", "info"])
        with tempfile.TemporaryDirectory() as folder:
            starts = {"a.png": b"\x89PNG", "a.npy": b"\x93NUM", "a.json": b"{", "a.zip": b"PK", "a": b"PK"}
            for name, start in starts.items():
                picture.save(os.path.join(folder, name))
                self.assertTrue(support.read(os.path.join(folder, name)).startswith(start), name)
            with self.assertRaisesRegex(zraster.OptionError, r"a.gif: .* \.json, \.npy, \.png, \.zip"):
                picture.save(os.path.join(folder, "a.gif"))
            self.assertFalse(os.path.exists(os.path.join(folder, "a.gif")))
            for name, words in (
                ("a.jpg", r'; draw it with \[{"channel": "color", "encoding": "jpeg"}\] as channels'), ("a.xyz", "; zraster writes no .xyz"),
                ("a.tif", r'; draw it with \[{"channel": "depth", "encoding": "tiff"}\] as channels'),
            ):  # fmt: skip
                with self.assertRaisesRegex(zraster.OptionError, words):
                    picture.save(os.path.join(folder, name))
            with open(os.path.join(folder, "b"), "wb") as file:
                picture.save(file)
            self.assertEqual(support.read(os.path.join(folder, "b")), picture.content)
        file = io.BytesIO()
        zraster.render(SCENE).save(file)
        self.assertEqual(file.getvalue(), zraster.render(SCENE).png)
        with self.assertRaisesRegex(TypeError, r"save: a path such as 'part.png', or a file with write\(\)"):
            picture.save(3)

    def test_svg(self):
        """lines of a mesh are a file without pixels"""
        scene = {**SCENE, "edges": {"from": "mesh"}}
        picture = zraster.render(scene, [{"channel": "color", "encoding": "svg"}])
        self.assertEqual(picture.content_type, "image/svg+xml")
        self.assertTrue(picture._repr_svg_().startswith("<svg "))
        self.assertIsNone(picture._repr_png_())
        self.assertEqual(list(picture), ["color"])
        with tempfile.TemporaryDirectory() as folder:
            picture.save(os.path.join(folder, "a.svg"))
            self.assertEqual(support.read(os.path.join(folder, "a.svg")), picture.content)
        with self.assertRaises(KeyError):
            picture["color"]
        copied = pickle.loads(pickle.dumps(picture))
        self.assertEqual(copied.content_type, "image/svg+xml")

    def test_encodings(self):
        """lossy pictures and float maps are files; only PNG and NPY are read back without the renderer"""
        outputs = [
            {"channel": "color", "encoding": "jpeg", "quality": 60},
            {"channel": "depth", "encoding": "tiff"},
            {"channel": "distance", "encoding": "pfm"},
        ]
        picture = zraster.render(SCENE, outputs)
        starts = {"a.jpg": b"\xff\xd8", "a.jpeg": b"\xff\xd8", "a.tif": b"II*", "a.tiff": b"II*", "a.pfm": b"Pf"}
        with tempfile.TemporaryDirectory() as folder:
            for name, start in starts.items():
                picture.save(os.path.join(folder, name))
                self.assertTrue(support.read(os.path.join(folder, name)).startswith(start), name)
        self.assertEqual(zraster.render(SCENE, encoding="webp", lossless=True).content[8:12], b"WEBP")

    def test_facts(self):
        """a picture has its look, channels, info and PNG"""
        picture = zraster.render(SCENE, ["color", "info", {"channel": "normals", "encoding": "png"}], look="clay")
        self.assertEqual(picture.look, "clay@1")
        self.assertEqual(list(picture), ["color", "info", "normals"])
        self.assertEqual(picture.info["window"], {"width": 60, "height": 40})
        self.assertIsInstance(picture.info, dict)
        facts = zraster.render(SCENE, render=False)
        self.assertEqual(list(facts), ["info"])
        self.assertNotIn("pixels", facts.info["parts"][0])
        table = str(facts.info).splitlines()
        self.assertEqual(len(table), 1 + len(facts.info["parts"]))
        self.assertRegex(table[1], r"^\S.* \d+  \S+ x \S+ x \S+ .* (open|closed) ")
        with self.assertRaisesRegex(zraster.SceneError, "color has no values"):
            zraster.render(SCENE, "color", render=False)
        self.assertEqual(picture._repr_png_(), picture.png)
        self.assertEqual(picture.file("color"), picture.png)
        self.assertNotEqual(picture.file("normals"), picture.png)
        self.assertEqual(picture.content_type, "application/zip")
        self.assertIn("color, info, normals in clay@1", repr(picture))
        with self.assertRaisesRegex(KeyError, "depth: the picture has color, info, normals"):
            picture["depth"]
        with self.assertRaisesRegex(KeyError, "ask for others"):
            zraster.render(SCENE).info
        self.assertIsNone(zraster.render(SCENE, "depth")._repr_png_())
        fragments = zraster.render(SCENE, channel="fragments", x=30, y=20)
        self.assertEqual(fragments["fragments"]["x"], 30)
        trace = zraster.render(SCENE, channel="trace", algorithm="scanline")["trace"]
        self.assertEqual((trace["algorithm"], trace["window"]), ("scanline", {"width": 60, "height": 40}))

    @needs_numpy
    def test_arrays(self):
        """channels have the shapes and types of the manual"""
        names = ["color", "depth", "windowDepth", "distance", "normals", "position", "texcoord", "barycentrics"]
        names += ["instanceId", "faceId", "frontFacing", "layers", "thickness", "wall"]
        all_of_them = zraster.Renderer().tables["channels"]
        self.assertEqual({row["name"] for row in all_of_them} - set(names), {"info", "fragments", "masks", "flow", "trace"})
        last = {"color": 3, "normals": 3, "position": 3, "barycentrics": 3, "texcoord": 2}
        types = dict.fromkeys(names[1:8], "float32") | {"color": "uint8", "thickness": "float32", "wall": "float32"}
        picture = zraster.render(SCENE, names)
        self.assertEqual(set(dict(picture)), set(names))
        for name in names:
            with self.subTest(name):
                array = picture[name]
                self.assertEqual(array.shape, (40, 60, last[name]) if name in last else (40, 60))
                self.assertEqual(array.dtype.name, types.get(name, "uint32"))
                self.assertTrue(array.flags.writeable and array.flags.c_contiguous)
                numpy.testing.assert_array_equal(picture.view(name), array)
                self.assertFalse(picture.view(name).flags.writeable)
        depth = picture["depth"]
        nothing = picture["instanceId"] == 0
        self.assertTrue(0 < nothing.sum() < nothing.size)
        self.assertTrue(numpy.isinf(depth[nothing]).all() and numpy.isfinite(depth[~nothing]).all())

    @needs_numpy
    def test_color(self):
        """colours have alpha if the background is not opaque, and equal the PNG"""
        for options in ({}, {"background": "#0000"}, {"look": "studio"}, {"background": [0, 1, 0, 0.5]}):
            picture = zraster.render(SCENE, **options)
            wanted = 4 if "background" in options else 3
            self.assertEqual(picture["color"].shape, (40, 60, wanted))
            numpy.testing.assert_array_equal(zraster._files.decode("color", picture.png), picture.array)
            numpy.testing.assert_array_equal(numpy.asarray(picture), picture.array)
        self.assertEqual(zraster.render(SCENE, "depth").array.dtype.name, "float32")

    @needs_numpy
    def test_views_outlive(self):
        """a view stays valid without its picture"""
        view = zraster.render(SCENE).view("color")
        wanted = zraster.render(SCENE)["color"]
        for _ in range(20):
            zraster.render(OBJ, size=300)
        numpy.testing.assert_array_equal(view, wanted)

    @needs_numpy
    def test_png_filters(self):
        """PNGs of every filter and palette depth are decoded, small ones as written by compress=small"""
        for options in ({"compress": "small"}, {"compress": "fast"}):
            for scene in ("look-studio.json", "color-bar.json", "textures-linear.json", "tiny-window.json"):
                with self.subTest(scene, **options), quiet():
                    warnings.simplefilter("ignore")
                    picture = zraster.render(os.path.join(support.scenes, scene), "color", **options)
                    numpy.testing.assert_array_equal(zraster._files.decode("color", picture.png), picture["color"])

    def test_pickle(self):
        """a pickled picture has the same files, look and warnings"""
        picture = zraster.render(SCENE, ["color", "depth", "info"])
        copy = pickle.loads(pickle.dumps(picture))
        self.assertEqual(copy.content, picture.content)
        self.assertEqual((copy.look, copy.info, list(copy)), (picture.look, picture.info, list(picture)))
        if numpy:
            numpy.testing.assert_array_equal(copy["depth"], picture["depth"])
            numpy.testing.assert_array_equal(copy.array, picture.array)


class Options(unittest.TestCase):
    def test_names(self):
        """each parameter and key of the tables is a keyword, in snake_case, with help"""
        options = zraster.options()
        for name in ("look", "line_width", "light_direction", "lights", "crease_degrees", "view", "nodes", "channel"):
            self.assertTrue(options[name], name)
        tables = zraster.Renderer().tables
        self.assertEqual(len(options), len({row["name"] for row in tables["parameters"] + tables["keys"]}))

    def test_meshes_and_scenes(self):
        """a keyword for a mesh is the key of a scene"""
        mesh = {"positions": [[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]], "faces": [[0, 1, 2, 3]]}
        scene = {"look": "studio", "meshes": [{**mesh, "doubleSided": True}]}
        cases = [
            {},
            {"look": "metal", "samples": 4, "size": (70, 50)},
            {
                "azimuth": 30,
                "elevation": 10,
                "padding": 0.1,
                "projection": "orthographic",
                "edges": True,
                "background": "navy",
            },
            {"light": "point", "light_position": (1, 2, 3), "light_intensity": 5.5},
            {"light_direction": [0, 0, -1], "shadows": True},
            {"preset": "top", "padding": 0.2, "projection": "orthographic", "outline": "#ff0000", "line_width": 2},
            {"lights": [{"type": "directional", "direction": [0, 0, -1]}], "fog": None},
            {"occlusion": {"radius": 0.5}, "view": {"eye": [3, 2, 4], "perspective": {"yfovDegrees": 40}}},
        ]

        class Mesh:
            vertices, faces = mesh["positions"], mesh["faces"]

        for options in cases:
            with self.subTest(str(options)):
                wanted = zraster.render(OBJ, **options).png
                self.assertEqual(zraster.render(scene, **options).png, wanted)
                self.assertEqual(zraster.render(json.dumps(scene).encode(), **options).png, wanted)
                self.assertEqual(zraster.render(Mesh(), **options).png, wanted)
        tomato = {"color": "tomato", "metallic": 0.5, "roughness": 0.2}
        self.assertEqual(zraster.render(Mesh(), **tomato).png, zraster.render(OBJ, **tomato).png)

    @needs_numpy
    def test_size(self):
        """a size is a whole number, or two, of numpy too"""
        n = numpy
        for size, wanted in (
            (64, (64, 64)), ([64, 48], (64, 48)), (n.int64(64), (64, 64)), (n.array(64), (64, 64)),
            (n.array([64, 48]), (64, 48)), ((n.uint8(64), 48), (64, 48)),
        ):  # fmt: skip
            for source in (OBJ, SCENE):
                self.assertEqual(zraster.render(source, "depth", size=size)["depth"].shape[::-1], wanted)
        for wrong in (n.array([64.0, 48.0]), n.array([[64, 48]]), n.float32(64), n.bool_(True), n.array([True, True])):
            with self.assertRaisesRegex(zraster.OptionError, "size: .* is neither"):
                zraster.render(OBJ, size=wrong)

    def test_parts(self):
        """parts are named by a scene"""
        with open(os.path.join(support.root, "clients/gallery/bricks.png"), "rb") as file:
            bricks = file.read()
        scene = {
            "materials": [{"name": "m", "baseColorTexture": {"asset": "bricks"}}],
            "meshes": [{"heights": [[0, 0], [0, 1]], "material": "m"}],
            "view": {"preset": "front"},
        }
        picture = zraster.render(scene, parts={"bricks": bricks})
        plain = {**scene, "materials": [{"name": "m"}]}
        self.assertNotEqual(picture.png, zraster.render(plain).png)
        with self.assertRaisesRegex(zraster.SceneError, "bricks"):
            zraster.render(scene)
