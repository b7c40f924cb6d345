"""The wheel: its tag, its libraries, and a picture in a venv without numpy."""
import glob
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

import support
import zraster

DRAW = """
import sys, zraster
assert "site-packages" in zraster.__file__, zraster.__file__
with open("/proc/self/maps") as file:
    loaded = {line.split()[-1] for line in file if ".so" in line}
assert not [path for path in loaded if "png" in path and "site-packages" not in path], loaded
sys.stdout.buffer.write(zraster.render(sys.argv[1]).content)
"""


def output(*command, **options):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, **options).stdout


@unittest.skipUnless(shutil.which("patchelf"), "there is no patchelf")
class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.build = os.path.join(cls.folder.name, "build")
        os.mkdir(cls.build)
        os.symlink(os.path.join(support.build, "libzraster.so.0"), os.path.join(cls.build, "libzraster.so.0"))
        script = os.path.join(support.root, "clients/python/wheel.py")
        cls.path = output(sys.executable, script, cls.build, zraster.__version__, text=True).strip()
        cls.unpacked = os.path.join(cls.folder.name, "unpacked")
        with zipfile.ZipFile(cls.path) as archive:
            archive.extractall(cls.unpacked)
        cls.libraries = glob.glob(os.path.join(cls.unpacked, "zraster/*.so*"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_tag(self):
        """no library needs a GLIBC symbol above the wheel's tag"""
        name = os.path.basename(self.path)
        self.assertRegex(name, rf"^zraster-{zraster.__version__}-py3-none-manylinux_2_\d+_{os.uname().machine}\.whl$")
        floor = int(re.search(r"manylinux_2_(\d+)", name).group(1))
        if int(platform.libc_ver()[1].split(".")[1]) <= 36:  # of Debian 12, where wheels for others are built
            self.assertLessEqual(floor, 34)
        needed = [int(minor) for path in self.libraries
                  for minor in re.findall(r"GLIBC_2\.(\d+)", output("readelf", "-VW", path, text=True))]  # fmt: skip
        self.assertEqual(max(needed), floor)

    def test_libraries(self):
        """all that is needed beyond the C library is in the wheel, under names of its own, with its licence"""
        names = {os.path.basename(path) for path in self.libraries}
        for path in self.libraries:
            dynamic = output("readelf", "-dW", path, text=True)
            for needed in re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic):
                is_system = re.match(r"lib(c|m|pthread)\.so|ld-linux", needed)
                self.assertTrue(is_system or (needed in names and needed.startswith("zr-")), f"{path}: {needed}")
            self.assertIn("[$ORIGIN]", dynamic)
        texts = glob.glob(os.path.join(self.unpacked, "zraster-*.dist-info/licenses/*"))
        self.assertGreaterEqual(len(texts), 1 if not shutil.which("dpkg") else len(names))

    def test_files(self):
        """the wheel has every module, py.typed, and few megabytes"""
        sources = glob.glob(os.path.join(support.root, "clients/python/zraster/**/*.py"), recursive=True)
        for path in sources + [os.path.join(support.root, "clients/python/zraster/py.typed")]:
            inside = os.path.join(self.unpacked, os.path.relpath(path, os.path.join(support.root, "clients/python")))
            self.assertEqual(support.read(inside), support.read(path))
        self.assertLess(os.path.getsize(self.path), 4 << 20)

    def test_install(self):
        """pip installs it without an index, and it draws without numpy"""
        venv = os.path.join(self.folder.name, "venv")
        made = subprocess.run([sys.executable, "-m", "venv", venv], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if made.returncode != 0:
            self.skipTest("python3 -m venv does not work here (python3-venv): " + made.stdout.decode()[:200])
        python = os.path.join(venv, "bin/python")
        clean = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "ZRASTER_LIBRARY")}
        pip = [python, "-m", "pip", "install", "-q", "--no-index", "--disable-pip-version-check", self.path]
        output(*pip, env=clean, cwd=self.folder.name)
        absent = subprocess.run([python, "-c", "import numpy"], env=clean, stderr=subprocess.DEVNULL)
        self.assertNotEqual(absent.returncode, 0)
        scene = os.path.join(support.scenes, "look-studio.json")
        drawn = output(python, "-c", DRAW, scene, env=clean, cwd=self.folder.name)
        self.assertEqual(drawn, zraster.render(scene).content)
