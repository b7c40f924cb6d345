"""Kept scenes: changes, poses, arrays, threads, processes, memory."""
import gc
import json
import multiprocessing
import os
import pickle
import threading
import time
import unittest
import warnings

import support
import zraster
from support import OBJ, SCENE, needs_numpy, numpy

RENDERS = int(os.environ.get("PYTHON_RENDERS", 300))
MOVED = [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]]


def with_pose(matrix):
    first, second = SCENE["nodes"]
    return {**SCENE, "nodes": [first, {**second, "matrix": matrix}]}


class Changes(unittest.TestCase):
    def test_equal(self):
        """a changed scene equals one that has all of its keys"""
        sources = {"dict": SCENE, "json": json.dumps(SCENE).encode()}
        changes = [{}, {"view": "isometric"}, {"look": "clay", "size": (33, 22)}, {"channels": ["depth", "info"]},
                   {"lights": [{"type": "directional", "direction": [0, 0, -1]}], "background": "navy"}]  # fmt: skip
        for name, source in sources.items():
            scene = zraster.Scene(source)
            for change in changes:
                with self.subTest(name, change=str(change)):
                    self.assertEqual(scene.render(**change).content, zraster.render(source, **change).content)

    def test_poses(self):
        """poses replace matrices of nodes, flat ones and nested ones"""
        flat = [MOVED[row][column] for column in range(4) for row in range(4)]
        wanted = zraster.render(with_pose(MOVED)).content
        scene = zraster.Scene(SCENE)
        for matrix in (MOVED, flat, numpy.array(MOVED) if numpy else MOVED):
            self.assertEqual(scene.render(poses={"b": matrix}).content, wanted)
        self.assertNotEqual(scene.render().content, wanted)
        with self.assertRaisesRegex(zraster.SceneError, "/poses/c"):
            scene.render(poses={"c": MOVED})
        with self.assertRaisesRegex(zraster.OptionError, "b: a 4x4 matrix"):
            scene.render(poses={"b": [1, 2]})
        with self.assertRaisesRegex(zraster.OptionError, "b: a 4x4 matrix"):
            scene.render(poses={"b": 3})
        for wrong in ([MOVED], MOVED, 3, "b"):
            with self.assertRaisesRegex(
                TypeError, "poses: a dict of 4x4 matrices by the names of nodes expected, got "
            ):
                scene.render(poses=wrong)

    def test_meshes(self):
        """a kept mesh takes the same keywords; those of the scene stay unless they are replaced"""
        for source in (OBJ, support.stl()):
            scene = zraster.Scene(source, look="clay", size=50)
            wanted = zraster.render(source, look="clay", size=50, view="front").content
            self.assertEqual(scene.render(view="front").content, wanted)
            wanted = zraster.render(source, ["depth", "color"], look="metal", size=(40, 50)).content
            self.assertEqual(scene.render(["depth", "color"], look="metal", size=(40, 50)).content, wanted)

    def test_server(self):
        """a scene of a server gives the same bytes"""
        with support.Daemon() as daemon:
            for source in (SCENE, json.dumps(SCENE).encode(), OBJ):
                here, there = zraster.Scene(source, size=40), zraster.Scene(source, size=40, server=daemon.address)
                changes = [{}, {"channels": ["color", "depth"]}, {"look": "clay", "size": (30, 20)}]
                changes += [] if source is OBJ else [{"poses": {"b": MOVED}}]
                for change in changes:
                    with self.subTest(str(change)):
                        first, second = here.render(**change), there.render(**change)
                        self.assertEqual({k: first.file(k) for k in first}, {k: second.file(k) for k in second})

    def test_close(self):
        """a closed scene is refused, and its pictures stay"""
        with zraster.Scene(SCENE) as scene:
            picture = scene.render()
        self.assertEqual(picture.content, zraster.render(SCENE).content)
        with self.assertRaisesRegex(zraster.OptionError, "the scene is closed"):
            scene.render()

    def test_errors(self):
        """errors come when the scene is read, and when it is changed"""
        with self.assertRaisesRegex(zraster.SceneError, "/meshes/0/faces/0/2"):
            zraster.Scene({"meshes": [{"positions": [[0, 0, 0]], "faces": [[0, 0, 9]]}]})
        with self.assertRaisesRegex(zraster.OptionError, "did you mean view"):
            zraster.Scene(SCENE).render(veiw="top")
        with self.assertRaisesRegex(zraster.SceneError, "meshes"):
            zraster.Scene(SCENE).render(meshes=[])
        with self.assertRaisesRegex(zraster.OptionError, "preset: view is given, too"):
            zraster.Scene(SCENE).render(view="front", preset="top")
        picture = zraster.Scene(SCENE, view="front").render(preset="isometric")
        self.assertEqual(picture.content, zraster.render(SCENE, view="isometric").content)

    def test_warnings(self):
        """warnings are issued at the line of render"""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            zraster.Scene(SCENE).render(view={"eye": [0, 0, 9], "target": [0, 0, 99]})
        self.assertEqual([(one.category, one.filename) for one in caught], [(zraster.Warning, __file__)])

    def test_cancel(self):
        """a cancel ends a call"""
        cancel = zraster.Cancel()
        timer = threading.Timer(0.05, cancel.cancel)
        timer.start()
        began = time.monotonic()
        with self.assertRaises(zraster.Cancelled):
            while time.monotonic() - began < 20:
                zraster.Scene(support.stl(40)).render(samples=64, size=1000, cancel=cancel)
        timer.join()
        with self.assertRaises(zraster.Cancelled):
            zraster.render(OBJ, cancel=cancel)


@needs_numpy
class Arrays(unittest.TestCase):
    def sheet(self, position_type="f4", index_type="u4", side=30):
        x, y = numpy.meshgrid(numpy.arange(side), numpy.arange(side))
        positions = numpy.stack([x, y, numpy.sin(x) + numpy.cos(y)], axis=-1).reshape(-1, 3).astype(position_type)
        first = (y[:-1, :-1] * side + x[:-1, :-1]).reshape(-1)
        faces = numpy.stack([first, first + 1, first + side + 1, first + side], axis=-1).astype(index_type)
        return {"positions": positions, "faces": faces}

    def test_types(self):
        """arrays of every type give the picture of their lists"""
        for types in (
            ("f4", "u4"),
            ("f4", "i4"),
            ("f8", "i8"),
            ("f8", "u8"),
            (">f4", ">i4"),
            ("f2", "u2"),
            ("i4", "i2"),
        ):
            mesh = self.sheet(*types)
            lists = {name: array.tolist() for name, array in mesh.items()}
            with self.subTest(str(types)):
                self.assertEqual(zraster.render({"meshes": [mesh]}).png, zraster.render({"meshes": [lists]}).png)
                strided = {name: numpy.repeat(array, 2, axis=0)[::2] for name, array in mesh.items()}
                fortran = {name: numpy.asfortranarray(array) for name, array in strided.items()}
                self.assertEqual(zraster.render({"meshes": [fortran]}).png, zraster.render({"meshes": [lists]}).png)

    def test_keys(self):
        """normals, colours and scalars may be arrays; bytes are colours of 0 to 255"""
        mesh = self.sheet()
        count = len(mesh["positions"])
        colors = numpy.linspace(0, 255, count * 4).astype("u1").reshape(-1, 4)
        for name, array, listed in (
            ("scalars", numpy.arange(count, dtype="f4"), list(range(count))),
            ("normals", numpy.tile(numpy.float32([0, 0, 1]), (count, 1)), [[0, 0, 1]] * count),
            ("colors", colors, [f"#{bytes(color).hex()}" for color in colors]),
            ("colors", colors[:, :3], [f"#{bytes(color).hex()}" for color in colors[:, :3]]),
            ("colors", colors / 255, (colors / 255).tolist()),
        ):
            with self.subTest(name), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                wanted = zraster.render({"meshes": [{**mesh, name: listed}]}).png
                self.assertEqual(zraster.render({"meshes": [{**mesh, name: array}]}).png, wanted)
        heights = numpy.random.default_rng(1).random((20, 30), dtype="f4")
        wanted = zraster.render({"meshes": [{"heights": heights.tolist()}]}).png
        self.assertEqual(zraster.render({"meshes": [{"heights": heights}]}).png, wanted)

    def test_columns(self):
        """scalars and points may be arrays (n, 1), small and large ones, as in an NPY file"""
        for side in (3, 30):
            mesh = self.sheet(side=side)
            values = numpy.arange(side * side)
            for key, more in (("scalars", mesh), ("points", {"positions": mesh["positions"]})):
                with self.subTest(key, side=side):
                    wanted = zraster.render({"meshes": [{**more, key: values.tolist()}]}).png
                    column = {"meshes": [{**more, key: values.reshape(-1, 1)}]}
                    self.assertEqual(zraster.render(column).png, wanted)
                    named = {"meshes": [{**more, key: {"asset": "column"}}]}
                    self.assertEqual(zraster.render(named, parts={"column": values.reshape(-1, 1)}).png, wanted)
                    with support.Daemon() as daemon:
                        self.assertEqual(zraster.render(column, server=daemon.address).png, wanted)
            with self.assertRaisesRegex(zraster.SceneError, r"/meshes/0/positions: the array's shape is \(\d+, 1\)"):
                zraster.render({"meshes": [{**mesh, "positions": values.reshape(-1, 1)}]})

    def test_scalars(self):
        """scalars of numpy are numbers and truth values, in scenes, keywords, tuples, and for a server"""
        n = numpy
        light = {"type": "directional", "direction": (0, 0, -1), "intensity": 0.5}
        with_scalars = {**light, "direction": (n.int8(0), n.float16(0), n.array(-1)), "intensity": n.float32(0.5)}
        corners = [[n.float32(0), n.int64(0), 0], [n.longdouble(1), 0, n.uint8(0)], (0, n.float64(1), n.array(0.0))]
        polygon = {"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}
        sizes = {"window": {"width": 60, "height": 40}}
        same = [
            (SCENE, {"exposure": 2.0, "samples": 4}, SCENE, {"exposure": n.float32(2), "samples": n.int64(4)}),
            (SCENE, {"lights": [light]}, SCENE, {"lights": (with_scalars,)}),
            (SCENE, {"background": [1, 0.5, 0]}, SCENE, {"background": (n.float32(1), n.float16(0.5), n.int32(0))}),
            (SCENE, {"edges": True}, SCENE, {"edges": n.bool_(True)}),
            ({**sizes, "polygons": [polygon]}, {}, {**sizes, "polygons": [{"vertices": corners}]}, {}),
            (OBJ, {"edges": True, "samples": 4}, OBJ, {"edges": n.bool_(True), "samples": n.uint8(4)}),
            (OBJ, {"edges": False}, OBJ, {"edges": n.array(False)}),
            (OBJ, {"line_width": 2.5}, OBJ, {"line_width": n.float32(2.5)}),
            (OBJ, {"light_direction": [0, 0, -1]}, OBJ, {"light_direction": (n.int64(0), n.float32(0), n.array(-1))}),
        ]
        with support.Daemon() as daemon:
            for source, options, given, scalars in same:
                with self.subTest(str(scalars)):
                    wanted = zraster.render(source, **options).content
                    self.assertEqual(zraster.render(given, **scalars).content, wanted)
                    self.assertEqual(zraster.render(given, server=daemon.address, **scalars).content, wanted)
        moved = [[n.float32(x) for x in row] for row in MOVED]
        kept = zraster.Scene(SCENE)
        self.assertEqual(kept.render(poses={"b": moved}).content, kept.render(poses={"b": MOVED}).content)
        self.assertEqual(zraster.render(SCENE, view=moved).content, zraster.render(SCENE, view=MOVED).content)
        self.assertEqual(zraster.Renderer(threads=n.int64(1))._options["threads"], 1)
        for wrong in (True, n.bool_(True), n.float32(1), "1"):
            with self.assertRaisesRegex(zraster.OptionError, "threads: .* is no whole number"):
                zraster.Renderer(threads=wrong)
        with self.assertRaisesRegex(zraster.SceneError, "/exposure: a finite number expected, got nan"):
            zraster.render(SCENE, exposure=n.float32("nan"))
        for wrong, name in ((n.complex64(1), "complex"), (n.datetime64("2020"), "date")):
            with self.assertRaisesRegex(zraster.SceneError, name + " is no value of a scene"):
                zraster.render(SCENE, exposure=wrong)

    def test_faults(self):
        """faults in arrays have pointers"""
        mesh = self.sheet()
        mesh["faces"][17, 2] = 5000
        with self.assertRaisesRegex(zraster.SceneError, "/meshes/0/faces/17/2"):
            zraster.render({"meshes": [mesh]})
        mesh = self.sheet()
        mesh["positions"][17, 2] = numpy.nan
        with self.assertRaisesRegex(zraster.SceneError, "/meshes/0/positions/17/2"):
            zraster.render({"meshes": [mesh]})
        mesh = self.sheet()
        hidden = numpy.zeros((900, 3), bool)
        hidden[5] = True
        masked = numpy.ma.array(mesh["positions"], mask=hidden)
        kept = zraster.Scene({"meshes": [mesh]})
        for key, array, words in (
            ("positions", numpy.zeros((900, 3), "complex64"), "arrays of the type complex64 are no numbers"),
            ("positions", masked, "a masked array lacks numbers: give .filled"),
            ("positions", masked[:9], "a masked array"),
            ("positions", [*masked[:5].tolist(), masked[5]], "a masked array"),
            ("positions", [*mesh["positions"].tolist()[:-1], [0, 0, numpy.ma.masked]], "a masked"),
            ("faces", mesh["faces"].astype(bool), "arrays of the type bool are no numbers"),
            ("faces", numpy.array([[False, True, True]]), "arrays of the type bool"),
            ("colors", hidden, "arrays of the type bool"),
        ):
            with self.subTest(key, words=words):
                with self.assertRaisesRegex(zraster.SceneError, f"^/meshes/0/{key}(/[0-9/]+)?: {words}"):
                    zraster.render({"meshes": [{**mesh, key: array}]})
                if isinstance(array, numpy.ndarray):
                    with self.assertRaisesRegex(zraster.SceneError, words):
                        zraster.render({"meshes": [{**mesh, key: {"asset": "part"}}]}, parts={"part": array})
        with self.assertRaisesRegex(zraster.OptionError, "poses: b: a masked"):
            zraster.Scene(SCENE).render(poses={"b": numpy.ma.array(numpy.eye(4), mask=numpy.eye(4))})
        with self.assertRaisesRegex(zraster.SceneError, "masked"):
            zraster.render(SCENE, background=numpy.ma.array([0, 1, 1], mask=[1, 0, 0]))
        with self.assertRaisesRegex(zraster.OptionError, "light_direction: a masked"):
            zraster.render(OBJ, light_direction=numpy.ma.array([0, 1, 1], mask=[1, 0, 0]))
        unmasked = numpy.ma.array(mesh["positions"])
        self.assertEqual(zraster.render({"meshes": [{**mesh, "positions": unmasked}]}).png, kept.render().png)

    def test_objects(self):
        """objects with vertices and faces, or triangles, are meshes; their colours are used"""
        mesh = self.sheet("f8", "i8")
        triangles = numpy.concatenate([mesh["faces"][:, :3], mesh["faces"][:, [0, 2, 3]]])

        class Trimesh:
            vertices, faces = mesh["positions"], triangles

        class Vector:  # such as Open3D's: a sequence that is no array
            def __init__(self, values):
                self.values = values

            def __len__(self):
                return len(self.values)

            def __iter__(self):
                return iter(self.values)

            def __array__(self, dtype=None, copy=None):
                return numpy.asarray(self.values, dtype)

        class Open3D:
            def __init__(self, colors=()):
                self.vertices, self.triangles = Vector(mesh["positions"]), Vector(triangles)
                self.vertex_colors = Vector(colors)

        text = "".join("v %r %r %r\n" % tuple(p) for p in mesh["positions"].tolist())
        text += "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in triangles.tolist())
        wanted = zraster.render(text.encode(), look="studio").png
        self.assertEqual(zraster.render(Trimesh()).png, wanted)
        self.assertEqual(zraster.render(Open3D()).png, wanted)
        red = zraster.render(Open3D([[1.0, 0, 0]] * len(mesh["positions"])))
        self.assertNotEqual(red.png, wanted)
        Trimesh.visual = type("Visual", (), {"kind": "vertex", "vertex_colors": numpy.uint8([[255, 0, 0, 255]] * 900)})
        self.assertEqual(zraster.render(Trimesh()).png, red.png)

    def test_copies(self):
        """a scene copies its arrays: later changes have no effect, on pickled copies either"""
        mesh = self.sheet()
        wanted = zraster.render({"meshes": [mesh]}).content
        scene = zraster.Scene({"meshes": [mesh]})
        mesh["positions"][:] = 0
        mesh["faces"][:] = 1 << 30
        self.assertEqual(scene.render().content, wanted)
        self.assertEqual(pickle.loads(pickle.dumps(scene)).render().content, wanted)

    def test_writers(self):
        """a thread that writes to the arrays of a picture or scene meanwhile does no harm"""
        mesh = self.sheet(side=100)
        kept = zraster.Scene({"meshes": [mesh]})
        wanted = kept.render().content
        done = threading.Event()

        def write():
            while not done.is_set():
                mesh["faces"][:] = numpy.random.default_rng(1).integers(0, 1 << 31, mesh["faces"].shape)
                mesh["positions"][:] = numpy.nan

        writer = threading.Thread(target=write)
        writer.start()
        for _ in range(30):
            with self.assertRaises(zraster.SceneError), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                while True:
                    zraster.render({"meshes": [mesh]}, size=50)
        done.set()
        writer.join()
        self.assertEqual(kept.render().content, wanted)

    def test_out(self):
        """out= fills arrays, and refuses others"""
        scene = zraster.Scene(SCENE)
        out = {"color": numpy.empty((40, 60, 3), "u1"), "depth": numpy.empty((40, 60), "f4")}
        self.assertIs(scene.render(out=out), out)
        picture = zraster.render(SCENE, ["color", "depth"])
        for channel, array in out.items():
            numpy.testing.assert_array_equal(array, picture[channel])
        with self.assertRaisesRegex(zraster.OptionError, "out: depth is float32 .40, 60., not float64 .40, 60."):
            scene.render(out={"depth": numpy.empty((40, 60))})
        for wrong, words in ((3, "out: a dict of arrays"), ({"depth": 3}, "out: depth: an array")):
            with self.assertRaisesRegex(zraster.OptionTypeError, words + ".* expected, got int"):
                scene.render(out=wrong)

    def test_view_arrays(self):
        """matrices of a view may be arrays"""
        pose = numpy.eye(4)
        pose[2, 3] = 5
        wanted = zraster.render(SCENE, view={"cameraToWorld": pose.tolist()}).png
        self.assertEqual(zraster.render(SCENE, view=pose).png, wanted)
        self.assertEqual(zraster.render(SCENE, view={"cameraToWorld": numpy.float32(pose)}).png, wanted)
        given = zraster.render(SCENE, view={"cameraToWorld": pose.tolist(), "perspective": {"yfov": 0.5}}).png
        self.assertEqual(
            zraster.render(SCENE, view={"cameraToWorld": pose, "perspective": {"yfov": numpy.float64(0.5)}}).png, given
        )


def draw(scene, number):
    return scene.render(poses={"b": [[1, 0, 0, number / 10], *MOVED[1:]]}).content


class Processes(unittest.TestCase):
    def setUp(self):
        self.wanted = [zraster.render(with_pose([[1, 0, 0, i / 10], *MOVED[1:]])).content for i in range(4)]
        self.scene = zraster.Scene(SCENE)

    def test_threads(self):
        """eight threads draw one scene at once"""
        found = []
        thread = lambda number: [found.append(draw(self.scene, number) == self.wanted[number]) for _ in range(20)]
        threads = [threading.Thread(target=thread, args=(i % 4,)) for i in range(8)]
        for one in threads:
            one.start()
        for one in threads:
            one.join()
        self.assertEqual(found, [True] * 160)

    def test_fork(self):
        """a child draws after fork, while threads of its parent draw"""
        done = threading.Event()

        def work():
            while not done.is_set():
                draw(self.scene, 1)

        threads = [threading.Thread(target=work) for _ in range(2)]
        for one in threads:
            one.start()
        try:
            for _ in range(5):
                child = os.fork()
                if child == 0:
                    is_same = draw(self.scene, 2) == self.wanted[2] and zraster.render(SCENE, size=(60, 40)).png
                    os._exit(0 if is_same else 1)
                self.assertEqual(os.waitpid(child, 0)[1], 0)
        finally:
            done.set()
            for one in threads:
                one.join()

    def test_pools(self):
        """pools of forked and spawned workers take pickled scenes"""
        for method in ("fork", "spawn"):
            with self.subTest(method), multiprocessing.get_context(method).Pool(2) as pool:
                found = pool.starmap(draw, [(self.scene, i) for i in range(4)])
                self.assertEqual(found, self.wanted)

    def test_pickle(self):
        """a pickled scene keeps its parameters, keys and renderer"""
        renderer = zraster.Renderer(threads=1, window_side_max=100)
        for source in (SCENE, json.dumps(SCENE).encode(), OBJ):
            scene = zraster.Scene(source, look="clay", size=(33, 22), view="front", renderer=renderer)
            copy = pickle.loads(pickle.dumps(scene))
            self.assertEqual(copy.render().content, scene.render().content)
            with self.assertRaisesRegex(zraster.SceneError, "100"):
                copy.render(size=200)

    def test_memory(self):
        """pictures, errors, scenes and views leave no memory behind

        A leak grows in each third. Scratch of a thread that draws for the first time is taken once.
        """
        held = []
        for number in range(RENDERS):
            zraster.render(OBJ, ["color", "depth"], size=64).content
            self.scene.render(poses={"b": MOVED}).png
            zraster.Scene(OBJ, size=16).render()
            pickle.loads(pickle.dumps(self.scene))
            with self.assertRaises(zraster.SceneError):
                zraster.render({"polygons": [{"vertices": [[0, 0, 0]]}]})
            if numpy:
                zraster.render(OBJ, size=64).view("color")
            if number % (RENDERS // 3) == RENDERS // 3 - 1:
                gc.collect()
                held.append(support.rss_kb())
        print(f"# resident kB after each third of {RENDERS} rounds: {held}")
        self.assertLess(min(held[1] - held[0], held[2] - held[1]), 750)
