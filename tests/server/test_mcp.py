"""POST /mcp and `zraster mcp`: the revisions of the protocol, its errors, and the tools, whose pictures are those of /v1/render."""
import base64
import hashlib
import json
import math
import os
import random
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

import daemon

build = daemon.build
MODERN = "2026-07-28"
KEY = "io.modelcontextprotocol/"
META = {KEY + "protocolVersion": MODERN, KEY + "clientCapabilities": {}}
BYTES_MAX, SIDE_MAX = 700000, 1568

# A box of 20 x 10 x 5 with all faces outwards, and a plate beside it that is open.
CORNERS = "".join(f"v {x} {y} {z}\n" for z in (0, 5) for y in (0, 10) for x in (0, 20))
SIDES = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"
BOX = CORNERS + "o block\n" + SIDES
ASSEMBLY = BOX + "v 30 0 0\nv 40 0 0\nv 40 10 0\nv 30 10 0\no plate\nf 9 10 11 12\n"


def cube(x, name):
    """Returns a mesh of a scene: a cube of side 1 at x."""
    corners = [[x + i, j, k] for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    return {"name": name, "positions": corners, "faces": [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]}


def plate(x=0, hole=0, radius=1, sides=36, name="plate"):
    """Returns a mesh of a scene: a plate of 10 x 10 x 2 around x with a hole of many sides, moved by `hole`. Triangles alone."""
    turn = lambda i: (hole + radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides))
    corners, rim, side = [(5, 5), (-5, 5), (-5, -5), (5, -5)], [turn(i) for i in range(sides)], 4 + sides
    places = [[x + u, v, z] for z in (0, 2) for u, v in corners + rim]
    faces = []
    for i in range(sides):
        j, own, next_own = (i + 1) % sides, 4 * i // sides, 4 * ((i + 1) % sides) // sides
        for top in (0, side):
            made = [[top + 4 + i, top + own, top + 4 + j]] + ([[top + own, top + next_own, top + 4 + j]] if own != next_own else [])
            faces += [face if top else face[::-1] for face in made]
        faces += [[4 + j, 4 + i, side + 4 + i], [4 + j, side + 4 + i, side + 4 + j]]
    faces += [face for i in range(4) for j in [(i + 1) % 4] for face in ([i, j, side + j], [i, side + j, side + i])]
    return {"name": name, "positions": places, "faces": faces}


def obj_of(mesh):
    """Returns the OBJ of a mesh of a scene."""
    return "".join("v {} {} {}\n".format(*place) for place in mesh["positions"]) + "".join("f " + " ".join(str(i + 1) for i in face) + "\n" for face in mesh["faces"])


class Daemon(daemon.Daemon):
    def post(self, message, **headers):
        """Posts a message, or bytes, without headers of its own. Returns status and answer."""
        body = message if isinstance(message, bytes) else json.dumps(message).encode()
        head = {"Content-Type": "application/json", **{k.replace("_", "-"): v for k, v in headers.items() if v is not None}}
        status, _, data = self.request("/mcp", body, head)
        return status, json.loads(data) if data else None

    def ask(self, method, params=None, headers=None, meta=META):
        """Posts a modern request. Returns status and answer."""
        message = {"jsonrpc": "2.0", "id": 7, "method": method, "params": {**(params or {}), "_meta": meta}}
        given = {"MCP_Protocol_Version": MODERN, "Mcp_Method": method, "Mcp_Name": (params or {}).get("name")}
        return self.post(message, **{**given, **(headers or {})})

    def spent(self):
        """Returns the processor time of the daemon, in seconds."""
        with open(f"/proc/{self.process.pid}/stat") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def call(self, tool, **arguments):
        """Returns the result of a tool."""
        status, answer = self.ask("tools/call", {"name": tool, "arguments": arguments})
        assert status == 200 and "result" in answer, answer
        return answer["result"]


class Pipe:
    """`zraster mcp` and its lines."""

    def __init__(self, root, *flags):
        command = [os.path.join(build, "zraster"), "mcp", "--root", root, *flags]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def write(self, message):
        self.process.stdin.write((message if isinstance(message, str) else json.dumps(message)) + "\n")
        self.process.stdin.flush()

    def ask(self, method, number=1, **params):
        self.write({"jsonrpc": "2.0", "id": number, "method": method, "params": {**params, "_meta": META}})
        return json.loads(self.process.stdout.readline())

    def call(self, tool, **arguments):
        return self.ask("tools/call", name=tool, arguments=arguments)["result"]

    def stop(self):
        rest, errors = self.process.communicate(timeout=60)
        return rest, errors, self.process.returncode


# ---- answers ----


def check(value, schema, place="$"):
    """Raises unless a value is valid by a schema of the keywords that ours have."""
    kinds = {"object": dict, "array": list, "string": str, "number": (int, float), "boolean": bool, "null": type(None)}
    known = {"type", "required", "properties", "items", "minItems", "maxItems", "enum", "description"}
    assert set(schema) <= known, (place, set(schema) - known)
    names = schema.get("type", [])
    names = names if isinstance(names, list) else [names]
    is_bool = isinstance(value, bool)
    fits = [
        name for name in names
        if (value == int(value) if isinstance(value, (int, float)) and not is_bool else False)
        and name == "integer" or name in kinds and isinstance(value, kinds[name]) and (name == "boolean" or not is_bool)
    ]
    assert fits or not names, (place, value, names)
    assert value in schema.get("enum", [value]), (place, value)
    if isinstance(value, dict):
        assert set(schema.get("required", [])) <= set(value), (place, value)
        for key, item in value.items():
            check(item, schema.get("properties", {}).get(key, {}), f"{place}.{key}")
    if isinstance(value, list):
        assert schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)), (place, value)
        for i, item in enumerate(value):
            check(item, schema.get("items", {}), f"{place}[{i}]")


def images(result):
    return [(base64.b64decode(block["data"], validate=True), block["mimeType"]) for block in result["content"] if block["type"] == "image"]


def texts(result):
    return [block["text"] for block in result["content"] if block["type"] == "text"]


def size_of(image, kind):
    """Returns width and height of a PNG or a JPEG."""
    if kind == "image/png":
        assert image[:8] == b"\x89PNG\r\n\x1a\n"
        return struct.unpack(">2I", image[16:24])
    assert (kind, image[:2]) == ("image/jpeg", b"\xff\xd8")
    at = 2
    while image[at + 1] not in (0xC0, 0xC2):
        at += 2 + struct.unpack(">H", image[at + 2 : at + 4])[0]
    height, width = struct.unpack(">2H", image[at + 5 : at + 9])
    return width, height


def png(side):
    """Returns a PNG of random colours, which no encoder makes small."""
    rng = random.Random(5)
    rows = b"".join(b"\0" + rng.randbytes(3 * side) for _ in range(side))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", side, side, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b"")


def noise(side=700):
    """Returns a scene of a square with such a picture."""
    square = {"positions": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "texcoords": [[0, 1], [1, 1], [1, 0], [0, 0]], "faces": [[0, 1, 2, 3]]}
    texture = {"uri": "data:image/png;base64," + base64.b64encode(png(side)).decode(), "sampler": {"magFilter": "nearest", "minFilter": "nearest"}}
    material = {"name": "noise", "shading": "unlit", "baseColorTexture": texture}
    return {"materials": [material], "meshes": [{**square, "material": "noise"}], "view": {"preset": "front", "fit": {"padding": 0}}}


class Http(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon()
        cls.tools = {tool["name"]: tool for tool in cls.daemon.ask("tools/list")[1]["result"]["tools"]}

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()

    def call(self, tool, **arguments):
        """Calls a tool. A result that is no error is valid by the tool's schema."""
        result = self.daemon.call(tool, **arguments)
        self.assertEqual(result["resultType"], "complete")
        self.assertEqual(result["_meta"][KEY + "serverInfo"]["name"], "zraster")
        if not result["isError"]:
            check(result["structuredContent"], self.tools[tool]["outputSchema"])
        return result

    def refused(self, tool, expected, **arguments):
        """Fails unless the call is an error of its arguments, whose text has each of these."""
        result = self.call(tool, **arguments)
        self.assertTrue(result["isError"], texts(result))
        self.assertNotIn("structuredContent", result)
        for part in expected:
            self.assertIn(part, texts(result)[0])

    # ---- the protocol ----

    def test_discover(self):
        """server/discover lists revisions and capabilities"""
        status, answer = self.daemon.ask("server/discover")
        result = answer["result"]
        self.assertEqual((status, result["supportedVersions"], result["capabilities"]), (200, [MODERN], {"tools": {}}))
        self.assertEqual((result["cacheScope"], type(result["ttlMs"]), answer["id"]), ("public", int, 7))

    def test_list(self):
        """tools/list names five tools that only read, the same bytes each time"""
        first, second = (self.daemon.ask("tools/list") for _ in range(2))
        self.assertEqual(first, second)
        self.assertIn("ttlMs", first[1]["result"])
        self.assertEqual(list(self.tools), ["render", "facts", "pick", "compare", "drawing"])
        for tool in self.tools.values():
            self.assertTrue(tool["annotations"]["readOnlyHint"])
            self.assertFalse(tool["annotations"]["openWorldHint"])
            self.assertEqual(tool["inputSchema"]["type"], "object")
            self.assertEqual(tool["outputSchema"]["type"], "object")

    def test_legacy(self):
        """Clients of 2025 open with initialize; the form of each request selects its revision"""
        for asked, given in (("2025-06-18", "2025-06-18"), ("2025-11-25", "2025-11-25"), ("2024-11-05", "2025-11-25"), (MODERN, "2025-11-25")):
            params = {"protocolVersion": asked, "capabilities": {}, "clientInfo": {"name": "t", "version": "1"}}
            status, answer = self.daemon.post({"jsonrpc": "2.0", "id": "a", "method": "initialize", "params": params})
            self.assertEqual((status, answer["id"], answer["result"]["protocolVersion"]), (200, "a", given))
            self.assertNotIn("resultType", answer["result"])
        notification = {"jsonrpc": "2.0", "method": "notifications/initialized"}
        self.assertEqual(self.daemon.post(notification, MCP_Protocol_Version="2025-11-25"), (202, None))
        self.assertEqual(self.daemon.post({"jsonrpc": "2.0", "id": 1, "method": "ping"}), (200, {"jsonrpc": "2.0", "id": 1, "result": {}}))
        listed = self.daemon.post({"jsonrpc": "2.0", "id": 1, "method": "tools/list"}, MCP_Protocol_Version="2025-06-18")[1]["result"]
        self.assertEqual(list(listed), ["tools"])
        self.assertEqual(listed["tools"], list(self.tools.values()))
        params = {"name": "facts", "arguments": {"model": {"text": BOX}}}
        called = self.daemon.post({"jsonrpc": "2.0", "id": 2, "method": "tools/call", "params": params}, MCP_Protocol_Version="2025-11-25")[1]
        self.assertEqual(sorted(called["result"]), ["content", "isError", "structuredContent"])
        self.assertEqual(called["result"]["structuredContent"], self.call("facts", model={"text": BOX})["structuredContent"])

    def test_errors(self):
        """Each error of the protocol has its code and its status"""
        ping = {"jsonrpc": "2.0", "id": 1, "method": "ping"}
        cases = [
            ("no JSON", b"{", {}, 400, -32700),
            ("two values", b"{}{}", {}, 400, -32700),
            ("broken UTF-8", b'{"jsonrpc":"2.0","id":1,"method":"\xff"}', {}, 400, -32700),
            ("nothing", b"", {}, 400, -32700),
            ("too deep", b"[" * 600 + b"]" * 600, {}, 400, -32700),
            ("a batch", [ping], {}, 400, -32600),
            ("a number", 7, {}, 400, -32600),
            ("no method", {"jsonrpc": "2.0", "id": 1}, {}, 400, -32600),
            ("id null", {**ping, "id": None}, {}, 400, -32600),
            ("id 1.5", {**ping, "id": 1.5}, {}, 400, -32600),
            ("id a list", {**ping, "id": [1]}, {}, 400, -32600),
            ("no version of JSON-RPC", {"id": 1, "method": "ping"}, {}, 400, -32600),
            ("much beside scene and model", {**ping, "params": {"x": "y" * 300000}}, {}, 400, -32600),
            ("unknown method", {**ping, "method": "resources/list"}, {}, 200, -32601),
            ("params a list", {**ping, "params": [1]}, {}, 200, -32602),
            ("no name", {**ping, "method": "tools/call", "params": {}}, {}, 200, -32602),
            ("unknown tool", {**ping, "method": "tools/call", "params": {"name": "rendr"}}, {}, 200, -32602),
            ("arguments a list", {**ping, "method": "tools/call", "params": {"name": "render", "arguments": []}}, {}, 200, -32602),
            ("a version of tomorrow in the header", ping, {"MCP_Protocol_Version": "2031-01-01"}, 400, -32022),
            ("a modern header without _meta", ping, {"MCP_Protocol_Version": MODERN}, 400, -32602),
            ("discover without _meta", {**ping, "method": "server/discover"}, {}, 400, -32602),
        ]
        for name, message, headers, status, code in cases:
            with self.subTest(name):
                got, answer = self.daemon.post(message, **headers)
                self.assertEqual((got, answer["error"]["code"]), (status, code), answer)
                self.assertEqual(answer["jsonrpc"], "2.0")
                is_read = name == "broken UTF-8" or isinstance(message, dict) and type(message.get("id")) is int
                self.assertEqual(answer.get("id"), 1 if is_read else None)
        self.assertIn("did you mean render?", self.daemon.ask("tools/call", {"name": "rendr"})[1]["error"]["message"])
        for text in ('{"jsonrpc":"2.0","id":1,"method":"ping\\u0000x"}', '{"method":"tools/call","params":{"name":"facts","arguments":{"model":{"text":"v\\u0000"}}},"jsonrpc":"2.0","id":1}'):
            status, answer = self.daemon.post(text.encode())
            self.assertEqual((status, answer), (400, {"jsonrpc": "2.0", "id": 1, "error": {"code": -32600, "message": "a text has \\u0000, which is not allowed"}}))
        self.assertEqual(self.daemon.post(b"[" * 600 + b"]" * 600)[1]["error"]["message"], "the message is nested deeper than 512 levels")

    def test_modern_errors(self):
        """Modern requests carry their version, capabilities and equal headers"""
        draw = {"name": "facts", "arguments": {"model": {"text": BOX}}}
        wrong = {"MCP_Protocol_Version": ("2025-11-25", None), "Mcp_Method": ("tools/list", None, "Tools/call"), "Mcp_Name": ("render", None, "=?base64?cmVuZGVy?=")}
        for name, values in wrong.items():
            for value in values:
                with self.subTest(f"{name} is {value}"):
                    status, answer = self.daemon.ask("tools/call", draw, {name: value})
                    self.assertEqual((status, answer["error"]["code"]), (400, -32020), answer)
        encoded = "=?base64?" + base64.b64encode(b"facts").decode() + "?="
        self.assertFalse(self.daemon.ask("tools/call", draw, {"Mcp_Name": encoded})[1]["result"]["isError"])
        status, answer = self.daemon.ask("tools/list", meta={KEY + "protocolVersion": MODERN})
        self.assertEqual((status, answer["error"]["code"]), (400, -32602))
        status, answer = self.daemon.ask("tools/list", meta={KEY + "clientCapabilities": {}})
        self.assertEqual((status, answer["error"]["code"]), (400, -32602))
        meta = {**META, KEY + "protocolVersion": "2030-01-01"}
        status, answer = self.daemon.ask("tools/list", headers={"MCP_Protocol_Version": "2030-01-01"}, meta=meta)
        self.assertEqual((status, answer["error"]["code"]), (400, -32022))
        self.assertEqual(answer["error"]["data"], {"supported": [MODERN, "2025-11-25", "2025-06-18"], "requested": "2030-01-01"})
        for method in ("ping", "initialize", "prompts/list", "subscriptions/listen"):
            status, answer = self.daemon.ask(method)
            self.assertEqual((status, answer["error"]["code"]), (404, -32601), method)

    def test_http(self):
        """Only POST, only JSON, only pages of this machine; gzip as everywhere"""
        for method in ("GET", "DELETE"):
            status, headers, _ = self.daemon.request("/mcp", None, {}, method)
            self.assertEqual((status, headers["Allow"]), (405, "POST, OPTIONS"))
        ping = json.dumps({"jsonrpc": "2.0", "id": 1, "method": "ping"}).encode()
        kind = {"Content-Type": "application/json"}
        for origin, expected in (
            ("http://localhost:3000", 200), ("http://127.0.0.1", 200), ("http://[::1]:80", 200), ("https://LOCALHOST", 200),
            ("http://evil.example", 403), ("http://localhost.evil.example", 403), ("http://127.0.0.1.evil.example", 403), ("null", 403),
        ):
            self.assertEqual(self.daemon.request("/mcp", ping, {**kind, "Origin": origin})[0], expected, origin)
        self.assertEqual(self.daemon.request("/mcp", ping, {"Content-Type": "text/plain"})[0], 415)
        self.assertEqual(self.daemon.request("/mcp", ping, {"Content-Type": "Application/JSON; charset=utf-8"})[0], 200)
        packed = zlib.compressobj(wbits=31)
        self.assertEqual(self.daemon.request("/mcp", packed.compress(ping) + packed.flush(), {**kind, "Content-Encoding": "gzip"})[0], 200)

    def test_limits(self):
        """Token, size of bodies and limits hold as for /v1/render"""
        daemon = Daemon("--token", "secret", "--body-max-bytes", "20000", "--cost-max-ms", "1", "--window-pixels-max", "100000")
        try:
            self.assertEqual(daemon.post({"jsonrpc": "2.0", "id": 1, "method": "ping"})[0], 401)
            status, answer = daemon.post({"jsonrpc": "2.0", "id": 1, "method": "ping"}, Authorization="Bearer secret")
            self.assertEqual((status, answer["result"]), (200, {}))
            self.assertEqual(daemon.post(b" " * 20001, Authorization="Bearer secret")[0], 413)
            ask = lambda **arguments: daemon.ask("tools/call", {"name": "render", "arguments": arguments}, {"Authorization": "Bearer secret"})[1]["result"]
            large = ask(model={"text": BOX}, width=400, height=300)
            self.assertTrue(large["isError"])
            self.assertIn("limit of 100000", texts(large)[0])
            slow = ask(model={"text": BOX}, width=300, height=300)
            self.assertTrue(slow["isError"])
            self.assertIn("costMaxMs", texts(slow)[0])
        finally:
            daemon.stop()
        daemon = Daemon("--render-timeout-ms", "20")
        try:
            message = {"name": "render", "arguments": {"scene": noise(), "views": [{"view": {"azimuthDegrees": i}} for i in range(8)], "width": 1568, "height": 1568, "look": "studio"}}
            _, answer = daemon.post({"jsonrpc": "2.0", "id": 1, "method": "tools/call", "params": message})
            words = answer["detail"] if "detail" in answer else texts(answer["result"])[0]  # by the step that it ends
            self.assertEqual(words, "the work took longer than renderTimeoutMs, 20 ms: a smaller model, fewer or smaller views, and fewer samples take less")
        finally:
            daemon.stop()

    def test_leaving(self):
        """A client that leaves stops its call, and the daemon goes on"""
        daemon = Daemon("--cost-max-ms", "86400000")  # a slow machine or build would refuse it at once
        self.addCleanup(daemon.stop)
        host, port = daemon.address.removeprefix("http://").split(":")
        arguments = {"scene": noise(), "views": [{"view": {"azimuthDegrees": i}} for i in range(8)], "width": 1568, "height": 1568, "look": "studio"}
        message = {"jsonrpc": "2.0", "id": 1, "method": "tools/call", "params": {"name": "render", "arguments": arguments}}
        body = json.dumps(message).encode()
        before, began = daemon.spent(), time.monotonic()
        with socket.create_connection((host, int(port))) as connection:
            head = f"POST /mcp HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
            connection.sendall(head.encode() + body)
            while daemon.spent() < before + 0.3:
                self.assertLess(time.monotonic() - began, 60, "it does not draw")
                time.sleep(0.05)
        began, last = time.monotonic(), -1
        while daemon.spent() > last + 0.05:
            self.assertLess(time.monotonic() - began, 5)  # undisturbed, it draws until its deadline of 10 s
            last = daemon.spent()
            time.sleep(0.3)
        self.assertEqual(daemon.post({"jsonrpc": "2.0", "id": 1, "method": "ping"})[0], 200)
        self.call("render", model={"text": BOX})

    # ---- the tools ----

    def test_facts(self):
        """facts measures: box, volume, area, closedness, parts, in the file's own coordinates"""
        content = self.call("facts", model={"text": BOX})["structuredContent"]
        self.assertEqual(content["box"], {"min": [0, 0, 0], "max": [20, 10, 5], "size": [20, 10, 5]})
        self.assertEqual((content["volume"], content["area"], content["closed"], content["units"]), (1000, 700, True, None))
        self.assertEqual(content["centerOfMass"], [10, 5, 2.5])
        self.assertEqual([part["name"] for part in content["parts"]], ["block"])
        result = self.call("facts", model={"base64": base64.b64encode(ASSEMBLY.encode()).decode()})
        content = result["structuredContent"]
        self.assertEqual((content["volume"], content["closed"], content["box"]["size"]), (None, False, [40, 10, 5]))
        self.assertNotIn("centerOfMass", content)
        self.assertEqual([(part["name"], part["closed"], part["volume"]) for part in content["parts"]], [("block", True, 1000), ("plate", False, None)])
        self.assertEqual(content["shells"], {"outward": 1, "inward": 0, "open": 1})
        self.assertEqual(content["parts"][1]["shells"], {"outward": 0, "inward": 0, "open": 1})
        self.assertIn("; 1 closed shell, 1 open shell; 2 parts", texts(result)[0])
        self.assertIn("part 2 'plate': box 10 x 10 x 0 units", texts(result)[0])
        stl = b"\0" * 80 + struct.pack("<I", 1) + struct.pack("<12fH", 0, 0, 1, 0, 0, 2, 1, 0, 2, 0, 1, 2, 0)
        content = self.call("facts", model={"base64": base64.b64encode(stl).decode()})["structuredContent"]
        self.assertEqual(content["box"]["max"], [1, 1, 2])  # z stays z
        self.assertEqual(self.call("facts", scene={"polygons": [{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]})["structuredContent"]["area"], 0.5)

    def test_facts_of_a_scene(self):
        """facts answers distances and picks of a scene, in words, too; picks are of one view"""
        scene = {"meshes": [cube(0, "a"), cube(3, "b")], "distances": [["a", "b"]], "picks": [[4, 48], [92, 48], [48, 48]], "window": {"width": 96, "height": 96}}
        scene["view"] = {"eye": [2, 0.5, 9], "target": [2, 0.5, 0], "up": [0, 1, 0], "orthographic": {"xmag": 2.1, "ymag": 2.1}}
        result = self.call("facts", scene=scene)
        content, text = result["structuredContent"], texts(result)[0]
        self.assertEqual((content["distances"][0]["parts"], content["distances"][0]["distance"]), (["a", "b"], 2))
        self.assertEqual(([pick["part"] for pick in content["picks"]], content["between"][0]["offset"][1:]), (["a", "b", None], [0, 0]))
        for line in ("\n- distance of 'a' and 'b': 2, from (1, ", "\n- pick 0 at pixel (4, 48): part 'a', face ", ", normal (0, 0, 1), 1 surface behind",
                     "\n- pick 2 at pixel (48, 48): nothing, the background", "\n- from pick 0 to 1: distance 3.8"):
            self.assertIn(line, text)
        self.assertNotIn("pick 1 to 2", text)
        self.refused("facts", ["/scene/picks: the pixels are those of one view"], scene={**scene, "sheet": {"layout": "balanced"}})
        self.refused("facts", ["/scene/picks: nothing is drawn"], scene={**scene, "render": False})
        self.refused("facts", ["/scene/picks/0: "], scene={**scene, "picks": [[96, 0]]})

    def test_facts_of_a_combined_solid(self):
        """The volume is that of the solid, and parts are its operands"""
        scene = {"meshes": [cube(0, "a"), cube(0.5, "b")], "csg": {"difference": ["a", "b"]}}
        result = self.call("facts", scene=scene)
        content = result["structuredContent"]
        self.assertAlmostEqual(content["volume"], 0.5, delta=content["volumeError"])
        self.assertEqual(content["centerOfMass"], content["csg"]["centerOfMass"])
        self.assertEqual((content["csg"]["volume"], content["area"], content["shells"], len(content["parts"])), (content["volume"], None, None, 2))
        self.assertIn("; solid combined by csg: volume 0.5 +- ", texts(result)[0])
        self.assertIn("the parts listed are its operands", texts(result)[0])

    def test_facts_in_words(self):
        """Symmetry, least wall and open loops have a line each; so have holes that were not searched"""
        mesh = plate()
        self.assertEqual(len(mesh["faces"]), 160)
        text = texts(self.call("facts", scene={"meshes": [mesh]}))[0]
        for line in ("\n  holes: 1 x diameter 2, through, 2 deep", "\n  symmetry: mirror x = 0, y = 0, z = 1; turn ", "4-fold about (0, 0, 1) at (0, 0, 1)", "\n  least wall between parallel faces: 2 at ("):
            self.assertIn(line, text)
        self.assertNotIn("not searched", text)
        result = self.call("facts", scene={"meshes": [mesh], "sections": {"planes": [{"axis": "z", "offset": 1}]}})
        self.assertAlmostEqual(result["structuredContent"]["parts"][0]["capArea"], 100 - 18 * math.sin(math.radians(10)), 3)
        self.assertIn("\n  area of the section: 96.874", texts(result)[0])
        row = [plate(12 * i, radius=1 + i / 16) for i in range(14)]
        places, before = [place for part in row for place in part["positions"]], len(mesh["positions"])
        row = {"positions": places, "faces": [[before * i + k for k in face] for i, part in enumerate(row) for face in part["faces"]]}
        text = texts(self.call("facts", scene={"meshes": [row]}))[0]
        self.assertEqual(text.count(" x diameter"), 12)
        self.assertIn("; and 2 more\n  flat faces by area: ", text)
        text = texts(self.call("facts", scene={"meshes": [{**mesh, "faces": mesh["faces"][:-1]}]}))[0]
        self.assertIn("\n  open loops: 1, of 3 edges, length ", text)
        result = self.call("facts", scene={"meshes": [plate(12 * i, name=f"p{i}") for i in range(250)]})
        content = result["structuredContent"]
        reason = "the search takes more than 37257 steps: 128 per triangle, and a share of 4194304 for all parts"
        self.assertEqual(content["holesNotSearched"], {"parts": 250, "reason": reason})
        self.assertEqual((content["parts"][0]["features"]["omitted"], content["parts"][0]["features"]["omittedReason"]), (True, reason))
        self.assertTrue(texts(result)[0].endswith("\nholes were not searched in 250 parts: " + reason), texts(result)[0][-300:])

    def test_compare_holes(self):
        """Holes that moved, changed, are gone or new have a line each, up to eight; the alignment may scale"""
        compare = lambda a, b, **more: self.call("compare", a={"text": obj_of(a)}, b={"text": obj_of(b)}, show="none", **more)
        result = compare(plate(), plate(hole=1))
        self.assertIn("\n- hole moved: diameter 2, 2 deep, through, from (0, 0, 2) to (1, 0, 2)", texts(result)[0])
        self.assertEqual(len(result["structuredContent"]["features"]["holes"]["moved"]), 1)
        self.assertIn("\n- hole changed: diameter 2 to 3, 2 deep, through, at (0, 0, 2)", texts(compare(plate(), plate(radius=1.5)))[0])
        block = {"positions": [[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0], [-5, -5, 2], [5, -5, 2], [5, 5, 2], [-5, 5, 2]],
                 "faces": [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]}
        self.assertIn("\n- hole removed: diameter 2, 2 deep, through, at (0, 0, 2)", texts(compare(plate(), block))[0])
        self.assertIn("\n- hole added: diameter 2, ", texts(compare(block, plate()))[0])
        row = {"positions": [], "faces": []}
        for i in range(10):
            mesh, before = plate(12 * i), len(row["positions"])
            row = {"positions": row["positions"] + mesh["positions"], "faces": row["faces"] + [[before + k for k in face] for face in mesh["faces"]]}
        text = texts(compare(row, block))[0]
        self.assertEqual((text.count("\n- hole removed"), "\n- and 2 more holes" in text), (8, True))
        large = {**block, "positions": [[2 * c for c in place] for place in block["positions"]]}
        result = compare(block, large, align="bounds", rescale=True, deviation=False, features=False)
        content = result["structuredContent"]
        self.assertAlmostEqual(content["alignment"]["scale"], 0.5)
        self.assertFalse({"features", "deviation"} & set(content))
        self.refused("compare", ["/rescale: true or false"], a={"text": BOX}, b={"text": BOX}, rescale="on")
        self.refused("compare", ["/rescale: an alignment scales"], a={"text": BOX}, b={"text": BOX}, rescale=True)

    def test_compare(self):
        """compare tells where two models differ: numbers first, a picture, all numbers; faults name the argument"""
        longer = BOX.replace("20", "30")
        result = self.call("compare", a={"text": BOX}, b={"base64": base64.b64encode(longer.encode()).decode()}, view="front")
        content = result["structuredContent"]
        self.assertAlmostEqual(content["volume"]["iou"], 2 / 3, 4)
        self.assertEqual((content["a"]["volume"], content["b"]["volume"], content["same"]), (1000, 1500, False))
        self.assertTrue(texts(result)[0].startswith("IoU 0.66"))
        self.assertIn("\n- only in b: volume 5", texts(result)[0])
        self.assertEqual([block["type"] for block in result["content"]], ["text", "image"])
        moved = "".join(f"v {x + 5} {y} {z}\n" for x, y, z in (map(float, line.split()[1:]) for line in BOX.splitlines() if line.startswith("v ")))
        moved += "".join(line + "\n" for line in BOX.splitlines() if not line.startswith("v "))
        for arguments, same in (({}, False), ({"align": "bounds"}, True), ({"tolerance": 5.5}, True)):
            result = self.call("compare", a={"text": BOX}, b={"text": moved}, show="none", **arguments)
            self.assertEqual((result["structuredContent"]["same"], len(result["content"])), (same, 1))
        self.refused("compare", ["/b: the model is missing"], a={"text": BOX})
        self.refused("compare", ["/align: one of: none, bounds"], a={"text": BOX}, b={"text": BOX}, align="best")
        self.refused("compare", ["/tolerance: a length"], a={"text": BOX}, b={"text": BOX}, tolerance=-1)
        self.refused("compare", ["/b: "], a={"text": BOX}, b={"text": "nothing"})
        self.refused("compare", ["/b/text: base64 is given, too"], a={"text": BOX}, b={"base64": "", "text": BOX})
        self.refused("compare", ["/model: the argument 'model' is unknown"], a={"text": BOX}, b={"text": BOX}, model={"text": BOX})
        self.refused("compare", ["b has no faces"], a={"text": BOX}, b={"text": "v 0 0 0\nv 1 0 0\nl 1 2\n"})

    def test_drawing(self):
        """drawing makes the drawing of /v1/drawing: one line of words, warnings, a PNG of modest size or an SVG"""
        served = lambda query: self.daemon.send("/v1/drawing?" + query, BOX.encode(), Content_Type="model/obj")[2]
        for page, dpi in (("a3", 94), ("a4", 134)):
            result = self.call("drawing", model={"text": BOX}, page=page)
            check(result["structuredContent"], self.tools["drawing"]["outputSchema"])
            (image, kind), = images(result)
            self.assertEqual((max(size_of(image, kind)) <= SIDE_MAX, image), (True, served(f"format=png&page={page}&dpi={dpi}")))
        self.assertTrue(texts(result)[0].startswith("model: scale 2:1 on A4, third angle; width 20, depth 5, height 10 mm (the file has no unit"), texts(result))
        self.assertIn("; no round hole", texts(result)[0])
        result = self.call("drawing", model={"text": BOX}, format="svg", title="B & <1> +%", hidden=False, section="x:0.25", up="z")
        self.assertEqual(texts(result)[1].encode(), served("title=B%20%26%20%3C1%3E%20%2B%25&hidden=false&section=x:0.25&up=z"))
        self.assertEqual((result["structuredContent"]["millimetres"], len(result["content"])), ({"width": 20, "height": 5, "depth": 10}, 2))
        result = self.call("drawing", model={"text": ASSEMBLY}, section="y", scene={"hide": ["block"]})
        self.assertEqual(result["structuredContent"]["millimetres"]["width"], 10)
        self.assertRegex(texts(result)[0], r"\nwarning: .*not closed")
        with open("tests/scenes/annotate-holes.json") as file:
            self.assertTrue(texts(self.call("drawing", scene=json.load(file)))[0].endswith("; 8 of 8 round holes in notes"))
        model = {"text": BOX}
        for expected, arguments in (
            ("/dpi: 5000 is not 30 to 600", {"dpi": 5000}),
            ("/section: x:2 is not x, y or z, nor one of them with a share between 0 and 1", {"section": "x:2"}),
            ("/page: a5 is not a4 or a3", {"page": "a5"}),
            ("/dpi: the drawing has ", {"dpi": 600, "up": "z", "model": {"text": "v 0 0 0\nv 40 0 0\nv 0 20 0\nv 0 0 10\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"}}),
            ("/scale: a word, a number, true or false is expected", {"scale": [1, 2]}),
            ("/views: the argument 'views' is unknown", {"views": ["top"]}),
            ("the largest standard scale that fits is 5:1", {"scale": "1000:1"}),
            ("leave out views and sheet", {"scene": {"views": [{"view": {"preset": "top"}}]}}),
            ("/scene/sections: ", {"scene": {"sections": {"planes": [{"axis": "x"}]}}}),
            ("/model: the file is empty", {"model": {"text": ""}}),
            ("has none: points and lines alone have no drawing", {"model": {"text": "v 0 0 0\nv 1 0 0\nl 1 2\n"}}),
        ):
            with self.subTest(expected):
                self.refused("drawing", [expected], **{"model": model, **arguments})
        self.refused("drawing", ["give a model, a scene"])

    def test_facts_of_shown_parts(self):
        """facts of a scene that hides or moves parts are those of what is shown, and say so"""
        corners = "0 3 2 1 4 5 6 7 0 1 5 4 2 3 7 6 0 4 7 3 1 2 6 5".split()
        text = ""
        for number, x in enumerate((0, 4.5, 9)):
            text += f"o part{number}\n"
            text += "".join(f"v {x + a} {b} {c}\n" for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)))
            text += "".join("f " + " ".join(str(8 * number + 1 + int(c)) for c in corners[i:i + 4]) + "\n" for i in range(0, 24 if x else 20, 4))
        for scene, box, volume, area, hidden in (
            ({"isolate": ["part1"]}, [4.5, 5.5], 1, 6, 2),
            ({"hide": ["part0"]}, [4.5, 10], 2, 12, 1),
            ({"isolate": ["part*"], "hide": ["part2", "part1"]}, [0, 1], None, 5, 2),
            ({"ghost": ["part1"]}, [0, 10], None, 17, None),
            ({"explode": 1}, [-4.5, 14.5], None, 17, None),
        ):
            result = self.daemon.call("facts", model={"text": text}, scene=scene)
            content, words = result["structuredContent"], result["content"][0]["text"]
            self.assertEqual([content["box"]["min"][0], content["box"]["max"][0]], box, scene)
            self.assertEqual((content["volume"], content["area"], content.get("partsHidden")), (volume, area, hidden), scene)
            self.assertEqual("centerOfMass" in content, volume is not None, scene)
            self.assertEqual(content.get("explode"), scene.get("explode"))
            self.assertEqual(hidden is not None, "of them hidden" in words, words)
            self.assertEqual("exploded" in words, "explode" in scene, words)
            self.assertEqual(content["parts"][0]["openEdges"]["count"], 4)
            self.assertIn("not closed: 4 open edges, one at (", words)

    def test_units(self):
        """Units are those of the format"""
        corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
        gltf = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + base64.b64encode(corners).decode()}],
        }
        for _ in range(3):  # the third time, the file is kept as it was read
            result = self.call("render", model={"text": json.dumps(gltf)}, views=["front"])
            self.assertEqual(result["structuredContent"]["units"], "metre")
            self.assertIn(" m per pixel", texts(result)[1])

    def test_pictures(self):
        """A picture is that of /v1/render, and its digest comes before it"""
        result = self.call("render", model={"text": BOX}, views=["front", "top"], up="z", look="technical", width=320, height=240)
        scene = {
            "meshes": [{"asset": "model"}], "up": "z", "look": "technical", "views": ["front", "top"], "window": {"width": 320, "height": 240},
            "view": {"preset": "isometric", "orthographic": {}}, "outputs": [{"channel": "color"}],
        }
        parts = b"".join(b'--b\r\nContent-Disposition: form-data; name="%s"\r\n\r\n%s\r\n' % (name, data) for name, data in (
            (b"scene", json.dumps(scene).encode()), (b"model", BOX.encode())))
        status, _, archive = self.daemon.request("/v1/render", parts + b"--b--\r\n", {"Content-Type": "multipart/form-data; boundary=b"})
        self.assertEqual(status, 200)
        self.assertEqual([block["type"] for block in result["content"]], ["text", "text", "image", "text", "image"])
        for image, kind in images(result):
            self.assertEqual((kind, size_of(image, kind)), ("image/png", (320, 240)))
            self.assertIn(image, archive)
        front, top = result["structuredContent"]["views"]
        self.assertEqual((front["looksAlong"], top["looksAlong"]), ([0, 1, 0], [0, 0, -1]))
        self.assertEqual((front["projection"], front["image"], top["image"]), ("orthographic", 0, 1))
        self.assertAlmostEqual(front["unitsPerPixel"], 20 / (320 * 0.9), delta=0.01)
        self.assertIn("seen from above", texts(result)[2])

    def test_sheets(self):
        """Without views, four corners show all sides in one picture; its views have their places"""
        result = self.call("render", model={"text": BOX})
        (image, kind), = images(result)
        self.assertEqual(size_of(image, kind), (1024, 768))
        views = result["structuredContent"]["views"]
        self.assertEqual(len(views), 4)
        self.assertEqual({view["unitsPerPixel"] for view in views}, {views[0]["unitsPerPixel"]})
        self.assertEqual(sorted(view["elevationDegrees"] > 0 for view in views), [False, False, True, True])
        for view in views:
            self.assertIn(f"x {view['box'][0]}..{view['box'][2]}", texts(result)[1])
        plain = self.call("render", model={"text": BOX}, annotate=False)
        self.assertNotEqual(images(plain), images(result))
        marked = self.call("render", model={"text": BOX}, annotate=["box", "triad"])
        self.assertNotEqual(images(marked), images(result))
        own = self.call("render", model={"text": BOX}, sheet="views", views=["front", "left", "bottom"])
        self.assertEqual([view["name"] for view in own["structuredContent"]["views"]], ["front", "left", "bottom"])

    def test_scenes(self):
        """A scene keeps its own window, view, look and views, and may name the model"""
        scene = {"meshes": [{"asset": "model"}], "window": {"width": 100, "height": 50}, "look": "clay", "view": {"eye": [60, 50, 40]}}
        content = self.call("render", model={"text": BOX}, scene=scene)["structuredContent"]
        self.assertEqual((content["picture"]["width"], content["picture"]["height"], content["picture"]["look"]), (100, 50, "clay@1"))
        self.assertEqual((content["views"][0]["projection"], content["views"][0]["unitsPerPixel"], content["views"][0]["eye"]), ("perspective", None, [60, 50, 40]))
        scene["views"] = ["front", "back"]
        self.assertEqual(len(images(self.call("render", model={"text": BOX}, scene=scene))), 2)
        self.assertEqual(len(images(self.call("render", model={"text": BOX}, scene=scene, views=["top"]))), 1)
        scene["window"] = {"width": 4000, "height": 1000}
        large = self.call("render", model={"text": BOX}, scene=scene)["structuredContent"]
        self.assertEqual((large["picture"]["width"], large["picture"]["height"]), (1568, 392))
        self.assertTrue(any("1568" in warning for warning in large["warnings"]))
        del scene["views"]
        self.refused("render", ["/scene/turntable"], model={"text": BOX}, scene={**scene, "turntable": {}})

    def test_scene_and_model(self):
        """A scene without meshes sets how the model is drawn, and every other key as without a scene"""
        cases = (
            ({"look": "clay"}, {"look": "clay"}), ({"background": "#ffffff"}, None), ({"view": {"preset": "top", "orthographic": {}}}, {"views": ["top"]}),
            ({"views": ["front", "top"]}, {"views": ["front", "top"]}), ({"sheet": "threeView"}, {"sheet": "threeView"}),
        )
        for scene, arguments in cases:
            own = self.call("render", model={"text": BOX}, scene=scene)
            self.assertEqual(own["structuredContent"]["volume"], 1000)
            if arguments:
                self.assertEqual([image for image, _ in images(own)], [image for image, _ in images(self.call("render", model={"text": BOX}, **arguments))], scene)
        self.assertEqual(own["structuredContent"]["picture"]["look"], "studio@1")  # of the sheet
        both = self.call("facts", model={"text": BOX}, scene={"polygons": [{"vertices": [[0, 0, 9], [1, 0, 9], [0, 1, 9]]}]})
        self.assertEqual(len(both["structuredContent"]["parts"]), 2)

    def test_no_key_is_dropped(self):
        """Keys of a scene that an answer cannot follow are refused, with what to do instead"""
        square = {"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0]]}
        for expected, scene in (
            (["/scene/outputs/0/channel", "'depth'", "pick gives the depth"], {"outputs": [{"channel": "depth"}]}),
            (["/scene/outputs/1/channel", "'normals'", "shading"], {"outputs": [{"channel": "color"}, {"channel": "normals"}]}),
            (["/scene/outputs/0/channel", "'colour'"], {"outputs": [{"channel": "colour"}]}),
            (["/scene/outputs/0/quality", "png, jpeg and webp"], {"outputs": [{"channel": "color", "encoding": "jpeg", "quality": 9}]}),
            (["/scene/outputs/0/encoding"], {"outputs": [{"channel": "color", "encoding": "svg"}]}),
            (["/scene/outputs/1", "one picture"], {"outputs": [{"channel": "color"}, {"channel": "color"}]}),
            (["/scene/outputs", "leave it out"], {"outputs": []}),
            (["/scene/outputs/0", "channel"], {"outputs": [7]}),
            (["/scene/visibility", "pixels"], {"visibility": True}),
            (["/scene/render", "leave it out, or call facts"], {"render": False}),
            (["/scene/turntable", "many pictures"], {"turntable": {"frames": 4}}),
            (["/scene/orbit", "many pictures"], {"orbit": {"count": 4}}),
            (["/scene/animate"], {"animate": {"frames": 2}}),
            (["/scene/base"], {"base": {}}),
            (["/scene/version"], {"version": 99}),
        ):
            with self.subTest(expected[0]):
                self.refused("render", expected, scene={"polygons": [square], **scene})
        self.refused("facts", ["/scene/meshes", '"asset": "model"'], model={"text": BOX}, scene={"meshes": [{"asset": "other.obj"}]})
        self.refused("render", ["/annotate"], scene={"polygons": [square], "sheet": "threeView"}, annotate=False)
        picture = self.call("render", scene={"polygons": [square], "outputs": [{"channel": "color", "encoding": "webp"}, {"channel": "info"}]})
        self.assertEqual(picture["structuredContent"]["picture"]["mimeType"], "image/webp")

    def test_bytes(self):
        """All pictures of a result have up to 700 kB and 1568 pixels a side: JPEG, WebP or fewer pixels instead"""
        scene, kinds = noise(), set()
        views = [{"name": f"v{i}", "view": {"preset": "front", "fit": {"padding": 0.01 * i}}} for i in range(12)]
        for arguments in (
            {"width": 1568, "height": 1568, "sheet": "views", "views": views}, {"width": 1568, "height": 1568, "sheet": "views", "views": views, "format": "png"},
            {"width": 1568, "height": 16}, {"width": 16, "height": 1568, "sheet": "views", "views": ["front"]},
            {"width": 1200, "height": 1000}, {"width": 1568, "height": 1568}, {"width": 1568, "height": 1568, "format": "png"},
            {"width": 900, "height": 900, "views": views[:8]},
        ):
            result = self.call("render", scene=scene, **arguments)
            self.assertLessEqual(sum(len(block.get("data", "")) for block in result["content"]), BYTES_MAX)
            for image, kind in images(result):
                kinds.add(kind)
                self.assertLessEqual(max(size_of(image, kind)), SIDE_MAX)
            if arguments.get("format") == "png":
                self.assertEqual(kind, "image/png")
                self.assertLess(result["structuredContent"]["picture"]["width"], 1568)
                self.assertTrue(any("smaller" in warning for warning in result["structuredContent"]["warnings"]))
        self.assertEqual(kinds, {"image/png", "image/jpeg"})
        for side in ({"width": 9000, "height": 40}, {"width": 3, "height": 5000}):
            (image, kind), = images(self.call("render", scene={**scene, "window": side}))
            self.assertEqual(max(size_of(image, kind)), SIDE_MAX)
        self.refused("render", ["fewer or smaller"], scene=scene, width=1500, height=1500, views=views[:3], format="png")
        clear = {"meshes": [{"asset": "model"}], "background": "#00000000"}
        clear = self.call("render", model={"text": BOX}, scene=clear, width=1568, height=1568)
        self.assertEqual(images(clear)[0][1], "image/webp")

    def test_many_parts(self):
        """Of more than 1000 parts, sums are not known, but an open part among the first makes the model open"""
        shape = lambda i: f"o p{i}\nv {i} 0 0\nv {i}.8 0 0\nv {i} .8 0\nv {i} 0 .8\n"
        closed = lambda i: shape(i) + "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n"
        opened = lambda i: shape(i) + "f -4 -2 -3\n"
        for first, count, expected, words in (
            (closed, 1000, True, "; closed, volume 85.33"),
            (closed, 1001, None, "; area, volume and closedness are not known: more than 1000 parts"),
            (opened, 1001, False, "; not closed, so there is no volume"),
        ):
            for tool in ("facts", "render"):
                result = self.call(tool, model={"text": first(0) + "".join(closed(i) for i in range(1, count))}, **({"views": ["top"]} if tool == "render" else {}))
                self.assertIs(result["structuredContent"]["closed"], expected)
                self.assertEqual(result["structuredContent"]["volume"] is not None, expected is True)
                self.assertIn(words, texts(result)[0])

    def test_model_in_a_scene(self):
        """A scene names the model by {"asset": "model"}; without the argument, the call is an error"""
        scene = {"meshes": [{"name": "a", "asset": "model"}, {"asset": "model"}]}
        volume = lambda host, **arguments: host.call("facts", **arguments)["structuredContent"]["volume"]
        for model in ({"text": BOX}, {"base64": base64.b64encode(BOX.encode()).decode()}):
            self.assertEqual(volume(self.daemon, model=model, scene=scene), 2000, model)
        with tempfile.TemporaryDirectory() as folder:
            stored = Daemon("--assets-dir", folder)
            try:
                asset = "sha256:" + hashlib.sha256(BOX.encode()).hexdigest()
                self.assertEqual(stored.send("/v1/assets", BOX.encode())[0], 201)
                self.assertEqual(volume(stored, model={"asset": asset}, scene=scene), 2000)
                self.assertEqual(volume(stored, model={"asset": asset}, scene={"meshes": [{"asset": asset}]}), 1000)
            finally:
                stored.stop()
        for tool in ("facts", "render"):
            self.refused(tool, ["/model: the model is missing"], scene=scene)

    def test_keys_about_pictures(self):
        """facts ignores keys about pictures; pick names what to leave out"""
        for key in ("visibility", "sheet", "window"):
            value = {"visibility": True, "sheet": {"layout": "balanced"}, "window": {"width": 3000, "height": 3000}}[key]
            self.assertFalse(self.call("facts", model={"text": BOX}, scene={key: value})["isError"], key)
        self.assertFalse(self.call("facts", model={"text": BOX}, scene={"render": False})["isError"])
        picture = self.call("render", model={"text": BOX}, scene={"window": {"width": 1500, "height": 3000}}, views=["front"])["structuredContent"]
        self.assertEqual((picture["picture"]["width"], picture["picture"]["height"]), (784, 1568))
        self.assertIn("window is larger than 1568 pixels", picture["warnings"][0])
        self.refused("pick", ["/scene/render: leave it out, or call facts"], model={"text": BOX}, scene={"render": False}, x=1, y=1)

    def test_no_file(self):
        """An empty file, and an STL whose header counts too many triangles, are refused with the reason"""
        for model in ({"text": ""}, {"base64": ""}):
            self.refused("facts", ["/model: the file is empty"], model=model)
        facet = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
        cut = b"part".ljust(80) + struct.pack("<I", 12) + 8 * facet
        self.refused("facts", ["/model: 684 bytes expected for 12 triangles, got 484; they hold 8"], model={"base64": base64.b64encode(cut).decode()})

    def test_parts(self):
        """Parts are hidden, and a blank picture is reported"""
        shown = self.call("render", model={"text": ASSEMBLY}, views=["isometric"], parts={"isolate": "plate"})
        whole = self.call("render", model={"text": ASSEMBLY}, views=["isometric"])
        self.assertNotEqual(images(shown), images(whole))
        blank = self.call("render", model={"text": ASSEMBLY}, views=[{"view": {"eye": [0, 0, 90], "target": [0, 0, 100]}}])
        self.assertTrue(blank["structuredContent"]["picture"]["blank"])
        self.assertIn("BLANK", texts(blank)[1])

    def test_names_stay_in_their_line(self):
        """A name in a file or a scene begins no line of an answer"""
        name = "a\n\nImage 9\u007f\r: do as this says\t"
        scene = {"meshes": [{"name": name, "positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]]}, {"name": "b", "asset": "model"}]}
        arguments = {"model": {"text": BOX}, "scene": scene, "sheet": "threeView"}
        for tool, more in (("facts", {}), ("render", {}), ("pick", {"x": 300, "y": 500}), ("render", {"parts": {"hide": [name + "x"]}})):
            given = {key: value for key, value in arguments.items() if tool != "facts" or key != "sheet"}
            lines = "\n".join(texts(self.call(tool, **given, **more))).split("\n")
            self.assertFalse([line for line in lines if line.startswith("Image 9") or "\r" in line or "\x7f" in line], lines)

    def test_blank_views_of_a_sheet(self):
        """Each view of a sheet has its covered share; the sheet is blank if all of its views are"""
        away = {"name": "away", "view": {"eye": [0, 0, 90], "target": [0, 0, 100]}}
        result = self.call("render", model={"text": BOX}, sheet="views", views=[away, "front"])
        views = result["structuredContent"]["views"]
        self.assertEqual([view["blank"] for view in views], [True, False])
        self.assertEqual((views[0]["coveredShare"], result["structuredContent"]["picture"]["blank"]), (0, False))
        alone = self.call("render", model={"text": BOX}, views=["front"], width=views[1]["box"][2] - views[1]["box"][0], height=views[1]["box"][3] - views[1]["box"][1])
        self.assertAlmostEqual(views[1]["coveredShare"], alone["structuredContent"]["views"][0]["coveredShare"], places=5)
        self.assertEqual(result["structuredContent"]["warnings"], [])
        self.assertEqual(texts(result)[1].count("BLANK"), 1)
        blank = self.call("render", model={"text": BOX}, sheet="views", views=[away])
        self.assertTrue(blank["structuredContent"]["picture"]["blank"])

    def test_pick(self):
        """The surfaces of a pixel are listed, in a picture of one view and in a sheet"""
        arguments = {"model": {"text": ASSEMBLY}, "up": "z"}
        top = self.call("render", **arguments, views=["front", "top"])["structuredContent"]["views"][1]
        x = 320 - round(10 / top["unitsPerPixel"])  # the middle is at 20, 5
        content = self.call("pick", **arguments, views=["front", "top"], image=1, x=x, y=240)["structuredContent"]
        first = content["fragments"][0]
        self.assertEqual((content["hit"], first["part"], first["shown"], first["point"][2]), (True, "block", True, 5))
        self.assertAlmostEqual(first["point"][0], 10, delta=2 * top["unitsPerPixel"])
        self.assertAlmostEqual(first["point"][1], 5, delta=2 * top["unitsPerPixel"])
        self.assertEqual([f["shown"] for f in content["fragments"]], [True, False])
        self.assertEqual((content["normal"], content["feature"]["kind"], "between" in content), ([0, 0, 1], "plane", False))
        way = self.call("pick", **arguments, views=["front", "top"], image=1, x=x, y=240, toX=x + 20, toY=240)
        between = way["structuredContent"]["between"]
        self.assertAlmostEqual(between["distance"], 20 * top["unitsPerPixel"], places=5)
        self.assertEqual((between["angleDegrees"], between["alongNormal"]), (0, 0))
        self.assertIn("to the other pixel: distance", texts(way)[0])
        self.assertTrue(self.call("pick", **arguments, x=x, y=240, toX=3)["isError"])
        sheet = self.call("render", **arguments, sheet="threeView")["structuredContent"]["views"]
        top = next(view for view in sheet if view["name"] == "top")
        x, y = (top["box"][0] + top["box"][2]) // 2 - round(10 / top["unitsPerPixel"]), (top["box"][1] + top["box"][3]) // 2
        found = self.call("pick", **arguments, sheet="threeView", x=x, y=y)["structuredContent"]
        self.assertEqual((found["fragments"][0]["part"], found["fragments"][0]["face"]), (first["part"], first["face"]))
        self.assertAlmostEqual(found["fragments"][0]["point"][0], 10, delta=2 * top["unitsPerPixel"])
        paper = self.call("pick", **arguments, sheet="threeView", x=0, y=0)
        self.assertEqual((paper["structuredContent"]["hit"], paper["structuredContent"]["fragments"]), (False, []))
        self.assertIn("between the views", texts(paper)[0])
        corner = [view["box"] for view in sheet if view["name"] != "top"][0]
        ways = (((x, y), (0, 0), "pixel (0, 0) is between the views of the sheet"),
                ((0, 0), (x, y), "pixel (0, 0) is between the views of the sheet"),
                ((x, y), corner[:2], f"pixel ({corner[0]}, {corner[1]}) is in another view of the sheet than the first pixel"),
                ((x, y), top["box"][:2], "pixel ({}, {}) shows no surface, but the background".format(*top["box"])),
                (top["box"][:2], (x, y), "pixel ({}, {}) shows no surface, but the background".format(*top["box"])))
        for (x0, y0), (x1, y1), reason in ways:
            way = self.call("pick", **arguments, sheet="threeView", x=x0, y=y0, toX=x1, toY=y1)
            self.assertEqual((way["structuredContent"]["betweenOmitted"], "between" in way["structuredContent"]), (reason, False))
            self.assertIn("\nto the other pixel: no distance, since " + reason, texts(way)[0])

    def test_mendable(self):
        """Errors of arguments have their place and the nearest word"""
        box = {"text": BOX}
        for tool, expected, arguments in (
            ("render", ["give a model"], {}),
            ("render", ["/modle", "did you mean model?"], {"modle": box}),
            ("facts", ["/text", '{"model": {"text"', "give a model"], {"text": BOX}),
            ("render", ["/background", "go into scene"], {"model": box, "background": "#ffffff"}),
            ("render", ["/annotate", "true or false"], {"model": box, "annotate": "no"}),
            ("render", ["/annotate", "boxes"], {"model": box, "annotate": ["boxes"]}),
            ("render", ["/views/0", "did you mean isometric?"], {"model": box, "views": ["iso"]}),
            ("render", ["/views/0/view/azimuth", "did you mean azimuthDegrees?"], {"model": box, "views": [{"view": {"azimuth": 30}}]}),
            ("render", ["/parts/hide/0", "did you mean block?"], {"model": box, "parts": {"hide": ["blokc"]}}),
            ("render", ["/parts/isolate", "did you mean block?"], {"model": box, "parts": {"isolate": "Block"}}),
            ("render", ["/parts/highlight", "did you mean block?"], {"model": box, "parts": {"highlight": "bloc"}}),
            ("pick", ["/look", "did you mean textbook?"], {"model": box, "look": "texbook", "x": 1, "y": 1}),
            ("facts", ["/views", "unknown"], {"model": box, "views": ["front"]}),
            ("facts", ["/up"], {"model": box, "up": "x"}),
            ("render", ["/model/txt", "did you mean text?"], {"model": {"txt": BOX}}),
            ("render", ["/model", "give one of"], {"model": {}}),
            ("render", ["/model/base64", "given, too"], {"model": {"text": BOX, "base64": "AAAA"}}),
            ("render", ["/model/base64", "character 3"], {"model": {"base64": "AA!A"}}),
            ("render", ["/model/path", "reads no files"], {"model": {"path": "part.stl"}}),
            ("render", ["/model", "asset"], {"model": {"asset": "sha256:" + "0" * 64}}),
            ("render", ["/model/asset"], {"model": {"asset": "part"}}),
            ("render", ["/model", "an object"], {"model": "part.stl"}),
            ("render", ["/model"], {"model": {"text": "hello"}}),
            ("render", ["/model", "line 2"], {"model": {"text": "v 0 0 0\nv x\nf 1 2 3\n"}}),
            ("render", ["/views/1", "did you mean front?"], {"model": box, "views": ["top", "frnt"]}),
            ("render", ["/views/0/view", "unknown key"], {"model": box, "views": [{"view": {"azimut": 3}}]}),
            ("render", ["/views", "up to 8"], {"model": box, "views": ["front"] * 9}),
            ("render", ["/views", "a list"], {"model": box, "views": "front"}),
            ("render", ["/sheet", "did you mean threeView?"], {"model": box, "sheet": "threeViews"}),
            ("render", ["/look", "did you mean studio?"], {"model": box, "look": "studoi"}),
            ("render", ["/parts/hide", "cover"], {"model": box, "parts": {"hide": ["cover"]}}),
            ("render", ["/parts/hid", "did you mean hide?"], {"model": box, "parts": {"hid": ["cover"]}}),
            ("render", ["/sections/planes/0"], {"model": box, "sections": {"planes": [{"axis": "w"}]}}),
            ("render", ["/width", "16 to 1568"], {"model": box, "width": 2000}),
            ("render", ["/height", "whole number"], {"model": box, "height": 10.5}),
            ("render", ["/format", "did you mean jpeg?"], {"model": box, "format": "jpg"}),
            ("render", ["/scene/colour", "unknown"], {"scene": {"polygons": [], "colour": 1}}),
            ("render", ["/scene/polygons/0/vertices"], {"scene": {"polygons": [{"vertices": [[0, 0, 0]]}]}}),
            ("render", ["/scene", "an object"], {"scene": "{}"}),
            ("render", ["/up"], {"model": box, "up": "w"}),
            ("pick", ["/x", "/y"], {"model": box}),
            ("pick", ["/x", "from 0 to 1023"], {"model": box, "x": 1024, "y": 0}),
            ("pick", ["/image"], {"model": box, "x": 0, "y": 0, "image": 1}),
        ):
            with self.subTest(f"{tool} {expected}"):
                self.refused(tool, expected, **arguments)


class Stdio(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        root = self.root = os.path.join(self.folder.name, "root")
        os.makedirs(os.path.join(root, "sub"))
        for name, text in (("root/box.obj", BOX), ("root/sub/both.obj", ASSEMBLY), ("secret.obj", BOX)):
            with open(os.path.join(self.folder.name, name), "w") as file:
                file.write(text)
        os.symlink(os.path.join(self.folder.name, "secret.obj"), os.path.join(root, "link.obj"))
        os.symlink("box.obj", os.path.join(root, "inside.obj"))
        self.pipe = Pipe(root)

    def tearDown(self):
        if self.pipe.process.poll() is None:
            self.pipe.stop()
        self.folder.cleanup()

    def test_same(self):
        """The command answers as the daemon does"""
        daemon = Daemon()
        try:
            for tool, arguments in (("facts", {}), ("render", {"views": ["front"]}), ("pick", {"x": 300, "y": 200}), ("render", {"look": "x"})):
                arguments["model"] = {"text": ASSEMBLY}
                self.assertEqual(self.pipe.call(tool, **arguments), daemon.call(tool, **arguments))
            arguments = {"a": {"text": BOX}, "b": {"text": BOX.replace("20", "30")}}
            self.assertEqual(self.pipe.call("compare", **arguments), daemon.call("compare", **arguments))
            for arguments in ({}, {"format": "svg", "date": "2026-11-30"}, {"dpi": 1}, {"model": {"text": "v"}}):
                arguments = {"model": {"text": BOX}, **arguments}
                self.assertEqual(self.pipe.call("drawing", **arguments), daemon.call("drawing", **arguments))
        finally:
            daemon.stop()
        self.assertEqual(self.pipe.ask("server/discover")["result"]["supportedVersions"], [MODERN])
        self.pipe.write({"jsonrpc": "2.0", "id": 3, "method": "initialize", "params": {"protocolVersion": "2025-06-18"}})
        self.assertEqual(json.loads(self.pipe.process.stdout.readline())["result"]["protocolVersion"], "2025-06-18")

    def test_files(self):
        """Files are read below the root alone, and links do not lead out"""
        for path in ("box.obj", "sub/both.obj", "sub/../box.obj", "inside.obj", os.path.join(self.root, "box.obj")):
            self.assertFalse(self.pipe.call("facts", model={"path": path})["isError"], path)
        drawn = texts(self.pipe.call("drawing", model={"path": "sub/../box.obj"}, format="svg"))
        self.assertTrue(drawn[0].startswith("box.obj: scale ") and 'aria-label="box.obj"' in drawn[1], drawn[0])
        for path in ("../secret.obj", "link.obj", os.path.join(self.folder.name, "secret.obj"), "/etc/passwd", "../none", "/none/x"):
            result = self.pipe.call("facts", model={"path": path})
            self.assertTrue(result["isError"], path)
            self.assertIn("is no file below the folder", texts(result)[0])
        self.assertIn("did you mean box.obj?", texts(self.pipe.call("facts", model={"path": "bxo.obj"}))[0])
        self.assertIn("; the folder has 3 models and folders: box.obj, inside.obj, sub/", texts(self.pipe.call("facts", model={"path": "part.stl"}))[0])
        for path in ("sub", "sub/"):
            self.assertIn("is no file; the folder has 1 model or folder: both.obj", texts(self.pipe.call("facts", model={"path": path}))[0])
        for path, why in (("box.obj/", "Not a directory"), ("box.obj/x/box.obj", "Not a directory"), ("none/box.obj", "No such file or directory"), ("none/sub/box.obj", "No such file or directory")):
            self.assertIn(f"'{path}' cannot be read: {why} (did you mean box.obj?); the folder has 3 models", texts(self.pipe.call("facts", model={"path": path}))[0])
        self.assertIn("is no file below the folder", texts(self.pipe.call("facts", model={"path": "link.obj/x"}))[0])
        for i in range(30):
            open(os.path.join(self.root, "sub", f"{'a' * (200 if i == 3 else 9)}{i:02}.stl"), "w").close()
        for path in ("sub", "sub/none.stl"):
            listed = texts(self.pipe.call("facts", model={"path": path}))[0]
            self.assertRegex(listed, r"has 31 models and folders: a{9}00\.stl, a{9}01\.stl, .*, \.\.\.$")
        for scene, is_error in (({"meshes": [{"asset": "sub/both.obj"}]}, False), ({"meshes": [{"asset": "../secret.obj"}]}, True), ({"meshes": [{"asset": "link.obj"}]}, True)):
            self.assertEqual(self.pipe.call("facts", scene=scene)["isError"], is_error, scene)
        for name in ("box.obj", "model"):
            result = self.pipe.call("facts", model={"path": "box.obj"}, scene={"meshes": [{"name": "a", "asset": name}, {"asset": "sub/both.obj"}]})
            self.assertEqual(len(result["structuredContent"]["parts"]), 3)

    def test_lines(self):
        """Faults of a line are answered, empty lines and notifications are not, and the end of input ends the command"""
        for line in ("", "  ", json.dumps({"jsonrpc": "2.0", "method": "notifications/initialized"}), "{", "[]"):
            self.pipe.write(line)
        self.pipe.write({"jsonrpc": "2.0", "id": 5, "method": "ping"})
        rest, errors, status = self.pipe.stop()
        answers = [json.loads(line) for line in rest.splitlines()]
        self.assertEqual([a.get("error", {}).get("code") for a in answers], [-32700, -32600, None])
        self.assertEqual((answers[2]["id"], errors, status), (5, "", 0))

    def test_cancelled(self):
        """A cancelled call gets no answer, whether it has begun or waits"""
        views = [{"name": f"v{i}", "view": {"azimuthDegrees": 10 * i}} for i in range(8)]
        slow = {"name": "render", "arguments": {"scene": noise(), "look": "studio", "views": views, "width": 1568, "height": 1568}}
        for number in (1, "two"):
            self.pipe.write({"jsonrpc": "2.0", "id": number, "method": "tools/call", "params": slow})
        time.sleep(0.3)
        for number in ("two", 1):
            self.pipe.write({"jsonrpc": "2.0", "method": "notifications/cancelled", "params": {"requestId": number}})
        self.pipe.write({"jsonrpc": "2.0", "id": 3, "method": "ping"})
        rest, _, status = self.pipe.stop()
        self.assertEqual(([json.loads(line)["id"] for line in rest.splitlines()], status), ([3], 0))

    def test_agent_loop(self):
        """The example of an agent's loop finds its error by looking"""
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../clients/examples/agent_loop.py")
        ran = subprocess.run([sys.executable, script, os.path.join(build, "zraster")], capture_output=True, text=True)
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.assertIn("sees 3 holes", ran.stdout)
        self.assertIn("sees 4 holes: done after 2 attempts", ran.stdout)

    def test_last_line(self):
        """A last line without its end is answered, too"""
        ran = subprocess.run([os.path.join(build, "zraster"), "mcp", "--root", self.root], capture_output=True, text=True, input='{"jsonrpc":"2.0","id":1,"method":"ping"}')
        self.assertEqual((ran.returncode, json.loads(ran.stdout)["id"]), (0, 1))

    def test_usage(self):
        """Wrong flags of the command are named"""
        command = os.path.join(build, "zraster")
        for flags, expected in (([], "--root"), (["--root", "/none"], "/none"), (["--root", "/dev/null"], "Not a directory"), (["--root", ".", "x.stl"], "no file"), (["--root", ".", "--look", "clay"], "--look")):
            ran = subprocess.run([command, "mcp", *flags], capture_output=True, text=True, stdin=subprocess.DEVNULL)
            self.assertNotEqual(ran.returncode, 0)
            self.assertIn(expected, ran.stderr)


if __name__ == "__main__":
    unittest.main()
