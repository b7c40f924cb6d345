"""Measures the second versions of looks beside the first, and beside target pictures.

    looks_table.py BUILD MODELS TARGETS

MODELS: a folder of OBJ files and its folder `parts`. TARGETS: pictures LOOK-MODEL.png, or LOOK-MODEL-below.png from
below. Prints tables, and exits with 1 if a bar does not hold: RMS of 4 of 255 to the targets, 0.5 % of clipped pixels.
What is missing is said on standard error.
"""
import os
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy

LOOKS = "studio clay dark metal outdoor xray blueprint technical".split()
SIDE = 480
RMS_MOST, CLIPPED_MOST, APART_LEAST = 4.0, 0.5, 12
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


def luminance(picture):
    return picture @ numpy.array([0.2126, 0.7152, 0.0722])


def view_of(look, angles):
    return [] if look in ("technical", "blueprint") and angles is ABOVE else angles


def compare_targets(renderer, models, targets):
    """Returns true if all are near."""
    good = True
    print("# RMS to targets, of 255; pixels that differ by more than 2")
    for name in sorted(os.listdir(targets)):
        look, model = name[:-len(".png")].split("-")[:2]
        if model not in models:
            print("left out: no model for", name, file=sys.stderr)
            continue
        view = view_of(look, BELOW if name.endswith("-below.png") else ABOVE)
        drawn, _ = renderer.draw(models[model], look + "@2", "480x360", view, "faceId")
        off = numpy.abs(drawn - read_png(os.path.join(targets, name)))
        rms = float(numpy.sqrt(numpy.mean(off * off)))
        good &= rms <= RMS_MOST
        print("%-28s %6.3f %7.3f %%%s" % (name, rms, 100 * numpy.mean(off.max(2) > 2), "" if rms <= RMS_MOST else "  BAD"))
    return good


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


def faces_apart(renderer, cube, look, angles):
    """Returns the least difference of the medians of two visible faces."""
    view = ["--azimuth", "%g" % angles[0], "--elevation", "%g" % angles[1]]
    picture, normals = renderer.draw(cube, look, "%dx%d" % (SIDE, SIDE), view, "faceId")
    grey, medians = luminance(picture), []
    for group in numpy.unique((normals[normals > 0] - 1) // 2):
        of_it = (normals > 0) & ((normals - 1) // 2 == group)
        if of_it.sum() > 200:
            medians.append(numpy.median(grey[of_it]))
    medians.sort()
    return min(numpy.diff(medians)) if len(medians) > 1 else 0.0


def main():
    build, folder, targets = sys.argv[1:4]
    models = {}
    for place in (folder, os.path.join(folder, "parts")):
        for name in sorted(os.listdir(place)) if os.path.isdir(place) else []:
            if name.endswith(".obj"):
                models[name[:-4].replace("stanford-", "")] = os.path.join(place, name)
    if not models:
        print("SKIPPED: no OBJ in %s (DATA=FOLDER of models)" % folder, file=sys.stderr)
        return 0
    good = True
    with tempfile.TemporaryDirectory() as place:
        renderer = Renderer(build, place)
        if os.path.isdir(targets):
            good = compare_targets(renderer, models, targets)
        else:
            print("SKIPPED: no targets in %s (TARGETS=FOLDER)" % targets, file=sys.stderr)
        print("# luminance of objects, mean of %d models; clipped: worst model, %%" % len(models))
        print("# look        median    5 %   95 %  clipped   least difference of faces of a cube: isometric, of 8 views")
        for look in LOOKS:
            for version in (1, 2):
                name = "%s@%d" % (look, version)
                row = measure(renderer, models.values(), name)
                apart = [faces_apart(renderer, models["cube"], name, a) for a in ANGLES] if "cube" in models else [0]
                is_bad = version == 2 and row[3] > CLIPPED_MOST
                good &= not is_bad
                low = version == 2 and min(apart) < APART_LEAST
                print("%-13s %6.0f %6.0f %6.0f %7.2f  %6.1f %6.1f%s%s" % (
                    name, *row, apart[0], min(apart), "  BAD" if is_bad else "", "  (below %d)" % APART_LEAST if low else ""))
    return 0 if good else 1


sys.exit(main())
