"""Pictures with an address: GET /v1/renders/{sha256}."""
import glob
import hashlib
import http.client
import json
import os
import tempfile
import threading
import unittest
import urllib.parse

import daemon

SCENE = b'{"window":{"width":64,"height":48},%s"polygons":[{"vertices":[[0,0,0],[1,0,0],[0,1,0]]}]}'
CUBE = b"""v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"""
FOREVER, SOON = "public, max-age=31536000, immutable", "public, max-age=300"


def sha256(data):
    return hashlib.sha256(data).hexdigest()


class Client:
    """A kept connection."""

    def __init__(self, server):
        self.connection = http.client.HTTPConnection(urllib.parse.urlsplit(server.address).netloc)

    def send(self, method, path, body=None, **headers):
        self.connection.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
        answer = self.connection.getresponse()
        return answer.status, answer.headers, answer.read()

    def put(self, data):
        name = sha256(data)
        status, _, text = self.send("PUT", "/v1/scenes/" + name, data)
        assert status in (200, 201), text
        return name

    def close(self):
        self.connection.close()


class Folder(unittest.TestCase):
    flags = ()

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.daemon = daemon.Daemon("--assets-dir", cls.folder.name, *cls.flags)
        cls.addClassCleanup(cls.daemon.stop)
        cls.client = Client(cls.daemon)
        cls.addClassCleanup(cls.client.close)

    def get(self, name, query="", method="GET", **headers):
        return self.client.send(method, f"/v1/renders/{name}{query}", **headers)

    def assert_problem(self, answer, status, words):
        self.assertEqual(answer[0], status, answer[2])
        self.assertIn(words, json.loads(answer[2])["detail"])
        self.assertEqual((answer[1]["Cache-Control"], answer[1]["ETag"]), ("no-store", None))

    def counts(self):
        return json.loads(self.client.send("GET", "/healthz")[2])["answers"]


class Addresses(Folder):
    def test_store(self):
        """scenes and assets are one store"""
        data = SCENE % b" "
        name = sha256(data)
        status, headers, text = self.client.send("PUT", "/v1/scenes/" + name, data)
        self.assertEqual((status, headers["Location"], json.loads(text)["sha256"]), (201, "/v1/scenes/" + name, name))
        for path in ("/v1/scenes/", "/v1/assets/"):
            self.assertEqual(self.client.send("GET", path + name)[2], data)
            self.assertEqual(self.client.send("PUT", path + name, data)[0], 200)
        self.assert_problem(self.client.send("PUT", "/v1/scenes/" + name, data + b" "), 422, name)
        self.assert_problem(self.client.send("POST", "/v1/scenes/" + name, data), 405, "GET, HEAD, PUT")

    def test_bytes(self):
        """an address has the bytes of a render with the same query"""
        for data, kind in ((SCENE % b"", "application/json"), (CUBE, "model/obj")):
            name = self.client.put(data)
            for query in ("", "?channel=color,depth", "?encoding=jpeg&quality=50"):
                answer = self.get(name, query)
                posted = self.client.send("POST", "/v1/render" + query, data, Content_Type=kind)
                self.assertEqual((answer[0], answer[2]), (200, posted[2]))
                for header in ("Content-Type", "Zraster-Look", "Zraster-Encoder", "Zraster-Warnings"):
                    self.assertEqual(answer[1][header], posted[1][header])
                self.assertRegex(answer[1]["ETag"], '^"[0-9a-f]{64}"$')
                self.assertEqual((answer[1]["Accept-Ranges"], answer[1]["Vary"]), ("none", None))

    def test_accept(self):
        """several files are a ZIP, whatever Accept says, and ranges are answered whole"""
        name = self.client.put(CUBE)
        plain = self.get(name, "?channel=color,info")
        for headers in ({"Accept": "multipart/mixed"}, {"Range": "bytes=0-9"}, {"Range": "bytes=0-9", "If_Range": plain[1]["ETag"]},
                        {"Range": "bytes=" + ",".join(f"{i}-" for i in range(800))}):
            answer = self.get(name, "?channel=color,info", **headers)
            self.assertEqual((answer[0], answer[1]["Content-Type"], answer[2]), (200, "application/zip", plain[2]))

    def test_head(self):
        """HEAD has the headers and the status of GET, with its length once it is known"""
        name = self.client.put(CUBE + b"# head")
        for query in ("", "?look=clay@1", "?look=dark"):
            first, got, told = self.get(name, query, "HEAD"), self.get(name, query), self.get(name, query, "HEAD")
            self.assertEqual((first[0], first[2], first[1]["Content-Length"], first[1]["Connection"]), (200, b"", None, "close"))
            self.assertEqual((told[0], told[2], told[1]["Content-Length"]), (200, b"", str(len(got[2]))))
            for header in ("ETag", "Cache-Control", "Accept-Ranges", "Zraster-Look"):
                self.assertEqual(told[1][header], got[1][header])
            self.assertNotIn("render", told[1]["Server-Timing"])
        self.assertEqual(self.get(name, "?width=0", "HEAD")[0], 400)
        self.assertEqual(self.get(sha256(b"none"), "", "HEAD")[0], 404)

    def test_unchanged(self):
        """a client that has the picture gets 304, which draws nothing"""
        name = self.client.put(CUBE)
        first = self.get(name, "?look=studio@1")
        tag, length = first[1]["ETag"], first[1]["Content-Length"]
        for tags in (tag, "W/" + tag, f'"a", {tag} , "b"', "*"):
            for method in ("GET", "HEAD"):
                status, headers, data = self.get(name, "?look=studio@1", method, If_None_Match=tags)
                self.assertEqual((status, data, headers["Content-Length"], headers["Server-Timing"]), (304, b"", length, None), tags)
                self.assertEqual((headers["ETag"], headers["Cache-Control"]), (tag, FOREVER))
        for tags in (tag[1:-1], tag.replace('"', ""), '"' + name + '"', tag[:-2] + '"'):
            self.assertEqual(self.get(name, "?look=studio@1", If_None_Match=tags)[0], 200)
        self.assertEqual(self.get(name, "?look=studio@1&width=99", If_None_Match=tag)[0], 200)
        self.assertIsNone(self.get(name, "?look=studio@1&width=98", If_None_Match="*")[1]["Content-Length"])
        scene = self.client.put(SCENE % b"  ")
        tag = self.get(scene)[1]["ETag"]
        self.assertEqual(self.get(scene, If_None_Match=tag)[1]["Cache-Control"], FOREVER)
        gone = sha256(b"gone")
        self.assert_problem(self.get(gone, If_None_Match="*"), 404, "no scene is kept")

    def test_cache_control(self):
        """pictures with pinned looks stay for ever"""
        for data, query, wanted in ((CUBE, "", SOON), (CUBE, "?look=studio", SOON), (CUBE, "?look=studio@1", FOREVER),
                                    (SCENE % b"", "", FOREVER), (SCENE % b'"look":"studio",', "", SOON),
                                    (SCENE % b'"look":"studio@1",', "", FOREVER)):
            self.assertEqual(self.get(self.client.put(data), query)[1]["Cache-Control"], wanted, (data, query))

    def test_spelling(self):
        """one picture has one tag, however its query is spelt"""
        name = self.client.put(CUBE)
        tags = lambda *queries: {self.get(name, query, "HEAD")[1]["ETag"] for query in queries}
        self.assertEqual(len(tags("?width=80&color=red", "?color=%23F00&width=080", "?color=%23ff0000&width=80&compress=fast")), 1)
        newest = self.get(name, "?look=studio")[1]["Zraster-Look"]
        self.assertEqual(len(tags("?look=studio", "?look=" + newest, "?look=studio&fileLights=0")), 1)
        self.assertEqual(len(tags("", "?look=studio", "?look=technical", "?width=80", "?compress=small", "?channel=depth")), 6)

    def test_refused(self):
        """refusals say what to do"""
        name = self.client.put(CUBE)
        for query in ("?url=http://example.org/part.stl", "?width=9&url=x", "?url"):
            self.assert_problem(self.get(name, query), 400, "upload the file by PUT /v1/scenes/{sha256}")
        self.assert_problem(self.get(name, "?widht=9"), 400, "did you mean width?")
        self.assert_problem(self.get(name, "?width=9&width=9"), 400, "duplicate parameter 'width'")
        self.assert_problem(self.get(name, "?width=99999"), 422, "99999")
        self.assert_problem(self.get(name, "?look=studi"), 400, "studio")
        self.assert_problem(self.get(name, "/small"), 404, "there is no preset 'small'")
        self.assert_problem(self.get(sha256(b"none")), 404, "upload it by PUT")
        for path in ("", "x", name.upper(), name + "0", name[:-1], "../" + name, name[:-1] + "/"):
            self.assert_problem(self.get(path), 404, "64 lower-case")
        self.assert_problem(self.client.send("POST", "/v1/renders/" + name), 405, "GET, HEAD")
        self.assert_problem(self.client.send("GET", "/v1/renders"), 404, "/v1/scenes/, /v1/renders/")

    def test_hostile(self):
        """files that are no scene, and scenes beyond the limits, are refused as in a render"""
        png = self.get(self.client.put(CUBE))[2]
        self.assert_problem(self.get(self.client.put(png)), 422, "PNG picture")
        self.assert_problem(self.get(self.client.put(b"")), 400, "is empty")
        self.assertEqual(self.get(self.client.put(b'{"polygons":'), "", "HEAD")[0], 400)
        missing = b'{"look":"studio@1","meshes":[{"asset":"sha256:%s"}]}' % sha256(b"missing").encode()
        self.assert_problem(self.get(self.client.put(missing)), 422, "no asset is kept")

    def test_assets(self):
        """a scene draws the files that it names by hash"""
        mesh = self.client.put(CUBE)
        name = self.client.put(b'{"look":"studio@1","window":{"width":64,"height":48},"meshes":[{"asset":"sha256:%s"}]}' % mesh.encode())
        self.assertEqual(self.get(name)[0], 200)


class Bounds(Folder):
    flags = ("--keep-answer-bytes=65536", "--body-max-bytes=300000")

    def test_large(self):
        """a file that another daemon stored may be too large for this one"""
        data = CUBE + b"#" * 300000
        with open(os.path.join(self.folder.name, sha256(data)), "wb") as out:
            out.write(data)
        self.assert_problem(self.get(sha256(data)), 413, "bodyMaxBytes is 300000")

    def test_kept(self):
        """a kept answer has the bytes and headers of the drawn one, and outlives its scene"""
        name = self.client.put(CUBE)
        before = self.counts()
        query = "?width=70&channel=color,info"
        first = self.get(name, query)
        again = self.get(name, query.replace("70", "070"))
        self.assertEqual(first[2], again[2])
        self.assertIn("render", first[1]["Server-Timing"])
        del first[1]["Server-Timing"]
        for headers in (first[1], again[1]):
            del headers["Date"], headers["X-Request-Id"]
        self.assertEqual(sorted(first[1].items()), sorted(again[1].items()))
        counts = self.counts()
        self.assertEqual((counts["hits"] - before["hits"], counts["misses"] - before["misses"]), (1, 1))
        told = self.get(name, query, "HEAD")
        self.assertEqual((told[0], told[2], told[1]["Content-Length"]), (200, b"", str(len(first[2]))))
        self.assertEqual(self.get(name, query, If_None_Match=first[1]["ETag"])[0], 304)
        os.remove(os.path.join(self.folder.name, name))
        self.assertEqual(self.get(name, query)[2], first[2])
        self.assertEqual(self.get(name, "?width=71")[0], 404)

    def test_kept_bound(self):
        """kept answers stay within their bytes, and displace the least recently used"""
        name = self.client.put(CUBE + b"#")
        for width in range(200, 240):
            self.assertEqual(self.get(name, f"?look=textbook&height=64&width={width}")[0], 200)
        counts = self.counts()
        self.assertLessEqual(counts["bytes"], 65536)
        self.assertGreater(counts["count"], 0)
        self.assertGreater(counts["dropped"], 0)
        self.assert_problem(self.get(name, "?width=0"), 400, "width")
        self.assertEqual(self.counts()["count"], counts["count"])

    def test_kept_shared(self):
        """many readers share a kept answer while others displace it"""
        name = self.client.put(CUBE + b"##")
        wanted = {width: self.get(name, f"?look=textbook&height=40&width={width}")[2] for width in range(300, 308)}
        faults = []

        def ask(seed):
            client = Client(self.daemon)
            for i in range(60):
                width = 300 + (i * (seed + 1)) % 8
                answer = client.send("GET", f"/v1/renders/{name}?look=textbook&height=40&width={width}")
                if answer[0] != 200 or answer[2] != wanted[width]:
                    faults.append(answer[:2])
            client.close()

        threads = [threading.Thread(target=ask, args=(seed,)) for seed in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, [])


QUERIES = ["", "?channel=depth", "?encoding=jpeg", "?strict=0&compress=fast", "?channel=info", "?encoding=jpeg&quality=85"]
OF_MESHES = ["?height=48&look=textbook", "?look=textbook&height=048", "?look=textbook@1&height=48&fileLights=0", "?height=48&look=studio&width=64",
             "?look=studio&width=64&height=48&exposure=1e0", "?look=studio&width=64&height=48&color=tomato"]


def scenes():
    """Returns 200 scenes and models with their queries."""
    made = []
    for path in sorted(glob.glob("tests/scenes/*.json")):
        if not os.path.basename(path).startswith("look-"):  # these are large
            with open(path, "rb") as file:
                made.append((file.read(), QUERIES))
    for look in (b"studio", b"studio@1", b"technical", b"metal@1", b"xray"):
        for side in range(40, 44):
            made.append((SCENE.replace(b"64", b"%d" % side) % b'"look":"%s",' % look, QUERIES))
    while len(made) < 200:
        made.append((CUBE.replace(b"v 1 1 1", b"v 1 1 1.%d" % len(made)), OF_MESHES))
    return made[:200]


class Tags(unittest.TestCase):
    def test_equal_tags_are_equal_bytes(self):
        """200 scenes with 6 queries each: equal tags mean equal bytes, over restarts, threads and instruction sets"""
        digest_of, tags_of, drawn = {}, {}, 0
        with tempfile.TemporaryDirectory() as folder:
            for flags in (("--threads=1", "--isa=scalar"), ("--threads=3", "--keep-answer-bytes=100000000")):
                server = daemon.Daemon("--assets-dir", folder, *flags)
                self.addCleanup(server.stop)
                client = Client(server)
                for data, queries in scenes():
                    name = client.put(data)
                    for query in queries:
                        status, headers, body = client.send("GET", f"/v1/renders/{name}{query}")
                        if status != 200:
                            self.assertEqual((status, headers["ETag"]), (422, None), (data[:80], query, body))
                            continue
                        drawn += 1
                        digest = sha256(body)
                        self.assertEqual(digest_of.setdefault(headers["ETag"], digest), digest, (data[:80], query, flags))
                        tags_of.setdefault((name, digest), set()).add(headers["ETag"])
                client.close()
        self.assertGreater(drawn, 2000)
        # Queries that give a default of the scene, such as its only channel or the quality of JPEG, have tags of their own.
        doubles = sum(len(tags) - 1 for tags in tags_of.values())
        self.assertLess(doubles, drawn / 5)


class Presets(unittest.TestCase):
    def test_presets(self):
        """a preset is the same picture as its parameters; with --only-presets nothing else is drawn"""
        with tempfile.TemporaryDirectory() as folder, tempfile.NamedTemporaryFile("w", suffix=".txt") as presets:
            presets.write("small = look=studio@1&width=64&height=48\n")
            presets.flush()
            server = daemon.Daemon("--assets-dir", folder, "--presets", presets.name)
            self.addCleanup(server.stop)
            client = Client(server)
            address = "/v1/renders/" + client.put(CUBE)
            named, spelt = client.send("GET", address + "/small"), client.send("GET", address + "?height=48&width=64&look=studio@1")
            self.assertEqual((named[0], named[1]["ETag"], named[1]["Cache-Control"], named[2]), (200, spelt[1]["ETag"], SOON, spelt[2]))
            self.assertEqual(client.send("GET", address + "/small?channel=depth")[0], 200)
            for path, words in (("/small?width=65", "duplicate parameter 'width'"), ("/large", "there are: small")):
                self.assertIn(words, json.loads(client.send("GET", address + path)[2])["detail"])
            client.close()
            server = daemon.Daemon("--assets-dir", folder, "--presets", presets.name, "--only-presets=on")
            self.addCleanup(server.stop)
            client = Client(server)
            self.assertEqual(client.send("GET", address + "/small")[2], named[2])
            for path in ("", "?width=64", "/small?channel=depth"):
                self.assertEqual(client.send("GET", address + path)[0], 403, path)
            client.close()


class Cost(Folder):
    flags = ("--cost-max-ms=1",)

    def test_cost(self):
        """work beyond costMaxMs is 422, as in a render, also for HEAD"""
        scene = SCENE.replace(b"64", b"1000").replace(b"48", b"1000") % b'"look":"studio@1",'
        name = self.client.put(scene)
        self.assert_problem(self.get(name), 422, "costMaxMs")
        self.assertEqual(self.client.send("POST", "/v1/render", scene, Content_Type="application/json")[0], 422)
        self.assertEqual(self.get(name, "", "HEAD")[0], 422)


class Nowhere(unittest.TestCase):
    def test_no_store(self):
        """without a folder for assets, the answer says how to have one"""
        server = daemon.Daemon()
        self.addCleanup(server.stop)
        for path in ("/v1/renders/" + "0" * 64, "/v1/scenes/" + "0" * 64):
            status, _, data = server.request(path)
            self.assertEqual(status, 404)
            self.assertIn("--assets-dir=DIRECTORY", json.loads(data)["detail"])
