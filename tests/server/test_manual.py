"""The manual below /docs/: every page and picture is there, every link leads to one, and no mark of Markdown is left."""
import gzip
import html.parser
import http.client
import json
import os
import re
import subprocess
import tempfile
import urllib.parse

import daemon

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
VOID = {"meta", "link", "img", "source", "br", "hr"}
ALL_BYTES_MOST = 4_000_000


class Page(html.parser.HTMLParser):
    """Links, addresses and text of a page; wrong nesting, of tags or headings, raises an error."""

    def __init__(self, text):
        super().__init__()
        self.links, self.ids, self.text, self.open, self.scripts = [], [], [], [], 0
        self.sidebar = []
        self.level = 0
        self.feed(text)
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.links += [value for key, value in attributes if key in ("href", "src", "srcset")]
        self.sidebar += [values["href"]] if tag == "a" and "nav" in self.open else []
        self.ids += [values["id"]] if "id" in values else []
        self.scripts += tag == "script" or any(key.startswith("on") or key == "style" for key in values)
        if re.fullmatch("h[1-6]", tag) and "nav" not in self.open:
            assert int(tag[1]) <= self.level + 1, f"a heading <{tag}> behind <h{self.level}>: {self.getpos()}"
            self.level = int(tag[1])
        if tag == "img":
            assert values.get("alt") is not None, self.get_starttag_text()
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open, self.getpos())
        self.open.pop()

    def handle_data(self, data):
        if not {"code", "pre", "title"} & set(self.open):
            self.text.append(data)


def marks(text):
    """Marks of Markdown in the text of a page."""
    return re.findall(r"`|\*\*|\]\(|^ *#+ |^ *\|.*\||\|---|^ *```|(?<!\w)\*\w|\\[|*<_]|<[a-z/]", text, re.M)


class Manual(daemon.Case):
    def test_links(self):
        """from /docs/ on, each link leads to a page, a picture or a heading; no mark of Markdown and no script is there"""
        waiting, pages, files, wanted = ["/docs/"], {}, set(), []
        while waiting:
            at = waiting.pop()
            status, headers, data = self.daemon.send(at)
            self.assertEqual(status, 200, at)
            files.add(at)
            if not headers["Content-Type"].startswith("text/html") or at == "/":
                continue
            with self.subTest(page=at):
                page = pages[at] = Page(data.decode())
                self.assertEqual(marks("\n".join(page.text)), [])
                self.assertEqual(page.scripts, 0)
                self.assertEqual(len(page.ids), len(set(page.ids)), page.ids)
                self.assertGreater(len(page.sidebar), 20)
                self.assertEqual(len(page.sidebar), len(set(page.sidebar)), "a page is listed twice in the sidebar")
                for link in page.links:
                    if link.startswith(("https://", "http://", "data:")):
                        continue
                    target, mark = urllib.parse.urldefrag(urllib.parse.urljoin(at, link))
                    wanted.append((at, target, mark))
                    if target not in files and target not in waiting:
                        waiting.append(target)
        scenes = [(target, mark) for _, target, mark in wanted if mark.startswith("%7B")]
        self.assertGreater(len(scenes), 20)
        for target, mark in scenes: # scenes, which the page opens
            self.assertEqual(target, "/")
            self.assertIsInstance(json.loads(urllib.parse.unquote(mark)), dict)
        for at, target, mark in wanted:
            if mark and not mark.startswith("%7B"):
                self.assertIn(mark, pages[target].ids, f"{at}: {target}#{mark}")
        sources = [name for _, _, names in os.walk(f"{ROOT}/clients/docs") for name in names if name.endswith(".md")]
        self.assertGreaterEqual(len(pages), len(sources) + 4)
        self.assertGreaterEqual(sum(file.endswith(".png") for file in files), 15)

    def test_parser(self):
        """text that was not rendered, and wrong nesting, would be found"""
        for wrong in ("a `b`", "a **b**", "[a](b)", "## a", "| a | b |", "an *a*", "a \\| b", "```sh", "&lt;br>".replace("&lt;", "<")):
            self.assertTrue(marks(wrong), wrong)
        self.assertFalse(marks("a * b, C# and (c) | 2 < 3"))
        for wrong in ("<p><em>a</p></em>", "<h1>a</h1><h3>b</h3>", "<img src=a.png>"):
            with self.assertRaises(AssertionError):
                Page(wrong)

    def test_answers(self):
        """pages have a strict policy, a strong entity tag and the type of their file; they come compressed or not"""
        for at, content_type in (("/docs/", "text/html; charset=utf-8"), ("/docs/quickstart", "text/html; charset=utf-8"),
                                 ("/docs/manual.css", "text/css; charset=utf-8"), ("/docs/gallery/still.webp", "image/webp"), ("/docs/gallery/look-clay.png", "image/png")):
            status, headers, data = self.daemon.send(at, Accept_Encoding="gzip")
            self.assertEqual((status, headers["Content-Type"], headers["X-Content-Type-Options"]), (200, content_type, "nosniff"))
            self.assertTrue(headers["Content-Security-Policy"].startswith("default-src 'none'; style-src 'self'; img-src 'self' data:;"))
            self.assertNotIn("script", headers["Content-Security-Policy"])
            is_text = content_type.startswith("text/")
            self.assertEqual(headers["Content-Encoding"], "gzip" if is_text else None)
            _, plain_headers, plain = self.daemon.send(at, Accept_Encoding="identity")
            self.assertEqual(gzip.decompress(data) if is_text else data, plain)
            self.assertEqual(headers["ETag"] != plain_headers["ETag"], is_text)
            self.assertEqual(self.daemon.send(at, Accept_Encoding="gzip", If_None_Match=headers["ETag"])[0], 304)
            self.assertEqual(self.daemon.send(at, b"", "POST")[0], 405)

    def test_addresses(self):
        """/docs leads to /docs/, and other addresses are not found"""
        connection = http.client.HTTPConnection(urllib.parse.urlsplit(self.daemon.address).netloc)
        connection.request("GET", "/docs")
        answer = connection.getresponse()
        self.assertEqual((answer.status, answer.headers["Location"]), (308, "docs/"))
        connection.close()
        for at in ("/docs/nothing", "/docs/quickstart.md", "/docs/../docs/", "/docs/index", "/docs/quickstart/"):
            status, headers, data = self.daemon.send(at)
            self.assertEqual((status, headers["Content-Type"]), (404, "application/problem+json"), at)
        self.assertIn("/docs/", json.loads(data)["detail"])

    def test_build(self):
        """two builds give the same bytes, of at most 4 MB"""
        with tempfile.TemporaryDirectory() as folder:
            builds = []
            for _ in range(2):
                subprocess.run(["server/manual/build.sh", f"{folder}/manual.c"], cwd=ROOT, check=True)
                with open(f"{folder}/manual.c", encoding="utf-8") as file:
                    builds.append(file.read())
            self.assertEqual(*builds)  # with the hash of each file
            sizes = [int(size) for size in re.findall(r"manual_bytes_\d+, (\d+), ", builds[0])]
        self.assertGreater(len(sizes), 200)
        self.assertLessEqual(sum(sizes), ALL_BYTES_MOST)


class Off(daemon.Case):
    flags = ["--page=off"]

    def test_off(self):
        """with --page=off there is no manual"""
        for at in ("/docs", "/docs/", "/docs/quickstart"):
            self.assertEqual(self.daemon.send(at)[0], 404)


class Token(daemon.Case):
    flags = ["--token=secret"]

    def test_open(self):
        """the manual needs no token"""
        self.assertEqual(self.daemon.send("/docs/quickstart")[0], 200)


class Link(daemon.Case):
    def test_link(self):
        """the page at / links to the manual"""
        self.assertIn(b'href="docs/"', self.daemon.send("/")[2])
