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

HERE = os.path.dirname(os.path.abspath(__file__))
TYPES = ("obj", "stl", "ply", "3mf", "gltf", "glb")


def type_of(path):
    return path.rsplit(".", 1)[-1].lower()


def loaders_of(build):
    """Returns name: (types, command), and names what is left out."""
    modules = os.path.join(build, "loaders", "node_modules")
    loaders = {"three": (TYPES, ["node", os.path.join(HERE, "three.mjs"), modules]),
               "validator": (("gltf", "glb"), ["node", os.path.join(HERE, "validate.mjs"), modules])}
    for name, types in (("meshio", ("ply",)), ("trimesh", ("obj", "stl", "ply", "glb"))):
        if importlib.util.find_spec(name):
            loaders[name] = (types, [sys.executable, os.path.join(HERE, "read.py"), name])
        else:
            print("# LEFT OUT: %s: this Python lacks it (python3-%s)" % (name, name))
    return loaders


def ours(build, path):
    command = [os.path.join(build, "zraster"), "info", path, "--json", "--up", "y", "--size", "32x24"]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode:
        return {"error": done.stderr.strip().replace(path, "")[:200]}
    info = json.loads(done.stdout)
    counts, origin = info["counts"], info.get("origin", [0, 0, 0])
    box = {key: [a + b for a, b in zip(info["bounds"][key], origin)] for key in ("min", "max")}
    return dict(box, triangles=counts["triangles"], dropped=counts["degeneratePolygons"])


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


def read_rows():
    with open(os.path.join(HERE, "differences.txt"), encoding="utf-8") as lines:
        return [[word.strip() for word in line.split("|", 3)] for line in lines if "|" in line and line[0] != "#"]


def reason(rows, loader, path, kind):
    for row in rows:
        if all(fnmatch.fnmatch(value, pattern) for value, pattern in zip((loader, path, kind), row)):
            return row[3]
    return None


def main(build, folders):
    files = sorted(os.path.join(folder, name) for top in folders for folder, _, names in os.walk(top)
                   for name in names if type_of(name) in TYPES)
    rows, number, failed, tally = read_rows(), 0, 0, collections.Counter()
    mine = {path: ours(build, path) for path in files}
    for loader, (types, command) in loaders_of(build).items():
        chosen = [path for path in files if type_of(path) in types]
        done = subprocess.run(command, input="".join(path + "\n" for path in chosen), stdout=subprocess.PIPE,
                              text=True, check=True)
        for path, line in zip(chosen, done.stdout.splitlines(), strict=True):
            theirs, unexplained = json.loads(line), []
            for kind, text in differences(mine[path], theirs):
                why = reason(rows, loader, path, kind)
                print("# %s: %s: %s: %s" % (path, kind, text, "because " + why if why else "UNEXPLAINED"))
                tally[loader, type_of(path), "explained" if why else "unexplained"] += 1
                unexplained += [] if why else [kind]
            tally[loader, type_of(path), "colours"] += theirs.get("colors", 0)
            tally[loader, type_of(path), "files"] += 1
            number, failed = number + 1, failed + bool(unexplained)
            print("%sok %d - %s: %s" % ("not " if unexplained else "", number, loader, path))
    for loader, kind in sorted({key[:2] for key in tally}):
        print("# %s, %s: %s" % (loader, kind, ", ".join("%d %s" % (tally[loader, kind, what], what) for what in (
            "files", "explained", "unexplained"))))
    print("1..%d" % number)
    return 1 if failed or number == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
