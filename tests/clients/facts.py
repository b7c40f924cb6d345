"""facts.py RIVAL ZRASTER STL...: compares volume and centre of mass of `zraster info --json` with the results of RIVAL:
fractions (exact sums of the file's floats), trimesh or admesh (volume only). Prints the largest relative difference, and
exits with status 1 if it is above 1e-6. Differences of centres are relative to the diagonal of the box."""
import json
import math
import re
import struct
import subprocess
import sys
from fractions import Fraction

BOUND = 1e-6


def triangles(path):
    data = open(path, "rb").read()
    count = struct.unpack_from("<I", data, 80)[0]
    for i in range(count):
        numbers = struct.unpack_from("<12f", data, 84 + 50 * i)
        yield numbers[3:6], numbers[6:9], numbers[9:12]


def of_fractions(path):
    volume, moment = Fraction(0), [Fraction(0)] * 3
    for corners in triangles(path):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = [[Fraction(v) for v in corner] for corner in corners]
        part = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        volume += part
        for k, sides in enumerate(((ax, bx, cx), (ay, by, cy), (az, bz, cz))):
            moment[k] += part * sum(sides)
    return float(volume / 6), [float(m / (4 * volume)) for m in moment]


def of_trimesh(path):
    import trimesh
    mesh = trimesh.load(path)
    return float(mesh.volume), [float(v) for v in mesh.center_mass]


def of_admesh(path):
    # It prints the header of the file, with whatever bytes its memory has behind it.
    said = subprocess.run(["admesh", path], capture_output=True, text=True, errors="replace", check=True).stdout
    return float(re.search(r"Volume\s*:\s*(\S+)", said).group(1)), None


def of_zraster(zraster, path):
    said = subprocess.run([zraster, "info", "--json", "--up", "y", path], capture_output=True, text=True, check=True)
    part, = json.loads(said.stdout)["parts"]
    assert part["closed"], path + " is not closed"
    box = part["box"]
    return part["volume"], part["centerOfMass"], math.dist(box["min"], box["max"])


def main():
    rival = {"fractions": of_fractions, "trimesh": of_trimesh, "admesh": of_admesh}[sys.argv[1]]
    worst = 0.0
    for path in sys.argv[3:]:
        volume, center, size = of_zraster(sys.argv[2], path)
        want_volume, want_center = rival(path)
        off = abs(volume - want_volume) / abs(want_volume)
        if want_center:
            off = max(off, math.dist(center, want_center) / size)
        print("%s: volume %.12g, theirs %.12g, off by %.2g" % (path, volume, want_volume, off))
        worst = max(worst, off)
    print("worst: %.2g" % worst)
    return not worst <= BOUND


sys.exit(main())
