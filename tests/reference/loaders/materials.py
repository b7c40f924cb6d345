"""Compares the materials of OBJ files with the materials that obj2gltf makes from them.

The materials of zraster are measured on a copy of the file that has one group per material: info has the triangles and
the mean base colour of each group. A texture counts as used if a new warning names its file once the file is missing.

Colour: Kd is sRGB-encoded here. obj2gltf copies Kd to baseColorFactor, which glTF defines as linear. The numbers are
compared as they are, although a glTF viewer draws them brighter. With a map_Kd, obj2gltf sets 1, and zraster
multiplies the map by Kd.
"""
import json
import os
import re
import shutil
import subprocess
import tempfile


def with_groups(lines):
    """Returns the lines of an OBJ file with group mN for its material N, and the names of its materials."""
    names, made = [""], ["g m0"]
    for line in lines:
        word, _, rest = line.strip().replace("\t", " ").partition(" ")
        if word == "usemtl":
            if rest.strip() not in names:
                names.append(rest.strip())
            made += [line, "g m%d" % names.index(rest.strip())]
        elif word not in ("g", "o"):
            made.append(line)
    return made, names


def run(build, path, *words):
    command = [os.path.join(build, "zraster"), *words, path, "--up", "y", "--size", "32x24"]
    return subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)


def files_beside(path):
    """Returns the MTL files and pictures in the folder of a file and below, as paths relative to the folder."""
    beside = os.path.dirname(path)
    names = [os.path.relpath(os.path.join(folder, name), beside)
             for folder, _, files in os.walk(beside) for name in files]
    return sorted(name for name in names if name.lower().endswith((".mtl", ".png", ".jpg", ".jpeg", ".webp", ".bmp")))


def ours(build, path, textures):
    """Returns {name: (triangles, color 0..255)} of the materials, and the set of the textures that are used."""
    materials, used = {}, set()
    with tempfile.TemporaryDirectory() as folder, open(path, encoding="latin-1", newline="") as file:
        made, names = with_groups(file.read().replace("\r\n", "\n").replace("\r", "\n").split("\n"))
        copy = os.path.join(folder, "copy.obj")
        with open(copy, "w", encoding="latin-1") as out:
            out.write("\n".join(made))
        for name in files_beside(path):
            os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
            shutil.copyfile(os.path.join(os.path.dirname(path), name), os.path.join(folder, name))
        for part in json.loads(run(build, copy, "info", "--json").stdout)["parts"]:
            number = re.match(r"m(\d+)(\.\d+)?$", part["name"])
            if number and part["triangles"]:
                name = names[int(number.group(1))]
                color = [int(part["color"][i:i + 2], 16) for i in (1, 3, 5)]
                materials[name] = (materials.get(name, (0,))[0] + part["triangles"], color)
        def said():
            return run(build, copy, "render", "-o", os.path.join(folder, "copy.png")).stderr

        before = said()
        for name in files_beside(copy):
            stem, end = os.path.splitext(os.path.basename(name))
            if stem not in textures or end.lower() == ".mtl":
                continue
            os.rename(os.path.join(folder, name), os.path.join(folder, "hidden"))
            if before != said() and os.path.basename(name) in said():
                used.add(stem)
            os.rename(os.path.join(folder, "hidden"), os.path.join(folder, name))
    return materials, used


def differences(build, path, theirs):
    """Yields (kind, text) for each difference of materials, triangles, colours and textures."""
    textures = {name for material in theirs.values() for name in material["textures"]}
    mine, used = ours(build, path, textures)
    for name in sorted(set(mine) ^ {"" if name == "default" and "default" not in mine else name for name in theirs}):
        yield "material", "%r is %s" % (name, "theirs only" if name not in mine else "ours only")
    for name in sorted(set(mine) & set(theirs)):
        (triangles, color), other = mine[name], theirs[name]
        if triangles != other["triangles"]:
            yield "material's triangles", "%r: %d, theirs %d" % (name, triangles, other["triangles"])
        if any(abs(a - 255 * b) > 1 for a, b in zip(color, other["color"])):
            kind = "color beside a map" if other["textures"] else "color"
            kind = "default color" if other["color"][:3] == [0.5, 0.5, 0.5] else kind
            yield kind, "%r: %s, theirs %s" % (name, color, [round(255 * x) for x in other["color"][:3]])
    for name in sorted(textures - used):
        yield "texture", "%r is theirs only" % name
