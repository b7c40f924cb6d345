"""Scenes far from the origin: lists and arrays, and places that outputs give back in coordinates of the scene."""
import unittest

import zraster
from support import needs_numpy, numpy

FAR = (500000.25, -300000.5, 1000000 / 16)
CORNERS = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
COLORS = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
NORMALS = [[0, 0, 1], [0, 0.6, 0.8], [0.6, 0, 0.8]]


def moved(by):
    return [[corner[k] + by[k] for k in range(3)] for corner in CORNERS]


def polygons(by):
    return {"polygons": [{"vertices": moved(by), "colors": COLORS, "normals": NORMALS}],
            "view": {"preset": "front"}, "window": {"width": 32, "height": 32}}


def with_arrays(scene):
    types = {"vertices": "f8", "colors": "f4", "normals": "f4"}
    lists = scene["polygons"][0]
    return dict(scene, polygons=[{key: numpy.array(lists[key], types[key]) for key in lists}])


@needs_numpy
class Far(unittest.TestCase):
    def test_arrays_are_drawn_as_lists(self):
        near = zraster.render(polygons((0, 0, 0)), ["color"])["color"]
        for scene in (polygons(FAR), with_arrays(polygons(FAR))):
            self.assertTrue((zraster.render(scene, ["color"])["color"] == near).all())

    def test_places_are_those_of_the_scene(self):
        for space in ("world", "object"):
            output = {"channel": "position", "space": space}
            near = zraster.render(polygons((0, 0, 0)), [output])["position"]
            far = zraster.render(polygons(FAR), [output])["position"]
            seen = far[..., 0] != 0
            self.assertGreater(seen.sum(), 100)
            self.assertLess(abs(far - near - numpy.array(FAR))[seen].max(), 0.04)      # a unit of floats is 1/32
        info = zraster.render(polygons(FAR), ["info"])["info"]
        self.assertEqual(info["bounds"]["min"], list(FAR))
        self.assertNotIn("origin", info)


if __name__ == "__main__":
    unittest.main()
