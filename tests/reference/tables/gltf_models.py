"""Draws the models of the glTF Asset Generator beside their thumbnails.

    gltf_models.py BUILD FOLDER     writes BUILD/gltf/index.html and prints TAP

gltf_models.txt lists the models that are refused or drawn with a warning. A model without a buffer must
be refused with the name of that file, one without an image is drawn with a warning.
"""
import fnmatch
import html
import json
import os
import subprocess
import sys
import urllib.parse

HERE = os.path.dirname(os.path.abspath(__file__))
SIDE = 160


def read_rows():
    rows = []
    with open(os.path.join(HERE, "gltf_models.txt"), encoding="utf-8") as lines:
        for line in lines:
            if line.strip() and not line.startswith("#"):
                rows.append([word.strip() for word in line.split("|", 2)])
    return rows


def parts_of(path):
    """Returns the files that a model refers to: triples of a kind, a name and a path."""
    with open(path, encoding="utf-8") as file:
        root = json.load(file)
    uris = {(key, item["uri"]) for key in ("buffers", "images") for item in root.get(key, []) if "uri" in item}
    names = sorted((key, urllib.parse.unquote(uri)) for key, uri in uris if not uri.startswith("data:"))
    return [(key, name, os.path.join(os.path.dirname(path), name)) for key, name in names]


def draw(build, path, picture):
    """Returns True if the model is drawn, its messages, and kinds and names of missing files."""
    command = [os.path.join(build, "zraster"), "render", path, "-o", picture, "-s", str(SIDE), "--preset", "front"]
    missing = []
    for kind, name, file in parts_of(path):
        if os.path.exists(file):
            command += ["--part", name + "=" + file]
        else:
            missing.append((kind, name))
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode == 0, done.stderr.strip(), missing


def is_as_said(rows, name, drawn, said, missing):
    buffers = [name for kind, name in missing if kind == "buffers"]
    if buffers:
        return not drawn and any("no part of the request has the name" in said and name in said for name in buffers)
    if missing:
        return drawn and "no part of the request has this name: the image is not drawn" in said
    for pattern, fate, text in rows:
        if fnmatch.fnmatch(name, pattern):
            return drawn == (fate == "drawn") and text in said
    return drawn and said == ""


def figure(name, thumbnail, drawn, said):
    pictures = "".join('<img width="%d" src="%s">' % (SIDE, html.escape(path)) for path in
                       ([thumbnail] if os.path.exists(thumbnail) else []) + ([name + ".png"] if drawn else []))
    return "<figure>%s<figcaption>%s<br><small>%s</small></figcaption></figure>\n" % (
        pictures, html.escape(name), html.escape(said.split(": ", 2)[-1] if said else ""))


def main(build, folder):
    rows, failed, count = read_rows(), 0, 0
    pages = os.path.join(build, "gltf")
    os.makedirs(pages, exist_ok=True)
    with open(os.path.join(folder, "Manifest.json"), encoding="utf-8") as file:
        groups = json.load(file)
    with open(os.path.join(pages, "index.html"), "w", encoding="utf-8") as page:
        page.write("<!doctype html><meta charset=utf-8><title>glTF</title><style>figure{display:inline-block;"
                   "width:340px;vertical-align:top;margin:4px}</style><p>Left: the thumbnail of the model's authors, "
                   "with another light and camera. Right: the look studio, from the front.</p>\n")
        for group in groups:
            for model in group["models"]:
                path = os.path.join(folder, group["folder"], model["fileName"])
                name = os.path.splitext(model["fileName"])[0]
                drawn, said, missing = draw(build, path, os.path.join(pages, name + ".png"))
                thumbnail = os.path.abspath(os.path.join(folder, group["folder"], "Figures/Thumbnails", name + ".png"))
                good = is_as_said(rows, name, drawn, said, missing)
                count, failed = count + 1, failed + (not good)
                page.write(figure(name, thumbnail, drawn, said))
                print("%s %d - %s is %s" % ("ok" if good else "not ok", count, name, "drawn" if drawn else "refused"))
                if not good:
                    print("# said:", said)
    print("1..%d" % count)
    return 1 if failed or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
