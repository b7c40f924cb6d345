"""Compares the triangles and bounds of model files with the results of other loaders.

    compare.py BUILD FOLDER...     prints TAP; BUILD/loaders has the npm packages

A difference fails unless a row of differences.txt matches it. All files are read with y up, since other loaders do
not rotate them.
"""
import collections
import fnmatch
import importlib.util
import json
import os
import subprocess
import sys

import materials
import mf3

HERE = os.path.dirname(os.path.abspath(__file__))
TYPES = ("obj", "stl", "ply", "3mf", "gltf", "glb")


def type_of(path):
    return path.rsplit(".", 1)[-1].lower()


def loaders_of(build, verdict):
    """Returns {name: (types, command)}, and reports missing loaders. lib3mf writes cases to BUILD/loaders/3mf."""
    modules = os.path.join(build, "loaders", "node_modules")
    loaders = {"three": (TYPES, ["node", os.path.join(HERE, "three.mjs"), modules]),
               "validator": (("gltf", "glb"), ["node", os.path.join(HERE, "validate.mjs"), modules]),
               "obj2gltf": (("obj",), ["node", os.path.join(HERE, "obj2gltf.mjs"), modules])}
    for name, types in (("meshio", ("ply",)), ("trimesh", ("obj", "stl", "ply", "glb"))):
        if importlib.util.find_spec(name):
            loaders[name] = (types, [sys.executable, os.path.join(HERE, "read.py"), name])
        else:
            verdict.leave_out(name, "this Python lacks it (python3-%s)" % name)
    try:
        mf3.main(os.path.join(build, "loaders", "3mf"))
        loaders["lib3mf"] = (("3mf",), [sys.executable, os.path.join(HERE, "read.py"), "lib3mf"])
    except OSError as error:
        verdict.leave_out("lib3mf", error)
    return loaders


def ours(build, path):
    command = [os.path.join(build, "zraster"), "info", path, "--json", "--up", "y", "--size", "32x24"]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode:
        return {"error": done.stderr.strip().replace(path, "")[:200]}
    info = json.loads(done.stdout)
    counts, origin = info["counts"], info.get("origin", [0, 0, 0])
    box = {key: [a + b for a, b in zip(info["bounds"][key], origin)] for key in ("min", "max")}
    parts = None if "partsOmitted" in info else [(part["triangles"], part["color"]) for part in info["parts"]]
    return dict(box, triangles=counts["triangles"], dropped=counts["degeneratePolygons"], parts=parts)


def is_near(mine, theirs):
    """Returns whether two boxes are equal but for rounding to float."""
    extent = max(b - a for a, b in zip(mine["min"], mine["max"]))
    far = max(abs(x) for x in mine["min"] + mine["max"])
    return all(abs(a - b) <= 1e-5 * extent + 4e-7 * far
               for a, b in zip(mine["min"] + mine["max"], theirs["min"] + theirs["max"]))


def differences(mine, theirs):
    """Yields (kind, text). Validator: errors of files that are drawn, and files without errors that are refused."""
    if "codes" in theirs:
        for code, pointer in theirs["codes"].items() if "error" not in mine else ():
            yield "drawn, " + code, pointer
        if "error" in mine and not theirs["codes"]:
            yield "ours refuses", mine["error"]
        return
    if "error" in mine or "error" in theirs:
        if "error" not in mine:
            yield "theirs refuse", theirs["error"]
        elif "error" not in theirs:
            yield "ours refuses", mine["error"]
        return
    if not 0 <= theirs["triangles"] - mine["triangles"] <= mine["dropped"]:
        yield "triangles", "%d, theirs %d" % (mine["triangles"], theirs["triangles"])
    if any(x != x or x is None for x in theirs["min"] + theirs["max"]) or not is_near(mine, theirs):
        yield "bounds", "%s %s, theirs %s %s" % (mine["min"], mine["max"], theirs["min"], theirs["max"])


def differences_of_parts(mine, theirs):
    """Yields (kind, text) for lists of (triangles, colour). A part without a colour in theirs matches any colour."""
    if [part[0] for part in mine] != [part[0] for part in theirs]:
        yield "parts", "%s, theirs %s" % ([part[0] for part in mine][:9], [part[0] for part in theirs][:9])
        return
    for number, ((_, color), (_, other)) in enumerate(zip(mine, theirs), 1):
        if other and any(abs(int(color[1 + 2 * k:3 + 2 * k], 16) - other[k]) > 1 for k in range(3)):
            yield "color", "part %d: %s, theirs #%02x%02x%02x" % (number, color, *map(round, other))


def read_rows():
    with open(os.path.join(HERE, "differences.txt"), encoding="utf-8") as lines:
        return [[word.strip() for word in line.split("|", 3)] for line in lines if "|" in line and line[0] != "#"]


def reason(rows, loader, path, kind):
    for row in rows:
        if all(fnmatch.fnmatch(value, pattern) for value, pattern in zip((loader, path, kind), row)):
            return row[3]
    return None


class Verdict:
    """Prints one line of TAP per comparison. `close` prints a table and the totals."""

    def __init__(self):
        self.tally = collections.Counter()
        self.counts = {"passed": 0, "failed": 0, "left out": 0}

    def judge(self, rows, loader, path, found):
        """Fails if no row explains one of the differences found: (kind, text)."""
        unexplained = 0
        for kind, text in found:
            why = reason(rows, loader, path, kind)
            text = str(text).replace("\n", " ")
            print("# %s: %s: %s: %s" % (path, kind, text, "because " + why if why else "UNEXPLAINED"))
            self.tally[loader, type_of(path), "explained" if why else "unexplained"] += 1
            unexplained += not why
        self.tally[loader, type_of(path), "files"] += 1
        self.counts["failed" if unexplained else "passed"] += 1
        number = self.counts["passed"] + self.counts["failed"]
        print("%sok %d - %s: %s" % ("not " if unexplained else "", number, loader, path))

    def leave_out(self, name, why):
        print("# LEFT OUT: %s: %s" % (name, why))
        self.counts["left out"] += 1

    def close(self):
        """Prints the table and the totals. Returns the exit status."""
        for loader, kind in sorted({key[:2] for key in self.tally}):
            print("# %s, %s: %s" % (loader, kind, ", ".join("%d %s" % (self.tally[loader, kind, what], what)
                                                            for what in ("files", "explained", "unexplained"))))
        print("1..%d" % (self.counts["passed"] + self.counts["failed"]))
        print(", ".join("%d %s" % (count, name) for name, count in self.counts.items()))
        return 1 if self.counts["failed"] or not self.counts["passed"] else 0


def answers(command, files):
    """Returns the lines that a program prints for the names on its standard input, one per file."""
    done = subprocess.run(command, input="".join(path + "\n" for path in files), stdout=subprocess.PIPE, check=True,
                          encoding="utf-8", errors="surrogateescape")
    lines = done.stdout.splitlines()
    assert len(lines) == len(files), command
    return lines


def files_of(folders, types):
    return sorted(os.path.join(folder, name) for top in folders for folder, _, names in os.walk(top) for name in names
                  if type_of(name) in types)


def main(build, folders):
    sys.stdout.reconfigure(encoding="utf-8", errors="backslashreplace")
    rows, verdict = read_rows(), Verdict()
    loaders = loaders_of(build, verdict)
    files = files_of(folders, TYPES)
    mine = {path: ours(build, path) for path in files}
    for loader, (types, command) in loaders.items():
        chosen = [path for path in files if type_of(path) in types]
        for path, line in zip(chosen, answers(command, chosen)):
            theirs = json.loads(line)
            found = list(differences(mine[path], theirs))
            if "materials" in theirs and "error" not in mine[path]:
                found += materials.differences(build, path, theirs["materials"])
            if theirs.get("parts") and mine[path].get("parts"):
                found += differences_of_parts(mine[path]["parts"], theirs["parts"])
            verdict.judge(rows, loader, path, found)
    return verdict.close()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
