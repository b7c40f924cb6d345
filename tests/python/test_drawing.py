"""Technical drawings: lengths measured in the files, places of texts, scales, sections, refusals."""
import math
import os
import re
import shutil
import struct
import subprocess
import unittest
import xml.etree.ElementTree as tree
import zlib

import zraster
from support import models, needs_numpy, read

SVG = "{http://www.w3.org/2000/svg}"
SEGMENTS = 64
PARTS = ("cube", "gear", "housing", "openbox", "plate")


def plate(columns, rows, height, radius, cell=20.0):
    """Returns a scene of a plate with a bore in each of its square cells; y is up."""
    positions, faces, places = [], [], {}

    def at(x, y, z):
        key = (round(x, 9), round(y, 9), round(z, 9))
        if key not in places:
            places[key] = len(positions)
            positions.append(list(key))
        return places[key]

    def quad(a, b, c, d):
        faces.append([a, b, c, d])

    for i in range(columns):
        for k in range(rows):
            x, z = cell * (i + 0.5), cell * (k + 0.5)
            corners = [(x + cell / 2 * sx, z + cell / 2 * sz) for sx, sz in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
            ring = [(x + radius * math.cos(a), z + radius * math.sin(a)) for a in
                    [2 * math.pi * n / SEGMENTS for n in range(SEGMENTS)]]  # fmt: skip
            for level, turn in ((height, -1), (0.0, 1)):
                for n in range(SEGMENTS):
                    corner = corners[n * 4 // SEGMENTS]
                    a, b = ring[n], ring[(n + 1) % SEGMENTS]
                    tri = [at(a[0], level, a[1]), at(b[0], level, b[1]), at(corner[0], level, corner[1])]
                    faces.append(tri[::-turn] if turn == 1 else tri)
                for n in range(4):
                    a = ring[n * SEGMENTS // 4]
                    low, high = corners[n - 1], corners[n]
                    tri = [at(a[0], level, a[1]), at(high[0], level, high[1]), at(low[0], level, low[1])]
                    faces.append(tri[::-turn] if turn == 1 else tri)
            for n in range(SEGMENTS):
                a, b = ring[n], ring[(n + 1) % SEGMENTS]
                quad(at(a[0], 0, a[1]), at(b[0], 0, b[1]), at(b[0], height, b[1]), at(a[0], height, a[1]))
    right, front = columns * cell, rows * cell
    for i in range(columns):
        a, b = i * cell, (i + 1) * cell
        quad(at(a, 0, front), at(b, 0, front), at(b, height, front), at(a, height, front))
        quad(at(b, 0, 0), at(a, 0, 0), at(a, height, 0), at(b, height, 0))
    for k in range(rows):
        a, b = k * cell, (k + 1) * cell
        quad(at(right, 0, b), at(right, 0, a), at(right, height, a), at(right, height, b))
        quad(at(0, 0, a), at(0, 0, b), at(0, height, b), at(0, height, a))
    return {"meshes": [{"name": "plate", "positions": positions, "faces": faces}]}


PLATE = plate(2, 1, 10.0, 4.0)


def points_of(path):
    return [(float(x), float(y)) for x, y in re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", path.get("d"))]


def box_of(points):
    return [min(p[0] for p in points), min(p[1] for p in points), max(p[0] for p in points), max(p[1] for p in points)]


def dark(png):
    """Returns which pixels of a PNG are dark: of RGB, RGBA or a palette of greys. An array."""
    import numpy

    at, packed, palette = 8, b"", None
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at : at + 8])
        data = png[at + 8 : at + 8 + size]
        at += size + 12
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack(">IIBB", data[:10])
        elif kind == b"PLTE":
            palette = numpy.frombuffer(data, numpy.uint8)[::3]
        elif kind == b"IDAT":
            packed += data
    step = {2: 3, 3: 1, 6: 4}[color]
    rows = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).reshape(height, -1)
    out = numpy.zeros((height, rows.shape[1] - 1), numpy.int32)
    above = numpy.zeros(rows.shape[1] - 1, numpy.int32)
    for y in range(height):
        line, filtered = rows[y, 1:].astype(numpy.int32), rows[y, 0]
        if filtered == 2:
            line = (line + above) % 256
        elif filtered == 1:
            line = numpy.cumsum(line.reshape(-1, step), 0).ravel() % 256
        elif filtered > 2:
            done, before = line.tolist(), above.tolist()
            for x in range(len(done)):
                left, up = done[x - step] if x >= step else 0, before[x]
                corner = before[x - step] if x >= step else 0
                near = min((left, up, corner), key=lambda v: abs(left + up - corner - v))
                done[x] = (done[x] + (near if filtered == 4 else (left + up) // 2)) % 256
            line = numpy.array(done, numpy.int32)
        out[y] = above = line
    if bits < 8:
        out = numpy.unpackbits(out.astype(numpy.uint8), axis=1).reshape(height, -1, bits)
        out = (out << numpy.arange(bits - 1, -1, -1)).sum(2)[:, :width]
    values = palette[out] if color == 3 else out.reshape(height, width, step)[:, :, 0]
    return values < 128


class Sheet:
    """A drawing that was parsed: paths by group and class, and texts with their boxes."""

    def __init__(self, drawing):
        self.root = tree.fromstring(drawing.data)
        over, under = self.root.get("data-scale").split(":")
        self.scale = float(over) / float(under)
        self.groups = {group.get("id"): group for group in self.root.findall(SVG + "g")}
        self.texts = []
        for text in self.root.iter(SVG + "g"):
            if text.get("role") == "img":
                points = [p for path in text.iter(SVG + "path") for p in points_of(path)]
                self.texts.append((text.get("aria-label"), box_of(points)))

    def paths(self, group, kind):
        return [points_of(path) for part in self.groups[group].findall(SVG + "g") if part.get("class") == kind
                for path in part.findall(SVG + "path")]  # fmt: skip

    def box(self, view):
        return box_of([p for path in self.paths(view, "visible") for p in path])

    def size(self, view):
        x0, y0, x1, y1 = self.box(view)
        return (x1 - x0) / self.scale, (y1 - y0) / self.scale

    def labels(self):
        return [label for label, _ in self.texts]

    def all_points(self, *but):
        for name, group in self.groups.items():
            if name not in but:
                for path in group.iter(SVG + "path"):
                    yield from points_of(path)


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


class Drawings(unittest.TestCase):
    def assert_near(self, found, wanted, most=1e-6):
        for a, b in zip(found, wanted):
            self.assertLess(abs(a - b), most * max(1.0, abs(b)), (found, wanted))

    def test_measured(self):
        """lengths measured in the file are those of the model"""
        for page, scale in (("a3", 2), ("a4", 1)):
            sheet = Sheet(zraster.drawing(PLATE, page=page))
            self.assertEqual(sheet.scale, scale)
            self.assert_near(sheet.size("front"), (40, 10))
            self.assert_near(sheet.size("top"), (40, 20))
            self.assert_near(sheet.size("right"), (20, 10))
            circles = [path for path in sheet.paths("top", "visible") if len(path) == SEGMENTS]
            self.assertEqual(len(circles), 2)
            for circle in circles:
                x0, y0, x1, y1 = box_of(circle)
                self.assert_near(((x1 - x0) / sheet.scale, (y1 - y0) / sheet.scale), (8, 8))
            lines = [path for path in sheet.paths("dimensions", "dimension") if len(path) == 2]
            lengths = [math.dist(*line) / sheet.scale for line in lines]
            for length in (40, 20, 10):
                self.assertTrue(any(abs(found - length) < 1e-6 for found in lengths), lengths)

    def test_texts(self):
        """sizes once each, a note of the holes, and the title block"""
        labels = Sheet(zraster.drawing(PLATE, title="Plate & <1>", date="2026-11-30")).labels()
        for text in ("40", "20", "10", "2\u00d7 \u00f88 through"):
            self.assertEqual(labels.count(text), 1, text)
        for text in ("Plate & <1>", "2026-11-30", "2:1", "none in file (1 = 1 mm)", "40 \u00d7 20 \u00d7 10", "A3 1/1"):
            self.assertIn(text, labels)

    def test_titles(self):
        """long titles, signs and other letters stay in the title block"""
        for title in ("x" * 3000, "\u00d8 12 \u00b1 0.1 \u2603", "a\tb<&>\"'", "\u0416" * 100):
            sheet = Sheet(zraster.drawing(PLATE, title=title, date=title))
            for _, (x0, y0, x1, y1) in sheet.texts:
                self.assertTrue(20 <= x0 and x1 <= 410 and 10 <= y0 and y1 <= 287, title[:20])

    def test_center_lines(self):
        """crosses in the middle of the holes, and their axes"""
        sheet = Sheet(zraster.drawing(PLATE))
        x0, y0, _, _ = sheet.box("top")
        lines = sheet.paths("top", "center")
        for x in (10, 30):
            self.assertTrue(any(abs(a[0] - b[0]) < 1e-6 and abs(a[0] - x0 - 2 * x) < 1e-6 for a, b in lines), lines)
        self.assertTrue(any(abs(a[1] - b[1]) < 1e-6 and abs(a[1] - y0 - 20) < 1e-6 for a, b in lines), lines)
        self.assertEqual(len(sheet.paths("front", "center")), 2)
        self.assertEqual(len(sheet.paths("right", "center")), 1)

    def test_projections(self):
        """third angle has the top view above the front, first angle below"""
        third, first = (Sheet(zraster.drawing(PLATE, projection=name)) for name in ("third", "first"))
        self.assertLess(third.box("top")[3], third.box("front")[1])
        self.assertGreater(third.box("right")[0], third.box("front")[2])
        self.assertGreater(first.box("top")[1], first.box("front")[3])
        self.assertLess(first.box("right")[2], first.box("front")[0])
        for sheet in (third, first):
            self.assert_near([sheet.box("top")[0]], [sheet.box("front")[0]])
            self.assert_near([sheet.box("right")[1]], [sheet.box("front")[1]])

    def test_scales(self):
        """the largest scale of ISO 5455 that fits, or the one that is asked for"""
        for size, scale in ((1.0, "50:1"), (30.0, "2:1"), (300.0, "1:5"), (12345.0, "1:200"), (2e-3, "20000:1")):
            cube = {"meshes": [{"positions": [[x, y, z] for x in (0, size) for y in (0, size) for z in (0, size)],
                                "faces": [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]}]}  # fmt: skip
            sheet = Sheet(zraster.drawing(cube))
            self.assertEqual(sheet.root.get("data-scale"), scale, size)
            self.assert_near(sheet.size("front"), (size, size), 1e-6 * max(1, size))
        self.assertEqual(Sheet(zraster.drawing(PLATE, scale="1:3")).root.get("data-scale"), "1:3")

    def test_section(self):
        """the section has letters, arrows and a hatch within it, and no hidden lines"""
        for axis, view, shown in (("x", "right", "front"), ("y", "top", "front"), ("z", "front", "top")):
            for projection in ("third", "first"):
                sheet = Sheet(zraster.drawing(PLATE, section=axis, projection=projection))
                labels = sheet.labels()
                self.assertEqual((labels.count("A"), labels.count("A-A")), (2, 1))
                self.assertEqual(len(sheet.paths("section", "cut")), 2)
                self.assertEqual(sheet.paths(view, "hidden"), [])
                hatch = sheet.paths(view, "hatch")
                self.assertGreater(len(hatch), 5)
                x0, y0, x1, y1 = box_of([p for line in hatch for p in line])
                a0, b0, a1, b1 = sheet.box(view)
                self.assertTrue(a0 - 1e-6 <= x0 and b0 - 1e-6 <= y0 and x1 <= a1 + 1e-6 and y1 <= b1 + 1e-6)
                (c0, d0), (c1, d1) = sheet.paths("section", "center")[0]
                e0, f0, e1, f1 = sheet.box(shown)
                self.assertTrue(c0 < e0 or d0 < f0)
                self.assertTrue(c1 > e1 or d1 > f1)
        # Half of the plate: 40 x 10 less two bores of 8.
        sheet = Sheet(zraster.drawing(PLATE, section="z"))
        length = sum(math.dist(*line) for line in sheet.paths("front", "hatch"))
        area = length * 3.0 / sheet.scale**2
        self.assertLess(abs(area - (400 - 2 * 80)) / 240, 0.02)

    def test_hidden(self):
        """hidden lines may be left out"""
        self.assertGreater(len(Sheet(zraster.drawing(PLATE)).paths("front", "hidden")), 0)
        for view in ("front", "top", "right", "isometric"):
            self.assertEqual(Sheet(zraster.drawing(PLATE, hidden=False)).paths(view, "hidden"), [])

    def test_places(self):
        """texts lie apart from one another, and all marks inside the frame"""
        checked = 0
        sources = [os.path.join(models, "parts", name + ".obj") for name in PARTS]
        for source in [PLATE, plate(3, 2, 5.0, 2.0)] + [path for path in sources if os.path.exists(path)]:
            for options in ({}, {"page": "a4", "section": "x"}, {"section": "z", "projection": "first"}, {"section": "y:0.4"}):
                sheet = Sheet(zraster.drawing(source, **options))
                right, low = (410, 287) if options.get("page") != "a4" else (200, 287)
                for x, y in sheet.all_points("frame"):
                    self.assertTrue(20 - 1e-6 <= x <= right + 1e-6 and 10 - 1e-6 <= y <= low + 1e-6, (source, options, x, y))
                for i, (label, box) in enumerate(sheet.texts):
                    for other, other_box in sheet.texts[:i]:
                        self.assertFalse(overlap(box, other_box), (source, options, label, other))
                checked += 1
        self.assertGreaterEqual(checked, 8)

    def test_repeated(self):
        """the same bytes for every number of threads, and of a scene that was read"""
        scene = zraster.Scene(PLATE)
        for format in ("svg", "png"):
            files = {zraster.drawing(PLATE, section="x", format=format, renderer=zraster.Renderer(threads=threads)).data
                     for threads in (1, 2, 5)}  # fmt: skip
            files.add(zraster.drawing(scene, section="x", format=format).data)
            self.assertEqual(len(files), 1)

    def test_pixels(self):
        """a PNG has the size of the paper"""
        for page, dpi, size in (("a3", 150, (2480, 1754)), ("a4", 75, (620, 877))):
            found = zraster.drawing(PLATE, page=page, dpi=dpi, format="png")
            self.assertEqual(found.type, "image/png")
            self.assertEqual(struct.unpack(">II", found.data[16:24]), size)

    def test_units(self):
        """lengths of a file with a unit are millimetres"""
        import base64
        import json

        corners = [(x, y, z) for x in (0, 0.04) for y in (0, 0.02) for z in (0, 0.01)]
        faces = [0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3]
        data = b"".join(struct.pack("<3f", *corner) for corner in corners) + struct.pack("<36H", *faces)
        file = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
            "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [0.04, 0.02, 0.01]},
                          {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
        }  # fmt: skip
        sheet = Sheet(zraster.drawing(json.dumps(file).encode()))
        self.assertEqual(sheet.root.get("data-scale"), "2:1")
        self.assert_near(sheet.size("front"), (40, 20))
        self.assertIn("mm", sheet.labels())
        self.assertIn("40 \u00d7 10 \u00d7 20", sheet.labels())

    @needs_numpy
    @unittest.skipUnless(shutil.which("rsvg-convert"), "there is no rsvg-convert (librsvg2-bin)")
    def test_same_ink(self):
        """the pixels of a PNG are those that librsvg draws of the SVG"""
        import numpy

        def grown(ink):
            out = ink.copy()
            for axis in (0, 1):
                for by in (-1, 1):
                    out |= numpy.roll(ink, by, axis)
            return out

        ours = dark(zraster.drawing(PLATE, section="x", format="png", dpi=100).data)
        svg = zraster.drawing(PLATE, section="x").data
        theirs = dark(subprocess.run(["rsvg-convert", "-w", "1654", "-h", "1169"], input=svg, capture_output=True, check=True).stdout)
        self.assertGreater(ours.sum(), 10000)
        self.assertLess((ours & ~grown(theirs)).sum(), 0.005 * ours.sum())
        self.assertLess((theirs & ~grown(ours)).sum(), 0.005 * theirs.sum())

    def test_files(self):
        """a file's name is the title, and save writes the bytes"""
        path = os.path.join(models, "parts", "gear.obj")
        if not os.path.exists(path):
            self.skipTest("there is no model gear.obj")
        found = zraster.drawing(path)
        self.assertIn("gear.obj", Sheet(found).labels())
        self.assertIn("6\u00d7 \u00f80.26 through", Sheet(found).labels())
        name = os.path.join(os.environ.get("TMPDIR", "/tmp"), f"zraster-drawing-{os.getpid()}.svg")
        found.save(name)
        self.assertEqual(read(name), found.data)
        os.remove(name)

    def test_warnings(self):
        """open parts have no caps, and other parts do"""
        mesh = PLATE["meshes"][0]
        opened = {"meshes": [{**mesh, "name": "open", "faces": mesh["faces"][:-1]}]}
        self.assertEqual(zraster.drawing(PLATE, section="x").warnings, [])
        facts = zraster.drawing(PLATE, page="a4").facts
        self.assertEqual((facts["page"], facts["scale"], facts["warnings"]), ("a4", "1:1", []))
        self.assertIn("not closed", " ".join(zraster.drawing(opened, section="x").warnings))
        self.assertEqual(zraster.drawing(PLATE, title="\u65e5\u672c").warnings, ["title or date has characters that have no glyph: drawn as boxes"])

    def test_refusals(self):
        """wrong parameters and scenes without a drawing"""
        for options, text in (
            ({"page": "a5"}, "a5"),
            ({"scale": "2"}, "scale"),
            ({"scale": "0:1"}, "scale"),
            ({"projection": "both"}, "projection"),
            ({"section": "w"}, "section"),
            ({"section": "x:1"}, "section"),
            ({"dpi": 5000}, "dpi"),
        ):
            with self.assertRaisesRegex(zraster.OptionError, text):
                zraster.drawing(PLATE, **options)
        with self.assertRaisesRegex(zraster.SceneError, "do not fit on A4 at 10:1; .* is 1:1"):
            zraster.drawing(PLATE, page="a4", scale="10:1")
        lines = {"meshes": [{"positions": [[0, 0, 0], [1, 1, 1]], "lines": [[0, 1]]}]}
        for scene, text in (
            (lines, "edges of faces"),
            ({**PLATE, "views": [{"view": {"preset": "front"}}]}, "several views"),
            ({**PLATE, "sections": {"planes": [{"axis": "x"}]}}, "sections"),
        ):
            with self.assertRaisesRegex(zraster.SceneError, text):
                zraster.drawing(scene)


if __name__ == "__main__":
    unittest.main()
