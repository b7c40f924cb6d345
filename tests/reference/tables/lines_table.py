"""Measures drawings of lines of the mesh, by four bars.

    lines_table.py BUILD MODELS TARGETS

MODELS: a folder of OBJ files and its folder `parts`. TARGETS: pictures lines-MODEL.png over the shading of technical,
or lines-MODEL-hidden.png on white with hidden lines. Exits with 1 if a bar does not hold:

    specks   connected ink of fewer than 12 pixels, by model
    targets  RMS of at most 5 of 255
    SVG      xmllint finds no fault; 99.5 % of the dark pixels that rsvg-convert draws are within a pixel of ink of ours,
             and the other way around. Dark is below 128, ink below 192: one line may be dark on one side and, with its
             opacity of 0.85 or half of it on either pixel, not on the other

What is missing is said on standard error.
"""
import json
import os
import subprocess
import sys
import tempfile

import numpy

from looks_table import read_png

SIZE = (640, 480)
SPECK_PIXELS, RMS_MOST, NEAR_LEAST, DARK, INK = 12, 5.0, 99.5, 128, 192
SPECKS_MOST = {"gear": 0, "housing": 0, "plate": 0, "beetle": 1, "stanford-bunny": 1, "suzanne": 1}
WHITE = {"look": "technical", "shading": "unlit", "occlusion": False, "samples": 1, "background": "#ffffff",
         "materials": [{"name": "white", "baseColorFactor": [1, 1, 1, 1], "doubleSided": True}]}
BESIDE = {"color": "#000000", "from": "mesh"}


class Renderer:
    def __init__(self, build, folder):
        self.command, self.folder = os.path.join(build, "zraster"), folder

    def draw(self, model, keys, ending):
        """Returns the name of the file that a scene of the model becomes."""
        mesh = {"asset": "m"}
        if "materials" in keys:
            mesh["material"] = "white"
        scene = {"window": {"width": SIZE[0], "height": SIZE[1]}, **keys, "meshes": [mesh]}
        path, out = os.path.join(self.folder, "scene.json"), os.path.join(self.folder, "out." + ending)
        with open(path, "w") as file:
            json.dump(scene, file)
        subprocess.run([self.command, path, "--part", "m=" + model, "-o", out, "-q"], check=True)
        return out

    def ink(self, model, **edges):
        """Returns the grey of a drawing on white."""
        return read_png(self.draw(model, {**WHITE, "edges": {**BESIDE, **edges}}, "png"))[:, :, 0]


def spread(mask):
    """Returns the mask with all pixels beside its own."""
    padded = numpy.pad(mask, 1)
    out = numpy.zeros_like(mask)
    for y in range(3):
        for x in range(3):
            out |= padded[y:y + mask.shape[0], x:x + mask.shape[1]]
    return out


def count_specks(mask):
    """Counts the connected areas, by sides and corners, that have few pixels."""
    left, count = mask.copy(), 0
    while left.any():
        y, x = numpy.unravel_index(numpy.argmax(left), left.shape)
        stack, size = [(y, x)], 0
        left[y, x] = False
        while stack:
            y, x = stack.pop()
            size += 1
            low_y, low_x = max(y - 1, 0), max(x - 1, 0)
            for dy, dx in numpy.argwhere(left[low_y:y + 2, low_x:x + 2]):
                left[low_y + dy, low_x + dx] = False
                stack.append((low_y + dy, low_x + dx))
        count += size < SPECK_PIXELS
    return count


def measure_specks(renderer, models):
    good = True
    print("# connected ink below %d pixels" % SPECK_PIXELS)
    for name, path in models.items():
        count, most = count_specks(renderer.ink(path) < 255), SPECKS_MOST.get(name)
        is_bad = most is not None and count > most
        good &= not is_bad
        print("%-16s %3d%s%s" % (name, count, "" if most is None else "  at most %d" % most, "  BAD" if is_bad else ""))
    return good


def measure_targets(renderer, models, targets):
    good = True
    print("# RMS to targets, of 255")
    for name in sorted(os.listdir(targets)):
        if not name.startswith("lines-") or not name.endswith(".png"):
            continue
        model, is_hidden = name[len("lines-"):-len(".png")].replace("-hidden", ""), "-hidden" in name
        if model not in models:
            print("left out: no model for", name, file=sys.stderr)
            continue
        edges = {"from": "mesh", "hiddenLines": is_hidden}
        keys = {**WHITE, "edges": edges} if is_hidden else {"look": "technical", "edges": edges}
        off = read_png(renderer.draw(models[model], keys, "png")) - read_png(os.path.join(targets, name))
        rms = float(numpy.sqrt(numpy.mean(off * off)))
        good &= rms <= RMS_MOST
        print("%-28s %6.3f%s" % (name, rms, "" if rms <= RMS_MOST else "  BAD"))
    return good


def measure_svg(renderer, models):
    good = True
    print("# SVG: bytes; dark pixels of its picture near ours, and ours near its, %")
    for name, path in models.items():
        for is_hidden in (False, True):
            edges = {**BESIDE, "hiddenLines": is_hidden}
            svg = renderer.draw(path, {**WHITE, "edges": edges, "outputs": [{"channel": "color", "encoding": "svg"}]}, "svg")
            subprocess.run(["xmllint", "--noout", svg], check=True)
            drawn = svg + ".png"
            subprocess.run(["rsvg-convert", "-w", str(SIZE[0]), "-h", str(SIZE[1]), "-b", "white", svg, "-o", drawn], check=True)
            theirs, ours = read_png(drawn)[:, :, 0], renderer.ink(path, hiddenLines=is_hidden)
            shares = [100 * numpy.mean(spread(b < INK)[a < DARK]) for a, b in ((theirs, ours), (ours, theirs))]
            is_bad = min(shares) < NEAR_LEAST
            good &= not is_bad
            print("%-16s %-8s %7d %7.2f %7.2f%s" % (name, "hidden" if is_hidden else "", os.path.getsize(svg), *shares,
                                                    "  BAD" if is_bad else ""))
    return good


def main():
    build, folder, targets = sys.argv[1:4]
    models = {}
    for place in (folder, os.path.join(folder, "parts")):
        for name in sorted(os.listdir(place)) if os.path.isdir(place) else []:
            if name.endswith(".obj"):
                models[name[:-4]] = os.path.join(place, name)
    if not models:
        print("SKIPPED: no OBJ in %s (DATA=FOLDER of models)" % folder, file=sys.stderr)
        return 0
    with tempfile.TemporaryDirectory() as place:
        renderer = Renderer(build, place)
        good = measure_specks(renderer, models)
        if os.path.isdir(targets):
            good &= measure_targets(renderer, models, targets)
        else:
            print("SKIPPED: no targets in %s (TARGETS=FOLDER)" % targets, file=sys.stderr)
        good &= measure_svg(renderer, models)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
