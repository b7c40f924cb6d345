"""Rules of style for the README, the pages of clients/docs and the help of both programs: short sentences and cells, and no
phrases that readers stumble over. Prose is all but code, tables, headings and HTML. Files that pages and comments name exist."""
import fnmatch
import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
BUILD = os.path.abspath(sys.argv[1])
SENTENCE_WORDS, CELL_WORDS = 30, 25

NUMBER = r"(?:\d[\d.,]*|one|two|three|four|five|ten)"
RULES = (
    (re.compile(r"\b(?:goes|go) before\b"), "'goes before': overrides, or replaces"),
    (re.compile(r"\bis out\b(?! of\b)"), "'is out': is ignored, or left out"),
    (re.compile(r"\bis told\b"), "'is told': say who acts"),
    (re.compile(r"\bis said\b"), "'is said': say who acts"),
    (re.compile(r"\bis had\b"), "'is had': has, or results from"),
    (re.compile(NUMBER + r"(?: (?!(?:of|in|to|is|as|at|by|for|from|on|with|and|or)\b)[a-z]+){0,2} an? (?:pixel|worker|polygon)\b"), "'a pixel' as a rate: per pixel"),
)
OPENINGS = re.compile(r"(?:What|Whoever|Where there)\b")


def plain(text):
    """Markdown without its marks; code counts as one word."""
    text = re.sub(r"`[^`]*`", "CODE", text)
    text = re.sub(r"!\[[^]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"<[^>]*>", " ", text)
    return re.sub(r"[*_]{1,2}(\S[^*_]*)[*_]{1,2}", r"\1", text)


def count_words(text):
    return sum(any(c.isalnum() for c in word) for word in text.split())


def sentences(text):
    return [part for part in re.split(r"(?<=[.!?])[\"')]* +(?=[\"'(]?[A-Z0-9])", text.strip()) if part]


def judge(text, where, findings, is_cell=False):
    """Adds what one paragraph, item or cell does wrong."""
    if is_cell and count_words(text) > CELL_WORDS:
        findings.append(f"{where}: a cell of {count_words(text)} words: {text.strip()}")
    for sentence in sentences(text):
        words = count_words(sentence)
        if words > SENTENCE_WORDS and not is_cell:
            findings.append(f"{where}: {words} words: {sentence}")
        if OPENINGS.match(sentence) and not sentence.rstrip().endswith("?"):
            findings.append(f"{where}: begins with '{sentence.split()[0]}': {sentence}")
    for rule, text_of in RULES:
        found = rule.search(text)
        if found:
            findings.append(f"{where}: {text_of}: ...{text[max(0, found.start() - 30):found.end() + 30]}...")


def check_page(path, name):
    """Returns the findings in a page."""
    findings, paragraph, start, fenced, quiet = [], [], 0, False, False

    def end():
        if paragraph:
            judge(plain(" ".join(paragraph)), f"{name}:{start}", findings)
        paragraph.clear()

    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    for number, line in enumerate(lines, 1):
        if line.lstrip().startswith("```"):
            end()
            fenced = not fenced
        elif fenced:
            continue
        elif line.lstrip().startswith("|"):
            end()
            if not re.fullmatch(r"[ |:-]*", line):
                for cell in re.split(r"(?<!\\)\|", line.strip().strip("|")):
                    judge(plain(cell), f"{name}:{number}", findings, is_cell=True)
        elif not line.strip() or line.startswith("#") or line.startswith("    ") and not paragraph:
            end()
        elif re.match(r" *(?:[-*]|\d+\.) ", line):
            end()
            start = number
            paragraph.append(re.sub(r"^ *(?:[-*]|\d+\.) ", "", line))
        else:
            if not paragraph:
                start = number
            paragraph.append(line.strip())
    end()
    return findings


def pages():
    return ["README.md"] + sorted(os.path.relpath(path, ROOT) for path in glob.glob(f"{ROOT}/clients/docs/**/*.md", recursive=True))


FOLDERS = ("core", "server", "clients", "tests", ".packages")
ELSEWHERE = {"jpeglib.h", "microhttpd.h", "curl.h", "cmocka.h", "lp_bld_arit.c", "a.b.c"}    # of libraries, and a name in an address


def ends(paths):
    """All paths, and what follows a slash in each: "a/b.c" and "b.c"."""
    return {path[at:] for path in paths for at in [0] + [slash.end() for slash in re.finditer("/", path)]}


def sources():
    """Paths of all files and folders of the repository, from its root."""
    found = {name for name in os.listdir(ROOT) if os.path.isfile(os.path.join(ROOT, name))} | set(FOLDERS)
    for top in FOLDERS:
        for folder, folders, files in os.walk(os.path.join(ROOT, top)):
            found |= {os.path.relpath(os.path.join(folder, name), ROOT) for name in folders + files}
    return found


def names_of_sources(text):
    """Words that look like sources: below a folder of the repository, or files of C, shell or awk. Capitals stand for any name."""
    words = re.findall(r"(?<![\w./<*-])[\w.*-]+(?:/[\w.*-]+)*/?(?![\w(])", text)
    return [word.rstrip("/.") for word in words if word.startswith(tuple(f"{top}/" for top in FOLDERS)) or re.search(r"[\w*]\.(?:[ch]|sh|awk)\.?$", word)]


def missing(names, found):
    """The names that are not among the ends of paths."""
    patterns = {name: re.sub(r"[A-Z][A-Z_]+", "*", name) for name in set(names) if os.path.basename(name) not in ELSEWHERE}
    return sorted(name for name, pattern in patterns.items() if name not in found and not fnmatch.filter(found, pattern))


def names_of_page(text):
    return names_of_sources("\n".join(re.findall(r"(?<!`)`([^`\n]+)`(?!`)", text)))


def names_of_comments(text):
    return names_of_sources("\n".join(re.findall(r"/\*.*?\*/", text, re.DOTALL)))


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


class Guide(unittest.TestCase):
    def test_names_of_files(self):
        """files that pages and comments name exist"""
        paths = sources()
        found = ends(paths)
        texts = [(page, names_of_page) for page in pages() + ["server/api/v1.md", "tests/reference/RULES.md"]]
        texts += [(path, names_of_comments) for path in sorted(paths) if path.endswith((".c", ".h"))]
        findings = [f"{path}: there is no {name}" for path, names in texts for name in missing(names(read(path)), found)]
        if findings:
            self.fail("\n" + "\n".join(findings))

    def test_first_lines(self):
        """the first line of a header of core has its name and its room: "clip.h - geometry: ..."; the public header is no room's"""
        for path in sorted(sources()):
            room = re.fullmatch(r"core/(\w+)/.*?([^/]+\.h)", path)
            if room and room[2] != "zraster.h":
                with self.subTest(header=path):
                    self.assertRegex(read(path).split("\n")[0], rf"/\* {re.escape(room[2])} - {room[1]}[:,] ")

    def test_finds_names_of_files(self):
        """a name of no file is found, and no other word"""
        found = ends({"core", "core/scene", "core/scene/nodes.c", "tests/run.sh"})
        right = "`nodes.c`, `scene/nodes.c`, `core/scene/NAME.c`, `n*.c`, `core/scene/`, `tests/run.sh build unit`, `part.stl`, `core.member`"
        wrong = "`leaves.c`, `core/scenes`, `core/shade/NAME.c`, `m*.c`, `tests/walk.sh`"
        self.assertEqual(missing(names_of_page(right), found), [])
        self.assertEqual(missing(names_of_page(wrong), found), ["core/scenes", "core/shade/NAME.c", "leaves.c", "m*.c", "tests/walk.sh"])
        self.assertEqual(missing(names_of_comments("int a; /* see leaves.c. */ b.c; /* nodes.c */"), found), ["leaves.c"])

    def test_pages(self):
        """pages have short sentences, short cells and plain phrases"""
        findings = [finding for page in pages() for finding in check_page(os.path.join(ROOT, page), page)]
        if findings:
            self.fail("\n" + "\n".join(findings))

    def test_help(self):
        """so has the help of both programs"""
        findings = []
        for command in (["zrasterd", "--help"], ["zraster", "help"], *(["zraster", "help", name] for name in ("render", "info", "batch", "sheet", "mcp"))):
            text = subprocess.run([f"{BUILD}/{command[0]}", *command[1:]], capture_output=True, text=True, check=True).stdout
            for line in text.split("\n"):
                for rule, text_of in RULES:
                    if rule.search(line):
                        findings.append(f"{' '.join(command)}: {text_of}: {line.strip()}")
        if findings:
            self.fail("\n" + "\n".join(findings))

    def test_finds(self):
        """each rule would find a page that breaks it"""
        long = " ".join(["word"] * 31)
        wrong = (f"A {long}.", f"- An item with {long}.", f"| cell | {' '.join(['word'] * 26)} |", "It works. What is odd is refused.", "Whoever asks, gets.",
                 "Where there is none, it stops.", "It takes 60 bytes a pixel.", "It draws one lit colour a polygon.", "A key goes before the look.",
                 "The warning is out.", "The default is told.", "It is said once.", "One is had.")
        right = (f"A {' '.join(['word'] * 29)}. Another.", "What is it? A part.", "It is out of memory.", "It has 3 of a pixel.", f"```text\n{long}\n```", f"# What {long}",
                 "It reads `" + long + "` as one word.")
        with tempfile.TemporaryDirectory() as folder:
            for text, count in [(text, 1) for text in wrong] + [(text, 0) for text in right]:
                with open(f"{folder}/page.md", "w", encoding="utf-8") as file:
                    file.write(text + "\n")
                with self.subTest(text=text):
                    self.assertEqual(len(check_page(f"{folder}/page.md", "page")), count, check_page(f"{folder}/page.md", "page"))
