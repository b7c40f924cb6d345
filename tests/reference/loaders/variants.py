"""Compares the pictures of glTF files with the pictures of their variants, which variants.mjs writes.

    variants.py BUILD FOLDER...     prints TAP; BUILD/loaders has the npm packages

Lossless variants must give the same bytes of colour and ids. Ids of quantized variants may differ within one pixel
of an outline. Draco variants must give the bytes of what Google's decoder reads from them. Differences fail unless a
row of differences.txt matches.
"""
import io
import json
import os
import subprocess
import sys
import zipfile

import numpy

import compare

IDS = ("faceId", "instanceId")
ALL = ("color",) + IDS
# Per variant: the pictures that it is compared with, the channels, and whether the bytes must be equal. "read" is the
# variant as variants.mjs reads it again: meshopt changes the first corner of triangles, and "medium" also their order,
# as edgebreaker does.
VARIANTS = {
    "plain": [("original", ALL, True)],
    "sparse": [("original", ALL, True)],
    "webp": [("original", ALL, True)],
    "meshopt-lossless": [("original", IDS, True), ("read", ALL, True)],
    "meshopt-medium": [("original", ("instanceId",), False), ("read", ALL, True)],
    "quantize": [("original", IDS, False)],
    "draco-edgebreaker": [("original", ("instanceId",), False), ("read", ALL, True)],
    "draco-slow": [("original", ("instanceId",), False), ("read", ALL, True)],
    "draco-fast": [("original", ("instanceId",), False), ("read", ALL, True)],
    "draco-exact": [("original", ("instanceId",), True), ("read", ALL, True)],
    "draco-sequential": [("original", IDS, False), ("read", ALL, True)],
    "draco-sequential-exact": [("original", IDS, True), ("read", ALL, True)],
}


def draw(build, file):
    """Returns {channel: bytes}, or the message of a file that is refused."""
    command = [os.path.join(build, "zraster"), file, "-c", ",".join(ALL), "-o", "-", "-s", "160x120"]
    done = subprocess.run(command, capture_output=True, check=False)
    if done.returncode:
        return done.stderr.decode(errors="replace").strip().replace(file, "")[:200]
    with zipfile.ZipFile(io.BytesIO(done.stdout)) as pictures:
        return {name.split(".")[0]: pictures.read(name) for name in pictures.namelist()}


def count_far(mine, theirs):
    """Counts the pixels whose id is not found within one pixel in the other picture."""
    near = numpy.zeros(mine.shape, bool)
    padded = numpy.pad(mine, 1, mode="edge")
    for y in range(3):
        for x in range(3):
            near |= padded[y:y + mine.shape[0], x:x + mine.shape[1]] == theirs
    return int((~near).sum())


def differences(drawn, variant):
    """Yields (kind, text) for each channel of a variant that differs. drawn: {name: pictures, or the refusal}."""
    for name in (variant, "read"):
        if isinstance(drawn[name], str):
            yield "refused", drawn[name]
            return
    for reference, channels, is_same in VARIANTS[variant]:
        for channel in channels:
            mine, theirs = drawn[variant][channel], drawn[reference][channel]
            kind = channel if reference == "original" else "%s as %s" % (channel, reference)
            if is_same and mine != theirs:
                yield kind, "the bytes differ"
            elif not is_same:
                mine, theirs = numpy.load(io.BytesIO(mine)), numpy.load(io.BytesIO(theirs))
                far = max(count_far(mine, theirs), count_far(theirs, mine))
                if far:
                    yield kind, "%d pixels differ beyond outlines" % far


def main(build, folders):
    files, folder = compare.files_of(folders, ("gltf", "glb")), os.path.join(build, "loaders", "variants")
    os.makedirs(folder, exist_ok=True)
    modules = os.path.join(build, "loaders", "node_modules")
    command = ["node", os.path.join(compare.HERE, "variants.mjs"), modules, folder]
    made = [json.loads(line) for line in compare.answers(command, files)]
    rows, verdict = compare.read_rows(), compare.Verdict()
    for number, file in enumerate(files):
        original = draw(build, file)
        for variant in VARIANTS:
            why = made[number][variant] or (original if isinstance(original, str) else None)
            glb = os.path.join(folder, "%d.%s.glb" % (number, variant))
            if why:
                verdict.leave_out("%s: %s" % (variant, file), why)
            else:
                is_read = any(name == "read" for name, _, _ in VARIANTS[variant])
                read = draw(build, glb.replace(".glb", ".read.glb")) if is_read else None
                drawn = {"original": original, variant: draw(build, glb), "read": read}
                verdict.judge(rows, variant, file, differences(drawn, variant))
    return verdict.close()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
