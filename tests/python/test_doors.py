"""All doors give one answer: the daemon by HTTP, the command here and by --server, the package here and by server=, and
the tools for agents by POST /mcp and by `zraster mcp`.

A short run has every ninth scene of tests/scenes and models of its own. DOORS=400 draws that many: all scenes, then the
models of ZRASTER_DATA, with the files beside them."""
import base64
import glob
import itertools
import json
import os
import re
import subprocess
import tempfile
import unittest
import urllib.parse
import warnings

import support
import zraster
from support import build

CHANNELS = "color,depth,windowDepth,faceId,info,distance,instanceId,frontFacing,barycentrics,position,normals,layers,thickness,fragments,masks"
FEW = "color,depth,faceId,info,fragments"
PARTS = "".join(
    f"o {name}\n" + "".join(f"v {x + a} {b} {c}\n" for c in (0, 1) for b in (0, 1) for a in (0, 1))
    + "".join("f " + " ".join(str(8 * number + int(i)) for i in face) + "\n" for face in ("1342", "5687", "1265", "3784", "1573", "2486"))
    for number, (name, x) in enumerate((("left", 0), ("right", 1.5), ("Übermaß & <far>", 4)))
)
TYPES = {"json": "application/json", **{kind: "model/" + kind for kind in ("obj", "stl", "ply", "3mf")}, "glb": "model/gltf-binary", "gltf": "model/gltf+json"}
META = {"io.modelcontextprotocol/protocolVersion": "2026-07-28", "io.modelcontextprotocol/clientCapabilities": {}}


class Doors:
    """A daemon, the command and an agent's pipe, for files below one folder."""

    def __init__(self, root):
        self.root, self.daemon = root, support.Daemon()
        command = [os.path.join(build, "zraster"), "mcp", "--root", root]
        self.pipe = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.numbers = itertools.count(1)

    def close(self):
        self.pipe.communicate()
        self.daemon.stop()

    def http(self, path, query):
        """Returns the answer's bytes, or the words of its faults."""
        with open(path, "rb") as file:
            kind = TYPES[path.rpartition(".")[2]]
            status, _, data = self.daemon.request("/v1/render?" + urllib.parse.urlencode(query), file.read(), {"Content-Type": kind})
        if status == 200:
            return data
        problem = json.loads(data)
        return [fault["detail"] for fault in problem.get("errors", [])] or [problem["detail"]]

    def command(self, path, query, server=None):
        flags = [text for name, value in query.items() for text in ("--" + re.sub("[A-Z]", lambda m: "-" + m[0].lower(), name), value)]
        command = [os.path.join(build, "zraster"), path, "-q", "-o", "-", *flags, *(["--server", server] if server else [])]
        done = subprocess.run(command, capture_output=True, env={**os.environ, "ZRASTER_SERVER": ""})
        return done.stdout if done.returncode == 0 else done.stderr.decode()

    def package(self, path, query, server=None):
        options = {re.sub("[A-Z]", lambda m: "_" + m[0].lower(), name): value for name, value in query.items()}
        channels = options.pop("channel").split(",")
        for number, channel in enumerate(channels):
            if channel == "fragments":
                channels[number] = {"channel": channel, "x": int(options.pop("x")), "y": int(options.pop("y"))}
        for name in ("views", "hide"):
            if name in options:
                options[name] = options[name].split(",")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return zraster.render(path, channels, server=server, **options).content
        except zraster.Error as error:
            return str(error)

    def agent(self, tool, arguments, by_pipe):
        message = {"jsonrpc": "2.0", "id": next(self.numbers), "method": "tools/call", "params": {"name": tool, "arguments": arguments, "_meta": META}}
        if by_pipe:
            self.pipe.stdin.write(json.dumps(message) + "\n")
            self.pipe.stdin.flush()
            return json.loads(self.pipe.stdout.readline())["result"]
        headers = {"Content-Type": "application/json", "MCP-Protocol-Version": "2026-07-28", "Mcp-Method": "tools/call", "Mcp-Name": tool}
        return json.loads(self.daemon.request("/mcp", json.dumps(message).encode(), headers)[2])["result"]


class Equal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder, cls.doors = folder.name, Doors(folder.name)
        cls.addClassCleanup(cls.doors.close)
        cls.parts = cls.write("parts.obj", PARTS)

    @classmethod
    def write(cls, name, text):
        path = os.path.join(cls.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text if isinstance(text, str) else json.dumps(text))
        return path

    def check(self, path, query, has_files=False):
        """Fails unless all doors give the same bytes, or refuse for the same reason. Returns the bytes, or None."""
        want = self.doors.http(path, query)
        if has_files:  # beside the model: the command sends them to the daemon
            want = self.doors.command(path, query, self.doors.daemon.address)
            want = want if isinstance(want, bytes) else []
        for name, got in (
            ("command", self.doors.command(path, query)), ("command --server", self.doors.command(path, query, self.doors.daemon.address)),
            ("package", self.doors.package(path, query)), ("package server=", self.doors.package(path, query, self.doors.daemon.address)),
        ):
            with self.subTest(os.path.basename(path), door=name, query=query):
                if isinstance(want, bytes):
                    self.assertTrue(got == want, got[:300] if isinstance(got, str) else "other bytes")
                else:
                    self.assertIsInstance(got, str, want)
                    for words in want:
                        self.assertIn(words.removeprefix("parameter ").split("; ")[0][:60], got)
        return want if isinstance(want, bytes) else None

    def check_all(self, path):
        """All channels of a scene or model at a pixel near its middle. If one is refused, those that all have."""
        pixel = {"x": "33", "y": "24"}
        scene = {} if path.endswith(".json") else {"width": "96", "height": "72"}
        has_files = path.endswith(".gltf") or b"mtllib" in support.read(path)
        if not self.check(path, {"channel": CHANNELS, **pixel, **scene, "visibility": "true"}, has_files):
            self.check(path, {"channel": FEW, **pixel, **scene}, has_files)

    def test_scenes(self):
        """scenes and models have the same outputs by each door"""
        count = int(os.environ.get("DOORS", "0"))
        scenes = sorted(glob.glob(os.path.join(support.scenes, "*.json")))
        models = sorted(name for kind in ("obj", "stl", "ply", "glb", "3mf", "gltf") for name in glob.glob(os.path.join(os.path.dirname(support.models), "**", "*." + kind), recursive=True)) if count else []
        for path in ((scenes + models)[:count] if count else scenes[::9]) + [self.parts]:
            self.check_all(path)

    def test_several_views(self):
        """sheets and views, of the query and of scenes, are the same by each door, and equal those of the key"""
        plain = os.path.join(support.scenes, "nodes-hierarchy.json")
        keys = {"views": ["top", "front"], "turntable": {"frames": 3, "elevation": 20}, "orbit": {"count": 2}, "sheet": {"layout": "threeView"}}
        queries = {"views": {"views": "top,front"}, "turntable": {"turntable": "3", "turntableElevation": "20"}, "orbit": {"orbit": "2"}, "sheet": {"sheet": "threeView"}}
        with open(plain, encoding="utf-8") as file:
            text = json.load(file)
        for key, query in queries.items():
            only = {**query, "channel": "color,info" if key == "sheet" else "color,depth,info"}
            own = self.write("own.json", {**text, key: keys[key]})
            other = self.write("other.json", {**text, **({"turntable": {"frames": 2}} if key != "turntable" else {"views": ["left"]})})
            want = self.doors.http(own, {"channel": only["channel"]})
            self.assertIsInstance(want, bytes)
            for path in (plain, other):  # the query overrides the scene's own views
                self.assertTrue(self.check(path, only) == want, key)
            self.check(self.parts, {**only, "width": "120", "height": "90"})
        self.check(plain, {"channel": "color", "views": "top,front", "sheet": "views", "sheetColumns": "1"})
        want = self.doors.http(self.write("own.json", {**text, "window": {"width": 60, "height": 45}, "views": [{"name": "a"}, "top"]}), {"channel": "color,depth"})
        sized = self.write("sized.json", {**text, "views": [{"name": "a", "window": {"width": 9, "height": 9}}, "top"]})
        self.assertTrue(self.check(sized, {"channel": "color,depth", "width": "60", "height": "45"}) == want)
        named = self.write("named.json", {**text, "view": "top"})
        want = self.check(named, {"channel": "color"})
        self.write("named.json", {**text, "view": {"preset": "top"}})
        self.assertTrue(want == self.check(named, {"channel": "color"}))

    def test_agents(self):
        """tools for agents measure, draw and name what /v1/render does, by HTTP and by the pipe"""
        size = {"width": 120, "height": 90}
        view = {"azimuthDegrees": 30, "elevationDegrees": 25, "orthographic": {}}
        models = [self.parts]
        if os.environ.get("DOORS"):
            models += [self.write(os.path.basename(path), support.read(path).decode()) for path in sorted(glob.glob(os.path.join(support.models, "*.obj")))]
        for path in models:
            text = support.read(path).decode()
            for scene in ({"view": view}, {"views": ["top"]}, {"sheet": "threeView"}, {"sheet": "balanced", "explode": 0.5}):
                with self.subTest(os.path.basename(path), scene=scene):
                    given = {"scene": {"window": size, **scene}}
                    self.check_agents(path, text, given, scene)

    def check_agents(self, path, text, given, scene):
        places = [(x, y) for x in (20, 30, 60, 90) for y in (22, 45, 68)]
        results = {}
        for by_pipe, model in ((True, {"path": os.path.basename(path)}), (False, {"text": text})):
            ask = lambda tool, **more: self.doors.agent(tool, {"model": model, **given, **more}, by_pipe)
            made = [ask("facts"), ask("render")]
            if "sheet" in scene:
                boxes = [view["box"] for view in made[1]["structuredContent"]["views"]]
                places = [(int(a + (c - a) * share), (b + d) // 2) for a, b, c, d in boxes for share in (0.25, 0.4, 0.75)]
            results[by_pipe] = made + [ask("pick", x=x, y=y) for x, y in places]
        self.assertEqual(results[True], results[False])
        facts, drawn, *picks = results[True]
        self.assertFalse(facts["isError"] or drawn["isError"], facts)
        whole = {"meshes": [{"asset": "parts"}], "view": {"preset": "isometric", "orthographic": {}}, **given["scene"]}
        answer = zraster.render({**whole, "look": drawn["structuredContent"]["picture"]["look"]}, ["color", "info"], parts={"parts": text.encode()}, compress="fast")
        image = next(block["data"] for block in drawn["content"] if block["type"] == "image")
        files = [answer.file(name) for name in answer if name.endswith("color")]
        self.assertIn(base64.b64decode(image), files)
        info = json.loads(next(answer.file(name) for name in answer if name.endswith("info")))
        for part, want in zip(facts["structuredContent"]["parts"], info["parts"], strict=True):
            for key in ("name", "id", "triangles", "area", "volume", "closed"):
                if isinstance(want[key], float):  # tools for agents may print 15 digits of 17
                    self.assertAlmostEqual(part[key] / want[key], 1, delta=1e-15, msg=key)
                else:
                    self.assertEqual(part[key], want[key], key)
        boxes = {part["name"]: part["box"] for part in facts["structuredContent"]["parts"]}
        found = [fragment for pick in picks for fragment in pick["structuredContent"]["fragments"]]
        self.assertTrue(found)
        for fragment in found:  # each point lies in the box of the part that it names
            box = boxes[fragment["part"]]
            for low, at, high, size in zip(box["min"], fragment["point"], box["max"], facts["structuredContent"]["box"]["size"]):
                self.assertTrue(low - 1e-4 * size <= at <= high + 1e-4 * size, (fragment, box))
        for content in [] if "sheet" in scene else [pick["structuredContent"] for pick in picks]:
            pixel = {"channel": "fragments", "x": content["x"], "y": content["y"]}
            there = zraster.render(whole, [pixel], parts={"parts": text.encode()})
            fragments = json.loads(next(iter(there.file(name) for name in there)))["fragments"]
            self.assertEqual([(f["part"], f["face"]) for f in content["fragments"]], [(f["part"], f["faceId"]) for f in fragments[:len(content["fragments"])]])


if __name__ == "__main__":
    unittest.main()
