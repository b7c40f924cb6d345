#!/bin/sh
# test_facts.sh BUILD: compares volumes and centres of mass of info with exact sums, trimesh and admesh, to within 1e-6.
# The solids are a torus, a box and the closed models of DATA/models/parts. Missing rivals are reported. Prints TAP.
set -u
build=$(realpath "$1")
work=$(mktemp -d)
. tests/support/verdict.sh
said=$work/said complained=$work/complained
trap 'rm -rf "$work"' EXIT
facts=$PWD/tests/clients/facts.py
data=${DATA:-../shared/data}/models/parts

# Writes binary STL files: a torus around z beside the origin, a box far from it, and each closed OBJ.
/usr/bin/python3 - "$work" "$data" <<'END'
import glob, math, os, struct, sys

def write(path, faces):
    with open(path, "wb") as out:
        out.write(b"made".ljust(80) + struct.pack("<I", len(faces)))
        for face in faces:
            out.write(struct.pack("<12fH", 0, 0, 0, *face[0], *face[1], *face[2], 0))

def fans(places, faces):
    return [(places[f[0]], places[f[i]], places[f[i + 1]]) for f in faces for i in range(1, len(f) - 1)]

def torus(n, m):
    places = [((30 + 10 * math.cos(v)) * math.cos(u) + 17, (30 + 10 * math.cos(v)) * math.sin(u) - 5, 10 * math.sin(v) + 3)
              for u in (2 * math.pi * i / n for i in range(n)) for v in (2 * math.pi * k / m for k in range(m))]
    return places, [(i * m + k, (i + 1) % n * m + k, (i + 1) % n * m + (k + 1) % m, i * m + (k + 1) % m)
                    for i in range(n) for k in range(m)]

work, data = sys.argv[1:]
write(work + "/torus.stl", fans(*torus(24, 12)))
box = [(x, y, z) for x in (1000, 1040) for y in (-500, -470) for z in (60, 72)]
write(work + "/box.stl", fans(box, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]))
for path in glob.glob(data + "/*.obj"):
    name = os.path.basename(path)[:-4]
    if name in ("openbox", "housing", "gear"):  # the first is open, the others have shells that overlap
        continue
    places, faces = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            places.append([float(w) for w in words[1:4]])
        elif words[:1] == ["f"]:
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    write(work + "/" + name + ".stl", fans(places, faces))
END
[ -d "$data" ] || skip "the parts of $data" "missing"

check "exact sums of the file's numbers" 0 /usr/bin/python3 "$facts" fractions "$build/zraster" "$work"/*.stl
rival() { # NAME COMMAND...: compares with NAME if the command succeeds
    name=$1
    shift
    if "$@" >"$said" 2>"$complained"; then
        check "$name" 0 /usr/bin/python3 "$facts" "$name" "$build/zraster" "$work"/*.stl
    else
        skip "$name" "not installed"
    fi
}
rival trimesh /usr/bin/python3 -c 'import trimesh'
rival admesh which admesh
verdicts
