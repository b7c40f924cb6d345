"""Measures the looks, and compares them with target pictures.

    looks_table.py BUILD MODELS TARGETS

MODELS: a folder of OBJ files and its folder `parts`. TARGETS: pictures LOOK-MODEL.png, or LOOK-MODEL-below.png from
below. Prints tables, then a line `pass` or `FAIL` for each bar and look, and exits with 1 if one fails:
    targets    RMS of at most 4 of 255. Targets of looks with lines of the mesh have edges from samples, and so have the
               pictures beside them; lines_table.py compares the lines
    light      percentiles of the luminance of objects, near those that the look aims at
    clipped    at most 0.5 % of the pixels of any model
    faces      at least 12 between faces of a cube in the preset isometric, which is the only one that shows several
    turned     RMS of at most 1 between a model and the model turned by 90 degrees, seen from the same side
Missing files are reported on standard error.
"""
import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy

SIDE = 480
LINED = ("technical", "blueprint")
RMS_MOST, CLIPPED_MOST, APART_LEAST, TURNED_MOST = 4.0, 0.5, 12, 1.0
# Median, 5th and 95th percentile of the luminance of objects that looks aim at, and how far they may be off.
# What lines alone decide has no bar.
AIMS = {"studio": (160, 100, 201), "clay": (171, 107, 209), "dark": (185, 117, 228), "metal": (157, 84, 223),
        "outdoor": (188, 122, 212), "xray": (204, 160, 224), "blueprint": (112, 77, None),
        "technical": (228, None, 247)}
AIM_WITHIN = 10
# Layers of x-rays add up, and a face behind another one has its colour.
SEE_THROUGH = ("xray",)
ABOVE, BELOW = ["--azimuth", "35", "--elevation", "28"], ["--azimuth", "35", "--elevation", "-28"]
ANGLES = [(45, 35.2644), (35, 28), (-35, 28), (15, 20), (60, 20), (45, 45), (30, -28), (-45, -20)]


def read_png(path):
    """Returns red, green and blue of a picture that is not interlaced, with at most 8 bits a channel."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
        if kind == b"PLTE":
            palette = numpy.frombuffer(body, numpy.uint8).reshape(-1, 3).astype(numpy.int32)
        if kind == b"IDAT":
            packed += body
        at += size + 12
    step = {0: 1, 2: 3, 3: 1, 6: 4}[color]
    rows = unfilter(zlib.decompress(packed), height, (width * step * depth + 7) // 8, step)
    if depth < 8:
        bits = numpy.unpackbits(rows.astype(numpy.uint8), axis=1).reshape(height, -1, depth)
        rows = (bits @ (1 << numpy.arange(depth)[::-1]))[:, :width]
    pixels = rows.reshape(height, width, step)
    if color == 3:
        return palette[pixels[:, :, 0]]
    return numpy.repeat(pixels * 255 // ((1 << depth) - 1), 3, 2) if step == 1 else pixels[:, :, :3]


def unfilter(data, height, size, step):
    """Returns the bytes of rows. Filters work on the bytes `step` to the left, and on those above."""
    lines = numpy.frombuffer(data, numpy.uint8).reshape(height, size + 1)
    out = numpy.zeros((height + 1, size // step + 1, step), numpy.int32)
    for y in range(height):
        kind, line, above, row = lines[y, 0], lines[y, 1:].reshape(-1, step).astype(numpy.int32), out[y], out[y + 1]
        if kind in (0, 2):
            row[1:] = line + (above[1:] if kind else 0) & 255
        elif kind == 1:
            row[1:] = numpy.cumsum(line, 0) & 255
        else:
            for x in range(size // step):
                a, b, c = row[x], above[x + 1], above[x]
                row[x + 1] = line[x] + ((a + b) // 2 if kind == 3 else paeth(a, b, c)) & 255
    return out[1:, 1:].reshape(height, size)


def paeth(a, b, c):
    p = a + b - c
    pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
    return numpy.where((pa <= pb) & (pa <= pc), a, numpy.where(pb <= pc, b, c))


class Renderer:
    def __init__(self, build, folder):
        self.command, self.folder = os.path.join(build, "zraster"), folder

    def draw(self, model, look, size, view, channel):
        """Returns the picture, and the array of the other channel."""
        arguments = [self.command, "render", model, "--look", look, "--size", size, "-q", "-c", "color," + channel]
        subprocess.run(arguments + view + ["-o", self.folder + "/"], check=True)
        name = os.path.join(self.folder, os.path.splitext(os.path.basename(model))[0])
        return read_png(name + ".png"), numpy.load(name + "." + channel + ".npy")


    def draw_with_samples(self, model, look, width, height):
        """Returns the picture in the look's view, with edges from samples."""
        name, scene = os.path.basename(model), os.path.join(self.folder, "samples.json")
        with open(scene, "w") as file:
            json.dump({"look": look, "edges": {"from": "samples"}, "window": {"width": width, "height": height},
                       "meshes": [{"asset": name, "doubleSided": True}]}, file)
        picture = os.path.join(self.folder, "samples.png")
        subprocess.run([self.command, "render", scene, "--part", name + "=" + model, "-q", "-o", picture], check=True)
        return read_png(picture)


def luminance(picture):
    return picture @ numpy.array([0.2126, 0.7152, 0.0722])


def view_of(look, angles):
    return [] if look in LINED and angles is ABOVE else angles


class Bars:
    def __init__(self):
        self.lines = []

    def hold(self, name, what, figure, good):
        self.lines.append("%s %-9s %-12s %s" % ("pass" if good else "FAIL", what, name, figure))

    def print(self):
        """Returns true if all hold."""
        print("# bars")
        print("\n".join(self.lines))
        return not any(line.startswith("FAIL") for line in self.lines)


def rms(a, b):
    return float(numpy.sqrt(numpy.mean((a - b) ** 2)))


def compare_targets(renderer, models, targets, bars):
    print("# RMS to targets, of 255; pixels that differ by more than 2")
    worst = {}
    for name in sorted(os.listdir(targets)):
        look, model = name[:-len(".png")].split("-")[:2]
        if model not in models:
            print("left out: no model for", name, file=sys.stderr)
            continue
        if look in LINED:
            drawn = renderer.draw_with_samples(models[model], look, 480, 360)
        else:
            view = view_of(look, BELOW if name.endswith("-below.png") else ABOVE)
            drawn, _ = renderer.draw(models[model], look, "480x360", view, "faceId")
        target = read_png(os.path.join(targets, name))
        worst[look] = max(worst.get(look, 0), rms(drawn, target))
        print("%-28s %6.3f %7.3f %%" % (name, rms(drawn, target), 100 * numpy.mean(numpy.abs(drawn - target).max(2) > 2)))
    for look, off in worst.items():
        bars.hold(look, "targets", "RMS %.2f" % off, off <= RMS_MOST)


def turn(path, folder):
    """Writes an OBJ turned by 90 degrees around y, and returns its path: x, y, z becomes z, y, -x."""
    out = os.path.join(folder, "turned.obj")
    with open(path) as file, open(out, "w") as to:
        for line in file:
            word = line.split()
            if word and word[0] in ("v", "vn"):
                x = word[1][1:] if word[1].startswith("-") else "-" + word[1]
                line = " ".join([word[0], word[3], word[2], x]) + "\n"
            to.write(line)
    return out


def compare_turned(renderer, path, look, bars):
    """The model turned with the camera: no measure of a look depends on the axes."""
    straight, _ = renderer.draw(path, look, "480x360", ["--azimuth", "35", "--elevation", "28"], "faceId")
    turned, _ = renderer.draw(turn(path, renderer.folder), look, "480x360",
                              ["--azimuth", "125", "--elevation", "28"], "faceId")
    off = rms(straight, turned)
    bars.hold(look, "turned", "RMS %.2f" % off, off <= TURNED_MOST)


def measure(renderer, models, look):
    """Returns median, 5th and 95th percentile of the luminance of object pixels, means over models, and the worst share
    of clipped pixels, in percent."""
    rows = []
    for path in models:
        picture, faces = renderer.draw(path, look, "%dx%d" % (SIDE, SIDE), [], "faceId")
        pixels = picture[faces > 0]
        clipped = (pixels.max(1) == 255) | (pixels.max(1) <= 1)
        rows.append([*numpy.percentile(luminance(pixels), [50, 5, 95]), 100 * numpy.mean(clipped)])
    table = numpy.array(rows)
    return [*table[:, :3].mean(0), table[:, 3].max()]


def near(mask, reach):
    """Returns the pixels that have one of the mask at most `reach` rows and columns away."""
    for axis in (0, 1):
        mask = numpy.any([numpy.roll(mask, k, axis) for k in range(-reach, reach + 1)], 0)
    return mask


def faces_apart(renderer, cube, look, angles):
    """Returns the least difference of two visible faces of a cube along their common edge, beside its line."""
    view = ["--azimuth", "%g" % angles[0], "--elevation", "%g" % angles[1]]
    picture, faces = renderer.draw(cube, look, "%dx%d" % (SIDE, SIDE), view, "faceId")
    grey = luminance(picture)
    sides = [(faces > 0) & ((faces - 1) // 2 == n) for n in numpy.unique((faces[faces > 0] - 1) // 2)]
    close, broad = [near(side, 4) for side in sides], [near(side, 12) for side in sides]
    apart = []
    for a in range(len(sides)):
        for b in range(a):
            strips = [sides[i] & broad[k] & ~numpy.any([close[j] for j in range(len(sides)) if j != i], 0)
                      for i, k in ((a, b), (b, a))]
            if min(strip.sum() for strip in strips) > 100:
                apart.append(abs(numpy.median(grey[strips[0]]) - numpy.median(grey[strips[1]])))
    return min(apart) if apart else 255.0


def hold_light(bars, look, row):
    off = max(abs(got - aim) for got, aim in zip(row, AIMS[look]) if aim is not None)
    bars.hold(look, "light", "%.0f %.0f %.0f, off by up to %.0f" % (*row[:3], off), off <= AIM_WITHIN)
    bars.hold(look, "clipped", "%.2f %%" % row[3], row[3] <= CLIPPED_MOST)


def print_light(renderer, models, bars):
    print("# luminance of objects, mean of %d models; clipped: worst model, %%" % len(models))
    print("# look        median    5 %   95 %  clipped   least difference of faces of a cube: isometric, of 8 views")
    for look in AIMS:
        row = measure(renderer, models.values(), look)
        apart = [faces_apart(renderer, models["cube"], look, a) for a in ANGLES] if "cube" in models else []
        print("%-13s %6.0f %6.0f %6.0f %7.2f  %6.1f %6.1f" % (look, *row, *((apart[0], min(apart)) if apart else (0, 0))))
        hold_light(bars, look, row)
        if apart and look not in SEE_THROUGH:
            bars.hold(look, "faces", "%.1f" % apart[0], apart[0] >= APART_LEAST)


def main():
    build, folder, targets = sys.argv[1:4]
    models, bars = {}, Bars()
    for place in (folder, os.path.join(folder, "parts")):
        for name in sorted(os.listdir(place)) if os.path.isdir(place) else []:
            if name.endswith(".obj"):
                models[name[:-4].replace("stanford-", "")] = os.path.join(place, name)
    if not models:
        print("SKIPPED: no OBJ in %s (DATA=FOLDER of models)" % folder, file=sys.stderr)
        return 0
    with tempfile.TemporaryDirectory() as place:
        renderer = Renderer(build, place)
        if os.path.isdir(targets):
            compare_targets(renderer, models, targets, bars)
        else:
            print("SKIPPED: no targets in %s (TARGETS=FOLDER)" % targets, file=sys.stderr)
        print_light(renderer, models, bars)
        for look in AIMS if "housing" in models else []:
            compare_turned(renderer, models["housing"], look, bars)
    return 0 if bars.print() else 1


if __name__ == "__main__":
    sys.exit(main())
