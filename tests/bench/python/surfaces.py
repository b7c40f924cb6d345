"""surfaces.py [--against DIR] BUILD FOLDER MODEL...: pictures with 16 samples per pixel, which light surfaces once,
beside pictures with 64, which light each sample: the root mean square of their differences, in steps of 255. With
--against, also that of another build, and the ratio of both. FOLDER receives the pictures. `make bench-surfaces` runs it.
"""
import os
import subprocess
import sys

import numpy
import PIL.Image

LOOKS = ("studio", "technical", "clay", "metal", "dark", "outdoor", "blueprint")


def draw(build, folder, model, look, samples):
    name = os.path.join(folder, f"{samples}.png")
    command = [os.path.join(build, "zraster"), model, "--look", look, "--size", "512x512", "--samples", str(samples)]
    subprocess.run(command + ["-o", name], check=True, stdout=subprocess.DEVNULL)
    return numpy.asarray(PIL.Image.open(name).convert("RGB")).astype(float)


def difference(build, folder, model, look):
    few, many = (draw(build, folder, model, look, samples) for samples in (16, 64))
    return float(numpy.sqrt(numpy.mean((few - many) ** 2)))


def main(arguments):
    other = None
    if arguments[:1] == ["--against"]:
        other, arguments = arguments[1], arguments[2:]
    build, folder, models = arguments[0], arguments[1], arguments[2:]
    os.makedirs(folder, exist_ok=True)
    for model in models:
        name = os.path.splitext(os.path.basename(model))[0]
        for look in LOOKS:
            own = difference(build, folder, model, look)
            row = f"{name:16} {look:10} {own:6.3f}"
            if other:
                others = difference(other, folder, model, look)
                row += f" {others:6.3f} {own / others:5.2f}"
            print(row, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
