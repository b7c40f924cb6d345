"""GET /, /v1/looks, /v1/examples, and requests from pages of other origins."""
import base64
import gzip
import hashlib
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import daemon

TRIANGLE = b'{"polygons": [{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]}'
PAGE_MOST = 60000
SHOWN = ["studio", "technical", "clay", "dark", "metal", "outdoor", "blueprint", "xray", "textbook"]


class Daemon(daemon.Daemon):
    def render(self, scene, files):
        """Posts a scene and files, {name: bytes}."""
        boundary = b"a1b2c3boundary"
        body = b""
        for name, value in [("scene", scene), *files.items()]:
            body += b'--%s\r\nContent-Disposition: form-data; name="%s"\r\n\r\n%s\r\n' % (boundary, name.encode(), value)
        body += b"--%s--\r\n" % boundary
        return self.send("/v1/render", body, Content_Type=f"multipart/form-data; boundary={boundary.decode()}")


class Case(daemon.Case):
    kind = Daemon


class Page(Case):
    def test_bytes(self):
        """the page comes compressed and whole, in at most 60 kB"""
        status, headers, data = self.daemon.send("/", Accept_Encoding="br, gzip")
        self.assertEqual((status, headers["Content-Type"]), (200, "text/html; charset=utf-8"))
        self.assertEqual(headers["Content-Encoding"], "gzip")
        self.assertLessEqual(len(data), PAGE_MOST)
        plain_status, plain_headers, plain = self.daemon.send("/", Accept_Encoding="gzip;q=0, identity")
        self.assertEqual((plain_status, plain_headers["Content-Encoding"]), (200, None))
        self.assertEqual(gzip.decompress(data), plain)
        self.assertIn(b"</html>", plain)

    def test_policy(self):
        """the policy has the hashes of the page's script and style, and nothing of the page breaks it"""
        _, headers, data = self.daemon.send("/")
        policy = headers["Content-Security-Policy"]
        self.assertTrue(policy.startswith("default-src 'none'; "))
        for tag, directive in (("script", "script-src"), ("style", "style-src")):
            (text,) = re.findall(rb"<%s>(.*?)</%s>" % (tag.encode(), tag.encode()), data, re.S)
            digest = base64.b64encode(hashlib.sha256(text).digest()).decode()
            self.assertIn(f"{directive} 'sha256-{digest}';", policy)
        self.assertIsNone(re.search(rb"innerHTML|\bon[a-z]+=[\"']|style=|(src|href)=\"https?:|\beval\(", data))
        for name, value in (("X-Content-Type-Options", "nosniff"), ("Referrer-Policy", "no-referrer"),
                            ("Cross-Origin-Opener-Policy", "same-origin"), ("Cross-Origin-Resource-Policy", "same-origin")):
            self.assertEqual(headers[name], value)

    def test_script(self):
        """the page's script is JavaScript: the rows of the core leave no C in it"""
        (script,) = re.findall(rb"<script>(.*?)</script>", self.daemon.send("/")[2], re.S)
        self.assertIsNone(re.search(rb"^(enum|struct|typedef) |^#", script, re.M))
        if not shutil.which("node"):
            self.skipTest("node, which checks the syntax, is missing")
        with tempfile.NamedTemporaryFile(suffix=".js") as file:
            file.write(script)
            file.flush()
            checked = subprocess.run(["node", "--check", file.name], capture_output=True, text=True)
        self.assertEqual((checked.returncode, checked.stderr), (0, ""))

    def test_tag(self):
        """each form of the page has a strong entity tag of its own, which gives 304"""
        tags = []
        for encoding in ("gzip", "identity"):
            _, headers, _ = self.daemon.send("/", Accept_Encoding=encoding)
            tags.append(headers["ETag"])
            self.assertRegex(tags[-1], '^"[^"]+"$')
            status, again, data = self.daemon.send("/", Accept_Encoding=encoding, If_None_Match=tags[-1])
            self.assertEqual((status, again["ETag"], data), (304, tags[-1], b""))
            self.assertEqual(self.daemon.send("/", Accept_Encoding=encoding, If_None_Match="*")[0], 304)
            self.assertEqual(self.daemon.send("/", Accept_Encoding=encoding, If_None_Match='"other"')[0], 200)
        self.assertNotEqual(*tags)

    def test_head(self):
        """HEAD has the headers of GET, other methods are refused, and the page is not below other paths"""
        status, headers, data = self.daemon.send("/", method="HEAD", Accept_Encoding="gzip")
        self.assertEqual((status, data), (200, b""))
        self.assertEqual(int(headers["Content-Length"]), len(self.daemon.send("/", Accept_Encoding="gzip")[2]))
        self.assertEqual(self.daemon.send("/", b"", "POST")[0], 405)
        self.assertEqual(self.daemon.send("/index.html")[0], 404)


class Off(Case):
    flags = ["--page=off", "--token=secret"]

    def test_off(self):
        """with --page=off there is no page, and the rest stays"""
        status, headers, data = self.daemon.send("/")
        self.assertEqual((status, headers["Content-Type"]), (404, "application/problem+json"))
        self.assertIn("--page=on", json.loads(data)["detail"])
        self.assertEqual(self.daemon.send("/v1/looks", Authorization="Bearer secret")[0], 200)

    def test_wrong(self):
        """--page takes on and off alone"""
        done = subprocess.run([os.path.join(daemon.build, "zrasterd"), "--page=yes"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (2, "zrasterd: --page: 'yes' is neither on nor off\n"))

    def test_wrong_origins(self):
        """--allow-origin takes schemes and hosts alone"""
        for origins in ("example.org", "https://a.example/", "ftp://a.example", "https://", "https://a.example, b"):
            command = [os.path.join(daemon.build, "zrasterd"), "--port=0", f"--allow-origin={origins}"]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, origins)
            self.assertIn(f"--allow-origin: '{origins}' is no list of origins", done.stderr)


class Engine(unittest.TestCase):
    """--engine-dir: the page draws by itself, too."""

    names = ("answers.mjs", "browser.mjs", "errors.mjs", "options.mjs", "remote.mjs", "worker.mjs", "worker_thread.mjs", "zraster.mjs", "zraster.wasm", "zraster-scalar.wasm")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.files = {name: name.encode() * 3000 for name in (*self.names, "package.json")}
        for name, data in self.files.items():
            with open(os.path.join(self.folder, name), "wb") as out:
                out.write(data)

    def start(self, *flags):
        started = Daemon("--engine-dir", self.folder, *flags)
        self.addCleanup(started.stop)
        return started

    def test_served(self):
        """each file is served with its type, whole and compressed, as at the start, and without a token"""
        started = self.start("--token=secret")
        for name in self.names:
            with open(os.path.join(self.folder, name), "ab") as out:
                out.write(b"later")
        for name in self.names:
            status, headers, data = started.send("/engine/" + name)
            wanted = "application/wasm" if name.endswith(".wasm") else "text/javascript; charset=utf-8"
            self.assertEqual((status, headers["Content-Type"], data), (200, wanted, self.files[name]))
            _, packed, data = started.send("/engine/" + name, Accept_Encoding="gzip")
            self.assertEqual((packed["Content-Encoding"], gzip.decompress(data)), ("gzip", self.files[name]))
            self.assertEqual((headers["Cache-Control"], headers["Vary"]), (packed["Cache-Control"], "Accept-Encoding"))
            self.assertEqual(headers["Cache-Control"], started.send("/")[1]["Cache-Control"])
            self.assertEqual(started.send("/engine/" + name, Accept_Encoding="gzip", If_None_Match=packed["ETag"])[0], 304)
            self.assertIn("script-src 'self' 'wasm-unsafe-eval';", headers["Content-Security-Policy"])

    def test_others(self):
        """no other file of the folder, and none outside it, can be reached"""
        started = self.start()
        for name in ("", "package.json", "zraster", "zraster.wasm/", "../engine/zraster.wasm", "%2e%2e/x", "./zraster.wasm", "Zraster.wasm"):
            status, headers, data = started.send("/engine/" + name)
            self.assertEqual((status, headers["Content-Type"]), (404, "application/problem+json"), name)
            self.assertIn("the page has no file", json.loads(data)["detail"])
        self.assertEqual(started.send("/engine/zraster.wasm", b"", "POST")[0], 405)

    def test_page(self):
        """the page of this daemon may compile a module and start a Worker; its policy has its own hashes"""
        page, plain = self.start().send("/"), self.start("--engine-dir=").send("/")
        for (_, headers, data), has_engine in ((page, True), (plain, False)):
            (script,) = re.findall(rb"<script>(.*?)</script>", data, re.S)
            policy = headers["Content-Security-Policy"]
            self.assertIn(base64.b64encode(hashlib.sha256(script).digest()).decode(), policy)
            for part in ("'self' 'wasm-unsafe-eval';", "worker-src 'self';"):
                self.assertEqual(part in policy, has_engine, policy)
            self.assertEqual(b"HAS_ENGINE = true" in script, has_engine)
            self.assertLessEqual(len(gzip.compress(data, 9, mtime=0)), PAGE_MOST)

    def test_limits(self):
        """/v1/limits says whether assets are stored, so that the page uploads none in vain"""
        for flags, stored in (([], False), (["--assets-dir", self.folder], True)):
            self.assertIs(json.loads(self.start(*flags).send("/v1/limits")[2])["keepsAssets"], stored)

    def test_none(self):
        """without the option, or the page, there are no files"""
        for flags, word in ((["--engine-dir="], "--engine-dir"), (["--page=off"], "--page=on")):
            status, _, data = self.start(*flags).send("/engine/zraster.wasm")
            self.assertEqual(status, 404)
            self.assertIn(word, json.loads(data)["detail"])

    def test_missing(self):
        """a missing, empty or odd file is refused at the start, by name"""
        path = os.path.join(self.folder, "worker.mjs")

        def refused(why):
            for flags in (["--port=0"], ["--check-config"]):
                command = [os.path.join(daemon.build, "zrasterd"), "--engine-dir", self.folder, *flags]
                done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=20)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertEqual(done.stderr, f"zrasterd: --engine-dir: {path}: {why}; the folder needs the package for JavaScript, of make npm\n")
        os.remove(path)
        refused("No such file or directory")
        with open(path, "wb"):
            pass
        refused("the file is empty")
        os.remove(path)
        os.mkfifo(path)
        refused("this is no regular file")


class Token(Case):
    flags = ["--token=secret"]

    def test_open(self):
        """the page needs no token, which it asks for; the lists do"""
        self.assertEqual(self.daemon.send("/")[0], 200)
        self.assertEqual(self.daemon.send("/v1/looks")[0], 401)
        self.assertEqual(self.daemon.send("/v1/examples/pawns")[0], 401)


class Lists(Case):
    def test_looks(self):
        """all looks are listed in their order, with versions that can be drawn, and texts"""
        looks = json.loads(self.daemon.send("/v1/looks")[2])["looks"]
        self.assertEqual([look["name"] for look in looks], SHOWN)
        for look in looks:
            self.assertGreater(len(look["text"]), 10)
            for version in look["versions"]:
                scene = json.loads(TRIANGLE) | {"look": f"{look['name']}@{version}"}
                self.assertEqual(self.daemon.send("/v1/render", json.dumps(scene).encode())[0], 200)
            scene["look"] = f"{look['name']}@{look['versions'][-1] + 1}"
            self.assertEqual(self.daemon.send("/v1/render", json.dumps(scene).encode())[0], 422)

    def test_examples(self):
        """each example is drawn with its files, without a warning"""
        examples = json.loads(self.daemon.send("/v1/examples")[2])["examples"]
        self.assertEqual(examples[0]["name"], "bearing")
        self.assertGreaterEqual(len(examples), 12)
        for example in examples:
            with self.subTest(example["name"]):
                files = {name: self.daemon.send("/v1/examples/" + name)[2] for name in example["files"]}
                status, headers, scene = self.daemon.send("/v1/examples/" + example["name"])
                self.assertEqual((status, headers["Content-Type"]), (200, "application/json"))
                status, headers, data = self.daemon.render(scene, files)
                self.assertEqual((status, headers["Zraster-Warnings"]), (200, None), data[:300])

    def test_no_example(self):
        """a name that is no example's is 404"""
        for name in ("", "pawn", "pawns/", "../looks"):
            self.assertEqual(self.daemon.send("/v1/examples/" + name)[0], 404)

    def test_shells_are_closed(self):
        """the models of the examples are closed, and no face of them is degenerate"""
        for name in ("pawn.obj", "ball.obj", "egg.obj"):
            mesh = self.daemon.send("/v1/examples/" + name)[2]
            info = json.loads(self.daemon.send("/v1/render?channel=info&render=false", mesh)[2])
            self.assertTrue(info["parts"][0]["closed"], name)
            self.assertGreater(info["parts"][0]["volume"], 0)
            self.assertEqual(info["warnings"], [])

    def test_offset(self):
        """broken JSON has the byte at which it breaks, other faults have none"""
        for text, offset in ((b'{"a": x}', 6), ('{"look": "é", '.encode(), 15), (b"{\n\n 1}", 4),
                             (b'\xef\xbb\xbf{"a": x}', 9), (b'{"a": "\\x"}', 7), (b'{"a": "\\', 8)):
            error = json.loads(self.daemon.send("/v1/render", text, Content_Type="application/json")[2])["errors"][0]
            self.assertEqual(error["offset"], offset)
        error = json.loads(self.daemon.send("/v1/render", b'{"a": 1}')[2])["errors"][0]
        self.assertNotIn("offset", error)


class Sites(Case):
    flags = ["--allow-origin=https://one.example, http://127.0.0.1:3000"]

    def test_refused(self):
        """a page of another origin draws and stores nothing"""
        for site in ("cross-site", "same-site"):
            for path, method in (("/v1/render", "POST"), ("/v1/assets", "POST"), ("/v1/assets/" + "0" * 64, "PUT"), ("/mcp", "POST")):
                status, headers, data = self.daemon.send(path, TRIANGLE, method, Sec_Fetch_Site=site, Origin="https://two.example")
                self.assertEqual((status, headers["Content-Type"]), (403, "application/problem+json"))
                self.assertIn("https://two.example", json.loads(data)["detail"])
                self.assertIsNone(headers["Access-Control-Allow-Origin"])
        status, headers, _ = self.daemon.send("/render", b"", "POST", Sec_Fetch_Site="cross-site")
        self.assertEqual((status, headers["Content-Type"]), (403, "text/plain; charset=utf-8"))

    def test_taken(self):
        """the daemon's own page, a person's own request and other clients are answered"""
        for site in ("same-origin", "none"):
            self.assertEqual(self.daemon.send("/v1/render", TRIANGLE, Sec_Fetch_Site=site)[0], 200)
        self.assertEqual(self.daemon.send("/v1/render", TRIANGLE)[0], 200)
        self.assertEqual(self.daemon.send("/v1/limits", Sec_Fetch_Site="cross-site")[0], 200)

    def test_cors(self):
        """an origin of --allow-origin is answered, and its browser may read the answer"""
        for origin in ("https://one.example", "http://127.0.0.1:3000"):
            status, headers, _ = self.daemon.send("/v1/render", TRIANGLE, Sec_Fetch_Site="cross-site", Origin=origin)
            self.assertEqual((status, headers["Access-Control-Allow-Origin"]), (200, origin))
            self.assertIn("Origin", headers["Vary"])
            self.assertIn("Server-Timing", headers["Access-Control-Expose-Headers"])
        for origin in ("https://one.example.org", "https://one", "http://one.example", "null"):
            status, headers, _ = self.daemon.send("/v1/render", TRIANGLE, Sec_Fetch_Site="cross-site", Origin=origin)
            self.assertEqual((status, headers["Access-Control-Allow-Origin"]), (403, None))

    def test_preflight(self):
        """a preflight of such an origin is answered without a token; others get none of the headers of CORS"""
        ask = {"Origin": "https://one.example", "Access_Control_Request_Method": "POST"}
        status, headers, data = self.daemon.send("/v1/render", None, "OPTIONS", **ask)
        self.assertEqual((status, headers["Access-Control-Allow-Methods"], data), (204, "POST", b""))
        self.assertEqual(headers["Access-Control-Max-Age"], "7200")
        for name in ("Authorization", "MCP-Protocol-Version", "Mcp-Method", "Mcp-Name", "traceparent"):
            self.assertIn(name, headers["Access-Control-Allow-Headers"])
        status, headers, _ = self.daemon.send("/v1/render", None, "OPTIONS", Origin="https://one.example")
        self.assertEqual((status, headers["Access-Control-Allow-Methods"]), (204, None))
        status, headers, _ = self.daemon.send("/v1/render", None, "OPTIONS", **ask | {"Origin": "https://two.example"})
        self.assertEqual(status, 204)
        self.assertEqual([name for name in headers if name.startswith("Access-Control")], [])

    def test_vary(self):
        """each answer says in one line that it depends on the origin, beside what else it depends on"""
        for path, names in (("/", "Accept-Encoding, Origin"), ("/v1/limits", "Origin"), ("/none", "Origin")):
            for origin in ({}, {"Origin": "https://one.example"}, {"Origin": "https://two.example"}):
                _, headers, _ = self.daemon.send(path, **origin)
                self.assertEqual(headers.get_all("Vary"), [names])
        _, headers, _ = self.daemon.send("/v1/render", TRIANGLE, Sec_Fetch_Site="cross-site", Origin="https://two.example")
        self.assertEqual(headers.get_all("Vary"), ["Origin"])
        self.assertEqual(self.daemon.send("/v1/render", TRIANGLE)[1].get_all("Vary"), ["Accept, Origin"])


class AnySite(Case):
    flags = ["--allow-origin=*", "--token=secret"]

    def test_any(self):
        """with * any page may ask, if it has the token, and the answers are the same for all"""
        ask = {"Sec_Fetch_Site": "cross-site", "Origin": "https://two.example"}
        status, headers, _ = self.daemon.send("/v1/render", TRIANGLE, **ask)
        self.assertEqual((status, headers["Access-Control-Allow-Origin"]), (401, "*"))
        self.assertEqual(self.daemon.send("/v1/render", TRIANGLE, Authorization="Bearer secret", **ask)[0], 200)
        self.assertEqual(self.daemon.send("/v1/render", None, "OPTIONS", Origin="https://two.example")[0], 204)
        _, headers, _ = self.daemon.send("/v1/limits")
        self.assertEqual((headers["Access-Control-Allow-Origin"], headers["Vary"]), ("*", None))
