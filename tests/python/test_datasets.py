"""Data sets of BOP and COCO, read back as the texts of the formats say, and the stream of views that they are made of."""
import io
import json
import os
import pickle
import sys
import tempfile
import threading
import unittest

import support
import zraster
from support import needs_numpy, numpy
from zraster import _stream, bop, coco

try:
    from PIL import Image
except ImportError:
    Image = None

needs_pictures = unittest.skipUnless(numpy and Image, "there is no numpy or PIL (python3-numpy, python3-pil)")


def box(*sides):
    corners = [[x * sides[0], y * sides[1], z * sides[2]] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    return {"positions": corners, "faces": [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]}


SIDES = {"long": (0.4, 0.1, 0.1), "cube": (0.15, 0.15, 0.15), "floor": (1, 0.02, 1)}
SCENE = {
    "window": {"width": 161, "height": 120},
    "view": {"perspective": {"yfovDegrees": 35}},
    "meshes": [{"name": name, **box(*sides)} for name, sides in SIDES.items()],
    "nodes": [
        {"name": "a", "mesh": "long", "translation": [0.1, 0.2, 0], "rotation": [0.1, 0.3, 0, 0.9]},
        {"name": "b", "mesh": "cube", "translation": [-0.2, 0.1, 0.3], "scale": [2, 2, 2]},
        {"name": "c", "mesh": "cube", "translation": [0.3, 0.5, -0.2], "rotation": [0, 0, 1, 2]},
        {"name": "ground", "mesh": "floor", "translation": [0, -0.4, 0]},
    ],
}
SCALES = {1: (SIDES["long"], 1), 2: (SIDES["cube"], 2), 3: (SIDES["cube"], 1)}  # by obj_id


def pixels(path):
    with Image.open(path) as image:
        return numpy.array(image)


def load(*path):
    with open(os.path.join(*path)) as file:
        return json.load(file)


@needs_pictures
class Bop(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.place = bop.write(
            cls.folder.name, SCENE, orbit={"count": 9}, objects={"long": 1, "b": 2, "c": 3}, depth_scale=0.11, look="clay"
        )

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def views(self):
        lists = [load(self.place, f"scene_{name}.json") for name in ("camera", "gt", "gt_info")]
        self.assertEqual([list(found) for found in lists], [[str(i) for i in range(9)]] * 3)
        for number in lists[0]:
            yield (int(number), *(found[number] for found in lists))

    def masks(self, number, place):
        names = [os.path.join(self.place, kind, f"{number:06d}_{place:06d}.png") for kind in ("mask", "mask_visib")]
        masks = [pixels(name) for name in names]
        self.assertTrue(all(mask.dtype == numpy.uint8 and mask.ndim == 2 for mask in masks))
        self.assertTrue(all(set(numpy.unique(mask)) <= {0, 255} for mask in masks))
        return [mask == 255 for mask in masks]

    def test_counts(self):
        """masks, boxes and counts agree, visible masks lie in whole ones, and the files are there and no others"""
        hidden = 0
        for number, _, gt, infos in self.views():
            rgb = pixels(os.path.join(self.place, "rgb", f"{number:06d}.png"))
            depth = pixels(os.path.join(self.place, "depth", f"{number:06d}.png"))
            self.assertEqual((rgb.shape, depth.shape), ((120, 161, 3), (120, 161)))
            self.assertEqual(len(gt), len(infos))
            for place, (pose, info) in enumerate(zip(gt, infos)):
                whole, visible = self.masks(number, place)
                self.assertFalse((visible & ~whole).any())
                counts = [whole.sum(), (whole & (depth > 0)).sum(), visible.sum()]
                self.assertEqual([info[f"px_count_{name}"] for name in ("all", "valid", "visib")], counts)
                self.assertEqual(info["visib_fract"], visible.sum() / whole.sum())
                for mask, bounds in ((whole, info["bbox_obj"]), (visible, info["bbox_visib"])):
                    y, x = numpy.nonzero(mask)
                    wanted = [x.min(), y.min(), numpy.ptp(x) + 1, numpy.ptp(y) + 1] if len(x) else [-1] * 4
                    self.assertEqual(bounds, [int(value) for value in wanted])
                hidden += 0 < visible.sum() < whole.sum()
        self.assertGreater(hidden, 5)
        counted = sum(len(gt) for _, _, gt, _ in self.views())
        for folder, wanted in (("rgb", 9), ("depth", 9), ("mask", counted), ("mask_visib", counted)):
            self.assertEqual(len(os.listdir(os.path.join(self.place, folder))), wanted)

    def test_poses(self):
        """corners of models, projected by poses and K, bound the masks within a pixel; depths lie on the models"""
        checked = 0
        for number, camera, gt, infos in self.views():
            k = numpy.array(camera["cam_K"]).reshape(3, 3)
            depth = pixels(os.path.join(self.place, "depth", f"{number:06d}.png")) * camera["depth_scale"]
            for place, (pose, info) in enumerate(zip(gt, infos)):
                rotation, move = numpy.array(pose["cam_R_m2c"]).reshape(3, 3), numpy.array(pose["cam_t_m2c"])
                self.assertLess(abs(rotation @ rotation.T - numpy.eye(3)).max(), 1e-5)
                self.assertGreater(numpy.linalg.det(rotation), 0)
                sides, scale = SCALES[pose["obj_id"]]
                half = 1000 * scale * numpy.array(sides)  # millimetres
                corners = numpy.array(box(*half)["positions"])
                seen = (corners @ rotation.T + move) @ k.T
                seen = seen[:, :2] / seen[:, 2:]
                x, y, width, height = info["bbox_obj"]
                inside = seen.min() > 0 and (seen.max(axis=0) < (160, 119)).all()
                if inside:  # a pixel counts if its middle is covered
                    found = numpy.array([x, y, x + width - 1, y + height - 1])
                    wanted = numpy.concatenate([numpy.ceil(seen.min(axis=0)), numpy.floor(seen.max(axis=0))])
                    self.assertLessEqual(abs(found - wanted).max(), 1)
                    checked += 1
                row, column = numpy.nonzero(self.masks(number, place)[1])
                rays = numpy.stack([column, row, numpy.ones(len(row))], axis=1) @ numpy.linalg.inv(k).T
                points = (rays * depth[row, column][:, None] - move) @ rotation
                beyond = abs(points) - half
                self.assertLess(abs(beyond.max(axis=1, initial=-1e9)).max(initial=0), 0.2)
        self.assertGreater(checked, 15)

    def test_pictures(self):
        """pictures are those of the same views drawn alone; world to camera agrees with the poses"""
        for number, camera, gt, _ in self.views():
            rotation = numpy.array(camera["cam_R_w2c"]).reshape(3, 3)
            place = rotation @ [-200, 100, 300] + camera["cam_t_w2c"]
            b = [pose for pose in gt if pose["obj_id"] == 2]
            self.assertLess(abs(place - b[0]["cam_t_m2c"]).max(), 0.01)
            if number % 4:
                continue
            flat = numpy.eye(4)
            flat[:3, :3], flat[:3, 3] = rotation, numpy.array(camera["cam_t_w2c"]) / 1000
            flat[1:3] *= -1
            k = numpy.array(camera["cam_K"])
            view = {"worldToCamera": flat.T.ravel().tolist(), "K": k.tolist(), "pixelCenter": 0}
            drawn = zraster.render({**SCENE, "view": view}, ["instanceId"])["instanceId"]
            for at, pose in enumerate(gt):
                self.assertLessEqual((self.masks(number, at)[1] != (drawn == pose["obj_id"])).sum(), 4)

    def test_loader(self):
        """the example's loader reads the folder, and works after it is pickled"""
        sys.path.insert(0, os.path.join(support.root, "clients/examples"))
        try:
            import dataset
        finally:
            sys.path.pop(0)
        views = pickle.loads(pickle.dumps(dataset.BopFolder(self.place)))
        self.assertEqual(len(views), 9)
        for number, _, gt, infos in self.views():
            item = views[number]
            self.assertEqual((item["image"].shape, item["image"].dtype), ((120, 161, 3), numpy.uint8))
            self.assertEqual(item["visible"].sum(axis=(1, 2)).tolist(), [info["px_count_visib"] for info in infos])
            self.assertEqual(item["objects"].tolist(), [pose["obj_id"] for pose in gt])
            self.assertEqual(item["rotations"].shape, (len(gt), 3, 3))
        with self.assertRaises(IndexError):
            views[9]
        drawn = pickle.loads(pickle.dumps(dataset.DrawnViews(SCENE, 5)))
        self.assertEqual([drawn[i]["image"].shape for i in range(len(drawn))], [(120, 161, 3)] * 5)
        self.assertEqual(drawn[3]["image"].tobytes(), drawn[3]["image"].tobytes())
        self.assertEqual(set(numpy.unique(drawn[2]["instances"])) - {0, 1, 2, 3, 4}, set())

    def test_refused(self):
        """cameras and poses that BOP has not are refused"""
        squeezed = [{"name": "a", "mesh": "cube", "scale": [1, 1, 2]}]
        flat = {**SCENE, "view": {"preset": "front", "orthographic": {}}}
        lens = {"preset": "front", "perspective": {"yfovDegrees": 40}, "distortion": {"model": "opencv", "k": [0.01]}}
        cases = [
            ({**SCENE, "nodes": squeezed}, {"orbit": {"count": 2}}, "stretched"),
            (flat, {"views": ["front", "top"]}, "pinhole"),
            (SCENE, {"views": [{"view": lens}, "top"]}, "distortion"),
            (SCENE, {"orbit": {"count": 2}, "unit": 0}, "unit"),
            (SCENE, {}, "one view"),
            (SCENE, {"orbit": {"count": 2}, "objects": ["cube"]}, "objects"),
        ]
        for scene, options, words in cases:
            with self.subTest(words), tempfile.TemporaryDirectory() as folder:
                with self.assertRaisesRegex(zraster.Error, words):
                    bop.write(folder, scene, **options)


    def test_default_perspective(self):
        """scenes without a projection, and Scenes, give the data set of the dict with a perspective of 45 degrees"""
        bare = {key: value for key, value in SCENE.items() if key != "view"}
        options = {"orbit": {"count": 2}, "objects": {"long": 1, "cube": 2, "floor": 3}}
        wide = {**bare, "view": {"perspective": {"yfovDegrees": 45}}}
        arrays = {**bare, "meshes": [{**mesh, "positions": numpy.repeat(mesh["positions"], 3, axis=0)} for mesh in bare["meshes"]]}
        for mesh in arrays["meshes"]:
            mesh["faces"] = [[3 * corner for corner in face] for face in mesh["faces"]]
        sources = [bare, {**bare, "view": {}}, zraster.Scene(bare), zraster.Scene(arrays)]
        sources.append(zraster.Scene(bare, renderer=zraster.Renderer(threads=1)))
        with tempfile.TemporaryDirectory() as folder:
            wanted = files_of(zraster.bop.write(os.path.join(folder, "wanted"), wide, **options))
            for number, source in enumerate(sources):
                self.assertEqual(files_of(zraster.bop.write(os.path.join(folder, f"{number}"), source, **options)), wanted, number)
            self.assertTrue(zraster.coco.write(os.path.join(folder, "coco"), sources[2], orbit={"count": 2}))
            model = zraster.Scene(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", type="obj")
            with self.assertRaisesRegex(zraster.OptionError, "a Scene of a model: give its path instead"):
                zraster.bop.write(os.path.join(folder, "refused"), model, **options)


def files_of(folder):
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            with open(os.path.join(place, name), "rb") as file:
                found[os.path.relpath(os.path.join(place, name), folder)] = file.read()
    return found


class Again(unittest.TestCase):
    def test_refused(self):
        """a refused request leaves the data set that is there, and writes nothing into a new folder"""
        for write in (bop.write, coco.write):
            with self.subTest(write.__module__), tempfile.TemporaryDirectory() as folder:
                write(folder, SCENE, orbit={"count": 2})
                before = files_of(folder)
                for options in ({"orbit": {"count": 0}}, {"orbit": {"count": 2}, "nonsense": 1}, {}):
                    with self.assertRaises((zraster.Error, TypeError)):
                        write(folder, SCENE, **options)
                    self.assertEqual(files_of(folder), before)
                    with self.assertRaises((zraster.Error, TypeError)):
                        write(os.path.join(folder, "new"), SCENE, **options)
                    self.assertFalse(os.path.exists(os.path.join(folder, "new")))

    def test_broken_off(self):
        """lists of a data set that breaks off are those of the one before"""
        views = [{"view": {"azimuthDegrees": 5, "perspective": {"yfovDegrees": 30}}}, {"view": {"preset": "top", "orthographic": {}}}]
        with tempfile.TemporaryDirectory() as folder:
            place = bop.write(folder, SCENE, orbit={"count": 1})
            with open(os.path.join(place, "scene_gt.json")) as file:
                before = file.read()
            with self.assertRaises(zraster.Error):
                bop.write(folder, SCENE, views=views)
            with open(os.path.join(place, "scene_gt.json")) as file:
                self.assertEqual(file.read(), before)
            self.assertFalse([name for name in os.listdir(place) if name.endswith(".part")])

    def test_fewer(self):
        """pictures of an earlier data set are removed, and no other files"""
        for write, pictures in ((bop.write, "train_pbr/000000/rgb"), (coco.write, "images")):
            with self.subTest(write.__module__), tempfile.TemporaryDirectory() as folder:
                write(folder, SCENE, orbit={"count": 3})
                with open(os.path.join(folder, pictures, "mine.png"), "w"):
                    pass
                write(folder, SCENE, orbit={"count": 1})
                self.assertEqual(sorted(os.listdir(os.path.join(folder, pictures))), ["000000.png", "mine.png"])

    def test_names(self):
        """names that no view shows are warned of, and an empty list of names is refused"""
        for write, key in ((bop.write, "objects"), (coco.write, "categories")):
            with self.subTest(key), tempfile.TemporaryDirectory() as folder:
                with self.assertWarnsRegex(zraster.Warning, f"{key}: no view shows nobody; others have "):
                    write(folder, SCENE, orbit={"count": 1}, **{key: {"nobody": 1}})
                with self.assertRaisesRegex(zraster.OptionError, f"{key}: no name"):
                    write(folder, SCENE, orbit={"count": 1}, **{key: {}})


@needs_pictures
class Coco(unittest.TestCase):
    def test_read(self):
        """annotations have the pixels of instanceId, their area and their box; polygons enclose the same pixels"""
        moved = {"ground": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 9, 0, 1]}
        views = [{"view": {"azimuthDegrees": 40 * i, "elevationDegrees": 25, "perspective": {"yfovDegrees": 30}}} for i in range(4)]
        views.append({"poses": moved, "view": {"preset": "front"}, "window": {"width": 90, "height": 77}})
        categories = {"long": 7, "cube": 3}
        with tempfile.TemporaryDirectory() as folder:
            exact = load(coco.write(os.path.join(folder, "a"), SCENE, views=views, categories=categories))
            outlines = load(coco.write(os.path.join(folder, "b"), SCENE, views=views, categories=categories, segmentation="polygons"))
            sizes = {}
            for image in exact["images"]:
                shape = pixels(os.path.join(folder, "a", "images", image["file_name"])).shape
                self.assertEqual(shape[:2], (image["height"], image["width"]))
                sizes[image["id"]] = shape[:2]
        self.assertEqual(list(sizes), [0, 1, 2, 3, 4])
        self.assertEqual({c["name"]: c["id"] for c in exact["categories"]}, categories)
        found = {i: [] for i in sizes}
        for annotation, outline in zip(exact["annotations"], outlines["annotations"]):
            mask = unpack(annotation["segmentation"])
            y, x = numpy.nonzero(mask)
            self.assertEqual(annotation["area"], mask.sum())
            self.assertEqual(annotation["bbox"], [x.min(), y.min(), numpy.ptp(x) + 1, numpy.ptp(y) + 1])
            self.assertEqual((mask.shape, annotation["iscrowd"]), (sizes[annotation["image_id"]], 0))
            self.assertTrue((coco.decode(annotation["segmentation"]) == mask).all())
            self.assertTrue((fill(outline["segmentation"], mask.shape) == mask).all())  # none has a hole
            same = ("id", "image_id", "category_id", "area", "bbox")
            self.assertEqual([annotation[key] for key in same], [outline[key] for key in same])
            found[annotation["image_id"]].append((annotation["category_id"], mask))
        for number, view in enumerate(views):
            ids = zraster.render({**SCENE, "views": [view, view]}, "instanceId")["instanceId"][0]
            wanted = [(category, ids == i) for i, category in ((1, 7), (2, 3), (3, 3)) if (ids == i).any()]
            self.assertEqual([c for c, _ in found[number]], [c for c, _ in wanted])
            self.assertTrue(all((a == b).all() for (_, a), (_, b) in zip(found[number], wanted)))

    def test_no_mask(self):
        """decode raises an error with the reason for broken masks"""
        size = [2, 3]
        self.assertEqual(coco.decode({"size": size, "counts": "132"}).sum(), 3)
        self.assertEqual(coco.decode({"size": size, "counts": b"132"}).sum(), 3)
        self.assertEqual(coco.decode({"size": [0, 3], "counts": ""}).shape, (0, 3))
        for mask, expected in (
            ({}, "size"), ([], "size"), (None, "size"), ({"size": size}, "counts"), ({"size": [2], "counts": "6"}, "size"), ({"size": [-2, -3], "counts": "6"}, "size"),
            ({"size": [2.0, 3], "counts": "6"}, "size"), ({"size": size, "counts": [6]}, "list"), ({"size": size, "counts": "5"}, "5 pixels, not 2 x 3"),
            ({"size": size, "counts": "7"}, "7 pixels"), ({"size": size, "counts": "6 "}, "no string of run lengths"), ({"size": size, "counts": "P"}, "cut short"),
            ({"size": size, "counts": "\u00e9"}, "no string"), ({"size": size, "counts": "O7"}, "less than 0"),
        ):
            with self.subTest(mask), self.assertRaisesRegex(ValueError, expected):
                coco.decode(mask)

    def test_holes(self):
        """outlines leave holes out, and pixels that meet at corners are apart"""
        rows = ["11100", "10100", "11101", "00010"]
        mask = numpy.array([[int(c) for c in row] for row in rows], bool)
        filled = mask.copy()
        filled[1, 1] = True
        polygons = coco._polygons({"size": [4, 5], "counts": pack(mask)})
        self.assertEqual(len(polygons), 3)
        self.assertTrue((fill(polygons, mask.shape) == filled).all())


def unpack(mask):
    """Decodes run lengths, as the contract says."""
    height, width = mask["size"]
    runs, at, text = [], 0, mask["counts"]
    while at < len(text):
        groups = []
        while True:
            groups.append(ord(text[at]) - 48)
            at += 1
            if groups[-1] < 32:
                break
        value = sum((group % 32) << 5 * i for i, group in enumerate(groups))
        if groups[-1] >= 16:
            value -= 32 ** len(groups)
        runs.append(value + (runs[-2] if len(runs) >= 3 else 0))
    flat = [bit for i, run in enumerate(runs) for bit in [i % 2] * run]
    return numpy.array(flat, bool).reshape(width, height).T


def pack(mask):
    """Encodes run lengths below 16 without differences, for the first three; enough for small masks."""
    flat = mask.T.ravel().tolist()
    runs, last = [0], False
    for bit in flat:
        if bit != last:
            runs.append(0)
            last = bit
        runs[-1] += 1
    values = [run - (runs[i - 2] if i > 2 else 0) for i, run in enumerate(runs)]
    return "".join(chr(48 + value % 32) for value in values)


def fill(polygons, shape):
    """Returns the pixels whose middle is in a polygon."""
    inside = numpy.zeros(shape, bool)
    row, column = numpy.indices(shape)
    for polygon in polygons:
        points = list(zip(polygon[::2], polygon[1::2]))
        crossed = numpy.zeros(shape, int)
        for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1]):
            if x0 == x1:
                crossed += (x0 > column) & (row >= min(y0, y1)) & (row < max(y0, y1))
        inside |= crossed % 2 == 1
    return inside


class Streams(unittest.TestCase):
    def test_equal(self):
        """files of a stream are those of one answer"""
        outputs = [{"channel": "color", "encoding": "png"}, {"channel": "depth", "encoding": "png16"}, {"channel": "info"}]
        for options in ({"orbit": {"count": 7}}, {"turntable": {"frames": 6}, "look": "clay"}, {"views": ["front", "top"]}):
            with self.subTest(str(options)):
                whole = zraster.render(SCENE, outputs, **options)
                drawn = list(_stream.stream(SCENE, outputs, options))
                self.assertEqual([view.number for view in drawn], list(range(drawn[0].count)))
                data = [data for view in drawn for data in view.files.values()]
                self.assertEqual(data, [whole.file(name) for name in whole])

    def test_left(self):
        """a stream that is left ends its thread"""
        before = threading.active_count()
        stream = _stream.stream(SCENE, ["color"], {"orbit": {"count": 4000}})
        self.assertEqual([next(stream).number for _ in range(3)], [0, 1, 2])
        stream.close()
        self.assertEqual(threading.active_count(), before)

    def test_faults(self):
        """faults of views are raised where the stream is read"""
        views = ["front", {"view": {"eye": 1}}]
        with self.assertRaises(zraster.SceneError) as caught:
            list(_stream.stream(SCENE, ["color"], {"views": views}))
        self.assertEqual(caught.exception.pointer, "/views/1/view/eye")

    def test_warnings(self):
        """warnings of views are issued once"""
        outputs = [{"channel": "depth", "encoding": "png16", "scale": 1e-6}]
        with self.assertWarns(zraster.Warning) as caught:
            list(_stream.stream(SCENE, outputs, {"orbit": {"count": 3}}))
        self.assertEqual(len(caught.warnings), 1)
        self.assertIn("16 bits", str(caught.warning))

    def test_memory(self):
        """memory of many views is that of a few"""
        most = []
        for count in (40, 400):
            used = 0
            for _ in _stream.stream(SCENE, ["color"], {"orbit": {"count": count}, "size": (320, 240)}):
                used = max(used, support.rss_kb())
            most.append(used)
        self.assertLess(most[1], 1.1 * most[0])

    @needs_numpy
    def test_model(self):
        """a model file is drawn in its scene"""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "part.stl")
            with open(path, "wb") as file:
                file.write(support.stl())
            place = bop.write(folder, path, orbit={"count": 2}, size=(80, 60), unit=1)
            gt = load(place, "scene_gt.json")
            self.assertEqual([[pose["obj_id"] for pose in poses] for poses in gt.values()], [[1], [1]])


@needs_pictures
class Masks(unittest.TestCase):
    def test_arrays(self):
        """pictures have masks as arrays by instance, of files, pickled ones and beside other channels"""
        ids = zraster.render(SCENE, "instanceId")["instanceId"]
        both = zraster.render(SCENE, ["color", "masks"])
        alone = zraster.render(SCENE, "masks")
        self.assertEqual((list(both), list(alone)), (["color", "masks"], ["masks"]))
        for picture in (both, alone, pickle.loads(pickle.dumps(both)), pickle.loads(pickle.dumps(alone))):
            masks = picture["masks"]
            self.assertEqual(list(masks), [1, 2, 3, 4])
            for number, mask in masks.items():
                self.assertTrue((mask["visible"] == (ids == number)).all())
                self.assertTrue((mask["amodal"] >= mask["visible"]).all())
        listed = zraster.render(SCENE, [{"channel": "masks", "encoding": "json"}])["masks"]["visibility"]
        info = zraster.render(SCENE, "info", visibility=True).info
        self.assertEqual(info["visibility"], listed)
        for found in listed:
            wanted = masks[found["instanceId"]]
            for kind in ("amodal", "visible"):
                self.assertTrue((unpack(found[kind]) == wanted[kind]).all())
