"""wheel.py BUILD VERSION: makes BUILD/wheel/zraster-VERSION-py3-none-manylinux_2_NN_ARCH.whl of the package,
libzraster.so.0 and the libraries that it needs beyond the C library. NN is that of the highest GLIBC symbol in all of them.
Needs patchelf and strip. The libraries get names of their own: the loader then never confuses them with those of other
wheels."""
import base64
import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
import zipfile

SONAME = "libzraster.so.0"
C_LIBRARY = re.compile(r"(ld-linux|lib(c|m|dl|rt|pthread)\.so)")
METADATA = """Metadata-Version: 2.1
Name: zraster
Version: {version}
Summary: Renders 3D scenes and meshes to pictures, depth, normals and ids, without a GPU or a display
License: MIT
Requires-Python: >=3.8
Provides-Extra: arrays
Requires-Dist: numpy; extra == "arrays"
Description-Content-Type: text/markdown

{readme}"""
WHEEL = "Wheel-Version: 1.0\nGenerator: clients/python/wheel.py\nRoot-Is-Purelib: false\nTag: {tag}\n"


def run(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def needed(library):
    """Returns the libraries to bundle: names and paths."""
    found = re.findall(r"(\S+) => (/\S+)", run("ldd", library))
    return {name: path for name, path in found if not C_LIBRARY.match(name)}


def bundle(build, folder):
    """Copies the libraries, renames them and strips them. Returns their paths and those of the originals."""
    originals = needed(os.path.join(build, SONAME))
    copies = {SONAME: os.path.join(folder, SONAME)}
    shutil.copy(os.path.join(build, SONAME), folder)
    for name, path in originals.items():
        copies[name] = os.path.join(folder, "zr-" + name)
        shutil.copy(os.path.realpath(path), copies[name])
    for name, copy in copies.items():
        os.chmod(copy, 0o755)
        run("strip", "--strip-unneeded", copy)
        # One change per run: of several, patchelf 0.14 drops some.
        run("patchelf", "--set-rpath", "$ORIGIN", copy)
        run("patchelf", *[word for other in originals for word in ("--replace-needed", other, "zr-" + other)], copy)
        if name != SONAME:
            run("patchelf", "--set-soname", "zr-" + name, copy)
    return list(copies.values()), list(originals.values())


def glibc(libraries):
    """Returns the minor version of the highest GLIBC symbol that the libraries need."""
    return max(int(found) for path in libraries for found in re.findall(r"GLIBC_2\.(\d+)", run("readelf", "-VW", path)))


def licences(originals):
    """Returns the copyright files of the packages that the libraries come from, as Debian has them; empty elsewhere."""
    found = {}
    for path in originals if shutil.which("dpkg") else ():
        for name in (path, os.path.realpath(path), re.sub("^/lib/", "/usr/lib/", os.path.realpath(path))):
            owner = subprocess.run(
                ["dpkg", "-S", name], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
            ).stdout
            file = f"/usr/share/doc/{owner.split(':')[0]}/copyright"
            if owner and os.path.exists(file):
                found[owner.split(":")[0]] = file
    return found


def write(path, files):
    """Writes a wheel of (name, bytes), with its list of hashes. Its bytes depend on these alone."""
    info = next(name.split("/")[0] for name, _ in files if ".dist-info/" in name)
    record = "".join(
        f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip('=')},{len(data)}\n"
        for name, data in files
    )
    record += f"{info}/RECORD,,\n"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in [*files, (f"{info}/RECORD", record.encode())]:
            entry = zipfile.ZipInfo(name)
            entry.external_attr, entry.compress_type = 0o644 << 16, zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)


def read(path):
    with open(path, "rb") as file:
        return file.read()


def main(build, version):
    here = os.path.dirname(os.path.abspath(__file__))
    out = os.path.join(build, "wheel")
    folder = os.path.join(out, "libraries")
    shutil.rmtree(out, ignore_errors=True)
    os.makedirs(folder)
    libraries, originals = bundle(build, folder)
    tag = f"py3-none-manylinux_2_{glibc(libraries)}_{platform.machine()}"
    info = f"zraster-{version}.dist-info"
    sources = sorted(os.path.join(at, name) for at, _, names in os.walk(os.path.join(here, "zraster")) for name in names
                     if name.endswith((".py", ".typed")))  # fmt: skip
    files = [(os.path.relpath(path, here), read(path)) for path in sources]
    files += [(f"zraster/{os.path.basename(path)}", read(path)) for path in libraries]
    texts = {"zraster": os.path.join(here, "../../LICENSE"), **licences(originals)}
    files += [(f"{info}/licenses/{name}.txt", read(path)) for name, path in texts.items()]
    readme = read(os.path.join(here, "README.md")).decode()
    files += [(f"{info}/METADATA", METADATA.format(version=version, readme=readme).encode()),
              (f"{info}/WHEEL", WHEEL.format(tag=tag).encode())]  # fmt: skip
    path = os.path.join(out, f"zraster-{version}-{tag}.whl")
    write(path, files)
    print(path)


if __name__ == "__main__":
    main(*sys.argv[1:])
