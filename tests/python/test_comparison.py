"""Comparisons of two models."""
import unittest

import zraster
from support import OBJ, needs_numpy

FACES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


def box(low, size):
    """Returns a scene of a box."""
    corners = [[low[k] + size[k] * (i >> k & 1) for k in range(3)] for i in range(8)]
    return {"meshes": [{"name": "box", "positions": corners, "faces": FACES}]}


CUBE = box((0, 0, 0), (1, 1, 1))


class Comparisons(unittest.TestCase):
    def test_numbers(self):
        """a moved cube has the numbers of the formulas"""
        comparison = zraster.compare(CUBE, box((0.125, 0, 0), (1, 1, 1)))
        self.assertAlmostEqual(comparison.iou, 7 / 9, 6)
        self.assertAlmostEqual(comparison.hausdorff, 0.125, 12)
        self.assertEqual([region["in"] for region in comparison.regions].count("b"), 1)
        self.assertEqual(comparison["a"]["volume"], 1)
        self.assertIn("IoU 0.77", repr(comparison))
        self.assertFalse(comparison.same)
        self.assertEqual(comparison.warnings, [])

    def test_options(self):
        """alignment and tolerance; a Scene is read once"""
        with zraster.Scene(CUBE) as scene:
            moved = box((5, 6, 7), (1, 1, 1))
            self.assertTrue(zraster.compare(scene, moved, align="bounds").same)
            self.assertFalse(zraster.compare(scene, moved, precision="quick").same)
            self.assertTrue(zraster.compare(scene, moved, tolerance=20).same)
        with self.assertRaisesRegex(zraster.OptionError, "closed"):
            zraster.compare(scene, CUBE)
        with self.assertRaisesRegex(zraster.OptionError, "one of: none, bounds, principal, icp"):
            zraster.compare(CUBE, CUBE, align="best")

    def test_open(self):
        """open models have no IoU"""
        comparison = zraster.compare(CUBE, OBJ)
        self.assertIsNone(comparison.iou)
        self.assertIn("b is not closed", comparison.warnings[0])

    @needs_numpy
    def test_pictures(self):
        """each kind of picture is drawn with the keywords of a scene"""
        comparison = zraster.compare(CUBE, box((0, 0, 0), (2, 1, 1)))
        for show in ("difference", "deviation", "side"):
            picture = comparison.render(show, size=(64, 48), view="front", look="clay")
            color = picture["color"].astype(int)
            self.assertEqual(color.shape[:2], (48, 64))
            self.assertGreater(int((color[:, :, 0] - color[:, :, 2] > 60).sum()), 100, show)
        self.assertEqual(comparison.render(channels="depth", size=8)["depth"].shape, (8, 8))
        with self.assertRaisesRegex(zraster.OptionError, "one of: none, difference"):
            comparison.render("all")
        with self.assertRaisesRegex(zraster.OptionError, "one of: difference"):
            comparison.render("none")

    def test_cancel(self):
        """a raised flag ends it"""
        cancel = zraster.Cancel()
        cancel.cancel()
        with self.assertRaises(zraster.Cancelled):
            zraster.compare(CUBE, CUBE, cancel=cancel)


if __name__ == "__main__":
    unittest.main()
