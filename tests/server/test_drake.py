"""POST /render, Drake's protocol: a client posts its forms, and answers are compared with /v1/render, pixel by pixel."""
import base64
import hashlib
import json
import math
import os
import re
import struct
import unittest
import zlib

import numpy

import daemon


# ---- a daemon and its clients ----


class Daemon(daemon.Daemon):
    def send(self, path, body=None, **headers):
        """Returns status, type and bytes."""
        status, headers, data = super().send(path, body, **headers)
        return status, headers["Content-Type"], data

    def post(self, path, parts, **headers):
        """Posts a form; `parts` are pairs of a name and bytes, or a value."""
        boundary = b"a1b2c3boundary"
        body = b""
        for name, value in parts:
            is_file = isinstance(value, bytes)
            body += b'--%s\r\nContent-Disposition: form-data; name="%s"' % (boundary, name.encode())
            body += b'; filename="s.gltf"\r\nContent-Type: model/gltf+json' if is_file else b""
            body += b"\r\n\r\n" + (value if is_file else str(value).encode()) + b"\r\n"
        body += b"--%s--\r\n" % boundary
        return self.send(path, body, Content_Type=f"multipart/form-data; boundary={boundary.decode()}", **headers)

    def scene(self, gltf, scene):
        """Returns the answer of /v1/render to a scene with the file."""
        status, _, data = self.post("/v1/render", [("scene", json.dumps(scene)), ("file", gltf)])
        assert status == 200, data
        return data


# ---- files ----


def png(pixels):
    """Returns an RGB PNG."""
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">2I5B", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def read_png(data):
    """Returns the colour type and the pixels: palettes as RGB, RGB, RGBA, or 16-bit grey."""
    at, body, palette = 8, b"", None
    while at < len(data):
        (size,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        chunk = data[at + 8 : at + 8 + size]
        at += 12 + size
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">2I2B", chunk[:10])
        body += chunk if kind == b"IDAT" else b""
        palette = numpy.frombuffer(chunk, "u1").reshape(-1, 3) if kind == b"PLTE" else palette
    pixel = {0: 2, 2: 3, 3: 1, 6: 4}[color]
    assert depth == (16 if color == 0 else 8)
    lines = numpy.frombuffer(zlib.decompress(body), "u1").reshape(height, 1 + width * pixel).astype(int)
    rows = numpy.zeros((height + 1, width + 1, pixel), int)  # with a border of zeros
    for y, line in enumerate(lines):
        line, above, row = line[1:].reshape(width, pixel), rows[y], rows[y + 1]
        if line_is_plain := lines[y][0] in (0, 2):
            row[1:] = (line + (above[1:] if lines[y][0] else 0)) % 256
        for x in range(0 if line_is_plain else width):
            a, b, c = row[x], above[x + 1], above[x]
            paeth = numpy.abs([b - c, a - c, a + b - 2 * c])
            nearest = numpy.where((paeth[0] <= paeth[1]) & (paeth[0] <= paeth[2]), a, numpy.where(paeth[1] <= paeth[2], b, c))
            row[x + 1] = (line[x] + [a, None, (a + b) // 2, nearest][lines[y][0] - 1]) % 256
    pixels = rows[1:, 1:].astype("u1")
    if color == 0:
        pixels = pixels.view(">u2")[..., 0]
    return color, palette[pixels[..., 0]] if color == 3 else pixels


def read_npy(data):
    head = struct.unpack("<H", data[8:10])[0]
    shape = [int(side) for side in re.search(rb"\((\d+), (\d+)", data).groups()]
    return numpy.frombuffer(data, "<u4" if b"<u4" in data[: head + 10] else "<f4", offset=head + 10).reshape(shape)


def read_tiff(data):
    """Returns the floats of a TIFF of one sample per pixel."""
    assert data[:4] == b"II*\0"
    (at,) = struct.unpack("<I", data[4:8])
    (count,) = struct.unpack("<H", data[at : at + 2])
    entries = [struct.unpack("<HHII", data[at + 2 + 12 * i : at + 14 + 12 * i]) for i in range(count)]
    assert [tag for tag, *_ in entries] == sorted(tag for tag, *_ in entries)
    fields = {tag: value if kind == 4 else value & 0xFFFF for tag, kind, size, value in entries if size == 1}
    assert (fields[258], fields[259], fields[277], fields[339]) == (32, 1, 1, 3), fields
    assert fields[278] == fields[257] and fields[279] == fields[256] * fields[257] * 4
    assert len(data) == fields[273] + fields[279]
    return numpy.frombuffer(data, "<f4", offset=fields[273]).reshape(fields[257], fields[256])


def uri(type_, data):
    return f"data:{type_};base64," + base64.b64encode(data).decode()


BOX = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
LABELS = [(12, 34, 56), (255, 128, 1), (0, 200, 77)]  # materials


def boxes(places, camera, **more):
    """Returns a glTF file: a box per place, with textures and colours of vertices; materials in turn."""
    corners = [BOX[i] for quad in QUADS for i in quad]
    tables = [
        (numpy.array(corners, "<f4"), "VEC3", 5126),
        (numpy.array([(0, 0), (1, 0), (1, 1), (0, 1)] * 6, "<f4"), "VEC2", 5126),
        (numpy.array([(255, 90, 200, 255)] * 24, "u1"), "VEC4", 5121),
        (numpy.array([[4 * f, 4 * f + 1, 4 * f + 2, 4 * f, 4 * f + 2, 4 * f + 3] for f in range(6)], "<u2"), "SCALAR", 5123),
    ]
    data = b"".join(table.tobytes() for table, *_ in tables)
    views, accessors, at = [], [], 0
    for number, (table, kind, component) in enumerate(tables):
        views.append({"buffer": 0, "byteOffset": at, "byteLength": table.nbytes})
        count = table.size // {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
        accessor = {"bufferView": number, "componentType": component, "count": count, "type": kind}
        accessors.append({**accessor, "normalized": True} if number == 2 else accessor)
        at += table.nbytes
    checks = numpy.indices((16, 16)).sum(0) % 2 * 120 + 100
    image = uri("image/png", png(numpy.stack([checks, checks, 255 - checks], -1).astype("u1")))
    materials = []
    for number, label in enumerate(LABELS):
        factors = {"baseColorFactor": [part / 255 for part in label] + [0.5 if number == 1 else 1], "roughnessFactor": 0.6}
        textures = {"baseColorTexture": {"index": 0}} if number < 2 else {}
        materials.append({"pbrMetallicRoughness": {**factors, **textures}})
    materials[1]["alphaMode"] = "BLEND"
    materials[2]["emissiveFactor"] = [0.3, 0.1, 0]
    attributes = {"POSITION": 0, "TEXCOORD_0": 1, "COLOR_0": 2}
    primitive = lambda number: {"attributes": attributes, "indices": 3, "material": number}
    nodes = [{"mesh": number % 3, "translation": place, "scale": [0.5, 0.4, 0.3]} for number, place in enumerate(places)]
    nodes.append({"camera": 0, "matrix": camera.T.ravel().tolist(), "name": "Camera Node"})
    return json.dumps({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": [{"primitives": [primitive(number)]} for number in range(3)],
        "materials": materials,
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.3, "zfar": 40, "aspectRatio": 1}}],
        "textures": [{"source": 0}],
        "images": [{"uri": image}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": uri("application/octet-stream", data)}],
        **more,
    }).encode()  # fmt: skip


def looking(eye, target, up=(0, 0, 1)):
    """Returns a camera-to-world matrix."""
    back = numpy.subtract(eye, target) / math.dist(eye, target)
    right = numpy.cross(up, back)
    right /= numpy.linalg.norm(right)
    matrix = numpy.eye(4)
    matrix[:3] = numpy.stack([right, numpy.cross(back, right), back, eye], 1)
    return matrix


NEAR_BOX = [-0.6, -3.2, 1.2]
PLACES = [[0, 0, 0], [1.3, 0.4, 0.2], [-1.1, 0.8, -0.3], NEAR_BOX, [0.4, 9, 0.5], [-3.5, 15, 0.5]]
SCENES = [
    ("six boxes", boxes(PLACES, looking((0.2, -4, 1.4), (0, 0, 0.1))), looking((0.2, -4, 1.4), (0, 0, 0.1)),
     dict(width=161, height=120, focal_x=150.25, focal_y=131.5, center_x=70.125, center_y=66.75)),
    ("from above", boxes(PLACES[:3], looking((0.5, 0.2, 5), (0, 0, 0), (0, 1, 0))),
     looking((0.5, 0.2, 5), (0, 0, 0), (0, 1, 0)),
     dict(width=96, height=130, focal_x=110, focal_y=160, center_x=60, center_y=40)),
]  # fmt: skip
PLANES = {"near": 0.25, "far": 30}
DEPTHS = {"min_depth": 0.9, "max_depth": 12.5}


def form(gltf, kind, intrinsics, **changes):
    """Returns the fields that Drake's client sends, as it writes them."""
    numbers = {**intrinsics, **PLANES, **(DEPTHS if kind == "depth" else {})}
    numbers["fov_x"] = 2 * math.atan(intrinsics["width"] / 2 / intrinsics["focal_x"])
    numbers["fov_y"] = 2 * math.atan(intrinsics["height"] / 2 / intrinsics["focal_y"])
    texts = {name: str(value) if isinstance(value, int) else f"{value:.6f}" for name, value in numbers.items()}
    fields = {"scene_sha256": hashlib.sha256(gltf).hexdigest(), "image_type": kind, **texts, "submit": "Render"}
    fields = {**fields, "scene": gltf, **changes}
    return [(name, value) for name, value in fields.items() if value is not None]


def view(camera, intrinsics):
    focal = {"fx": intrinsics["focal_x"], "fy": intrinsics["focal_y"]}
    center = {"cx": intrinsics["center_x"], "cy": intrinsics["center_y"]}
    window = {"width": intrinsics["width"], "height": intrinsics["height"]}
    planes = {"znear": PLANES["near"], "zfar": PLANES["far"]}
    pose = {"cameraToWorld": camera.tolist(), "intrinsics": {**focal, **center}, **planes}
    return {"window": window, "view": pose, "meshes": [{"asset": "file"}]}


class Drake(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()

    def ask(self, gltf, kind, intrinsics, type_="image/png", **headers):
        status, got, data = self.daemon.post("/render", form(gltf, kind, intrinsics), **headers)
        self.assertEqual((status, got), (200, type_), data)
        return data

    def depths(self, gltf, camera, intrinsics):
        scene = view(camera, intrinsics)
        scene["meshes"][0]["alphaMode"] = "OPAQUE"
        depth = read_npy(self.daemon.scene(gltf, {**scene, "outputs": [{"channel": "depth"}]}))
        self.assertEqual(depth.shape, (intrinsics["height"], intrinsics["width"]))
        return depth

    def test_color(self):
        """colour images are RGBA, and equal those of /v1/render"""
        for name, gltf, camera, intrinsics in SCENES:
            with self.subTest(name):
                kind, got = read_png(self.ask(gltf, "color", intrinsics))
                look = {"look": "studio", "up": "z", "edges": False, "groundShadow": False, "samples": 4}
                _, wanted = read_png(self.daemon.scene(gltf, {**view(camera, intrinsics), **look}))
                self.assertEqual(kind, 6)
                self.assertTrue((got[..., 3] == 255).all() and (got[..., :3] == wanted[..., :3]).all())
                self.assertGreater(len(numpy.unique(got.reshape(-1, 4), axis=0)), 500)

    def test_depth(self):
        """depths are 16-bit millimetres: 0 too close, 65535 too far"""
        for name, gltf, camera, intrinsics in SCENES:
            with self.subTest(name):
                kind, got = read_png(self.ask(gltf, "depth", intrinsics))
                depth = self.depths(gltf, camera, intrinsics)
                wanted = numpy.rint(depth / numpy.float32(0.001))
                wanted[depth < numpy.float32(DEPTHS["min_depth"])] = 0
                wanted[depth > numpy.float32(DEPTHS["max_depth"])] = 65535
                self.assertEqual(kind, 0)
                self.assertTrue((got == wanted).all())
                if name == "six boxes":
                    boxes_there = [(got == 0).sum(), (numpy.isfinite(depth) & (got == 65535)).sum()]
                    self.assertTrue(min(*boxes_there, numpy.isinf(depth).sum()) > 50, boxes_there)

    def test_tiff(self):
        """depths are floats in metres if the client accepts a TIFF: 0 too close, infinity too far"""
        for name, gltf, camera, intrinsics in SCENES:
            with self.subTest(name):
                got = read_tiff(self.ask(gltf, "depth", intrinsics, "image/tiff", Accept="image/tiff"))
                depth = self.depths(gltf, camera, intrinsics)
                wanted = numpy.where(depth > numpy.float32(DEPTHS["max_depth"]), numpy.inf, depth)
                wanted = numpy.where(depth < numpy.float32(DEPTHS["min_depth"]), 0, wanted)
                self.assertTrue((got == wanted).all())

    def test_accept(self):
        """Accept chooses between PNG and TIFF by name and weight, for depths only"""
        _, gltf, _, intrinsics = SCENES[1]
        for accept, type_ in (
            ("*/*", "image/png"),
            ("image/*", "image/png"),
            ("image/png, image/tiff;q=0.5", "image/png"),
            ("image/tiff; q=0", "image/png"),
            ("text/html, IMAGE/TIFF ;q=0.5, */*;q=0.1", "image/tiff"),
        ):
            with self.subTest(accept):
                self.ask(gltf, "depth", intrinsics, type_, Accept=accept)
        self.ask(gltf, "color", intrinsics, "image/png", Accept="image/tiff")

    def test_label(self):
        """labels are the materials' base colours as they stand, on white"""
        for name, gltf, camera, intrinsics in SCENES:
            with self.subTest(name):
                kind, got = read_png(self.ask(gltf, "label", intrinsics))
                scene = view(camera, intrinsics)
                scene["meshes"][0]["alphaMode"] = "OPAQUE"
                ids = read_npy(self.daemon.scene(gltf, {**scene, "outputs": [{"channel": "instanceId"}]}))
                colors = numpy.array([(255, 255, 255)] + [LABELS[number % 3] for number in range(6)], "u1")
                self.assertEqual(kind, 6)
                self.assertTrue((got[..., 3] == 255).all() and (got[..., :3] == colors[ids]).all())
                self.assertGreaterEqual(len(numpy.unique(ids)), 4)

    def test_scene(self):
        """a label is what /v1/render draws in the colours of materials, byte for byte"""
        _, gltf, camera, intrinsics = SCENES[0]
        scene = {**view(camera, intrinsics), "colors": "materials", "outputs": [{"channel": "color", "encoding": "png32"}]}
        scene["meshes"][0].update(shading="unlit", alphaMode="OPAQUE")
        self.assertEqual(self.ask(gltf, "label", intrinsics), self.daemon.scene(gltf, scene))

    def test_hash(self):
        """a hash of 64 digits must be that of the file; another text is ignored"""
        _, gltf, _, intrinsics = SCENES[1]
        right = hashlib.sha256(gltf).hexdigest()
        for text in (right.upper(), "of the scene", "", None):
            with self.subTest(text):
                self.assertEqual(self.daemon.post("/render", form(gltf, "label", intrinsics, scene_sha256=text))[0], 200)
        status, type_, data = self.daemon.post("/render", form(gltf, "label", intrinsics, scene_sha256="0" * 64))
        self.assertEqual((status, type_), (400, "text/plain; charset=utf-8"))
        self.assertIn(right, data.decode())

    def test_loop(self):
        """frames that differ in matrices only equal those of a daemon that keeps nothing, and so do changed URIs"""
        pixels = numpy.random.default_rng(7).integers(0, 256, (120, 128, 3), "u1")
        noise, other = (uri("image/png", png(shifted)) for shifted in (pixels, numpy.roll(pixels, 1, 0)))
        self.assertEqual(len(noise), len(other))
        self.assertGreater(len(noise), 1 << 15)
        changed = noise[:-200] + ("A" if noise[-200] != "A" else "B") + noise[-199:]  # its PNG has a wrong checksum
        daemons = Daemon(), Daemon("--keep-text-bytes=0", "--keep-image-bytes=0", "--keep-mesh-bytes=0")
        for daemon in daemons:
            self.addCleanup(daemon.stop)

        def frame(number, image, kind):
            eye = (0.3 + 0.05 * number, -4, 1.4)
            gltf = boxes(PLACES, looking(eye, (0, 0, 0.1)), images=[{"uri": "IMAGE"}]).replace(b"IMAGE", image.encode())
            return form(gltf, kind, SCENES[0][3])

        sent = 0
        escaped = noise.replace("/", "\\/")
        for number, image in enumerate((noise, noise, noise, other, noise, other, changed, other, escaped, changed, changed)):
            for kind in ("color", "depth", "label"):
                with self.subTest(number=number, kind=kind):
                    got, wanted = (daemon.post("/render", frame(number, image, kind)) for daemon in daemons)
                    self.assertEqual(got, wanted)
                    self.assertEqual(got[0], 400 if image is changed else 200)
                    sent += 1
        counts = [json.loads(daemon.send("/healthz")[2])["texts"] for daemon in daemons]
        self.assertEqual(counts[0]["count"], 3)  # that of the refused image, too
        self.assertGreater(counts[0]["hits"], 10)
        self.assertGreater(counts[0]["bytes"], 3 * len(noise))
        self.assertEqual([counts[1][name] for name in ("count", "hits", "misses")], [0, 0, 0])
        again = [daemons[0].post("/render", frame(1, noise, "color")) for _ in range(2)]
        self.assertEqual(again[0], again[1])

    def test_wrong_fields(self):
        """wrong fields are refused in plain text, with name, value and what is expected"""
        rows = os.path.join(os.path.dirname(__file__), "wrong-drake-fields.txt")
        _, gltf, _, intrinsics = SCENES[1]
        with open(rows) as file:
            cases = [line.rstrip("\n").split(" | ") for line in file if line.strip() and line[0] != "#"]
        for kind, change, *wanted in cases:
            with self.subTest(kind + ": " + change):
                name, has_value, value = change.partition("=")
                changes = {name: value if has_value else None}
                if name == "scene" and has_value:
                    changes = {"scene": value.encode(), "scene_sha256": None}
                status, type_, data = self.daemon.post("/render", form(gltf, kind, intrinsics, **changes))
                self.assertEqual((status, type_), (400, "text/plain; charset=utf-8"), data)
                lines = data.decode().splitlines()
                self.assertEqual(len(lines), len(wanted), lines)
                for line, text in zip(lines, wanted):
                    self.assertIn(text, line)

    def test_other_faults(self):
        """a field given twice, other methods, bodies and parameters are refused in plain text"""
        _, gltf, _, intrinsics = SCENES[1]
        fields = form(gltf, "color", intrinsics)
        for wanted, text, (status, type_, data) in (
            (400, "the same name: 'width'", self.daemon.post("/render", [*fields, ("width", 9)])),
            (405, "/render takes POST", self.daemon.send("/render")),
            (400, "multipart/form-data is expected", self.daemon.send("/render", b"{}", Content_Type="application/json")),
            (400, "without a boundary", self.daemon.send("/render", b"{}", Content_Type="multipart/form-data")),
            (400, "no parameters", self.daemon.post("/render?look=clay", fields)),
        ):
            with self.subTest(text):
                self.assertEqual((status, type_), (wanted, "text/plain; charset=utf-8"))
                self.assertIn(text, data.decode())

    def test_limits(self):
        """limits of /v1/render apply: a request that takes too much is refused with 400, a slow one ends with 504"""
        _, gltf, _, intrinsics = SCENES[1]
        large = {**intrinsics, "width": 4000, "height": 4000}
        for flag, kind, wanted, text in (
            ("--cost-max-ms=1", "color", 400, "costMaxMs"),
            ("--render-timeout-ms=20", "color", 504, "renderTimeoutMs"),
            ("--request-memory-bytes=67108864", "depth", 400, "requestMemoryBytes"),
        ):
            daemon = Daemon(flag)
            self.addCleanup(daemon.stop)
            with self.subTest(flag):
                status, type_, data = daemon.post("/render", form(gltf, kind, large))
                self.assertEqual((status, type_), (wanted, "text/plain; charset=utf-8"), data)
                self.assertIn(text, data.decode())


if __name__ == "__main__":
    unittest.main()
