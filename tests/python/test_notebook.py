"""Runs the cells of clients/python/examples.ipynb, and the README's first example, without Jupyter."""
import contextlib
import io
import json
import os
import re
import tempfile
import unittest
import warnings

import support
from support import needs_numpy, numpy


@needs_numpy
class Notebook(unittest.TestCase):
    def test_cells(self):
        """every cell of the notebook runs without a warning, and its pictures can be shown"""
        with open(os.path.join(support.root, "clients/python/examples.ipynb"), encoding="utf-8") as file:
            cells = [cell for cell in json.load(file)["cells"] if cell["cell_type"] == "code"]
        self.assertFalse(any(cell["outputs"] for cell in cells))
        names, printed, shown = {"__name__": "notebook"}, io.StringIO(), 0
        for number, cell in enumerate(cells):
            source = "".join(cell["source"])
            with contextlib.redirect_stdout(printed), warnings.catch_warnings():
                warnings.simplefilter("error")
                exec(compile(source, f"cell {number}", "exec"), names)
            last = source.rstrip().splitlines()[-1]
            if re.fullmatch(r"\w+", last):
                self.assertTrue(names[last]._repr_png_().startswith(b"\x89PNG"))
                shown += 1
        self.assertEqual((len(cells), shown), (10, 5))
        for wanted in ("(320, 480) float32", "(160, 960, 3)", "8 depth maps", "(24, 160, 240) (160, 240, 3)", "/meshes/0/faces/17/2 - ", "did you mean look?",
                       "(240, 320, 3) (240, 320) 0 for background pixels: True"):  # fmt: skip
            self.assertIn(wanted, printed.getvalue())

    def test_readme(self):
        """the README's example runs"""
        with open(os.path.join(support.root, "clients/python/README.md"), encoding="utf-8") as file:
            source = re.search(r"```python\n(.*?)```", file.read(), re.S).group(1)
        names = {"positions": numpy.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), "faces": numpy.uint32([[0, 1, 2]]),
                 "matrices": [numpy.eye(4)] * 2}  # fmt: skip
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                with open("part.stl", "wb") as file:
                    file.write(support.stl())
                exec(compile(source, "README.md", "exec"), names)
                self.assertTrue(support.read("part.png").startswith(b"\x89PNG"))
            finally:
                os.chdir(before)
        self.assertEqual(names["picture"]["depth"].shape, (480, 640))
