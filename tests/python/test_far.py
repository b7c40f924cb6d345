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

    def test_matrices_of_instances_and_sheets_are_those_of_the_scene(self):
        node = {"name": "n", "mesh": 0, "translation": list(FAR)}
        mesh = {"positions": CORNERS, "faces": [[0, 1, 2]], "doubleSided": True}
        far = {"positions": moved(FAR), "faces": [[0, 1, 2]], "doubleSided": True}
        undone = {"name": "n", "mesh": 0, "translation": [-place for place in FAR]}
        for scene, place in (({"meshes": [mesh], "nodes": [node]}, FAR), ({"meshes": [far]}, (0, 0, 0)),
                             ({"meshes": [far], "nodes": [undone]}, [-place for place in FAR])):
            info = zraster.render(dict(scene, visibility=True, view="front"), ["info"])["info"]
            self.assertEqual(info["visibility"][0]["objectToWorld"][12:15], list(place))
        sheet = {"meshes": [far], "views": [{"name": "one", "view": "front"}, {"name": "two", "view": "isometric"}], "sheet": "views"}
        front = zraster.render(sheet, ["info"])["info"]["sheet"][0]["worldToCamera"]
        self.assertEqual([round(front[12 + axis] + FAR[axis] + 0.5, 5) for axis in (0, 1)], [0, 0])

    def test_homogeneous_positions_are_drawn_as_others(self):
        def doubled(by):
            return {"meshes": [{"positions": [[2 * place for place in corner] + [2] for corner in moved(by)], "faces": [[0, 1, 2]]}],
                    "view": {"preset": "front"}, "window": {"width": 32, "height": 32}}
        near, far = (zraster.render(doubled(by), ["color"])["color"] for by in ((0, 0, 0), (4e5 + 1 / 64, -3e5, 62500)))
        self.assertTrue((far == near).all())

    def test_keys_of_animations_keep_their_digits(self):
        def moves(by):
            keys = [[by[0] + k / 64, by[1], by[2]] for k in (0, 1, 3)]
            return {"meshes": [{"positions": CORNERS, "faces": [[0, 1, 2]], "doubleSided": True}],
                    "nodes": [{"name": "n", "mesh": 0, "translation": list(by)}], "window": {"width": 32, "height": 32},
                    "view": {"eye": [by[0], by[1], by[2] + 0.25], "target": list(by)},
                    "animate": {"frames": 4, "nodes": {"n": {"times": [0, 1, 2], "translation": keys}}}}
        near, far = (zraster.render(moves(by), ["color"]) for by in ((0, 0, 0), (5e5, -3e5, 62500)))
        for frame in ("0001.color", "0002.color", "0003.color", "0004.color"):
            self.assertTrue((far[frame] == near[frame]).all(), frame)
        self.assertFalse((far["0001.color"] == far["0002.color"]).all())

    def test_turns_keep_the_digits_of_translations(self):
        def turned(by):
            node = {"name": "n", "mesh": 0, "translation": [by[0] + 1 / 64, by[1] + 1 / 64, by[2]]}
            stands = {"mesh": 0, "translation": [by[0] - 1 / 64, by[1] - 1 / 64, by[2]]}
            return {"meshes": [{"positions": CORNERS, "faces": [[0, 1, 2]], "doubleSided": True}],
                    "nodes": [node, stands], "window": {"width": 32, "height": 32},
                    "view": {"eye": list(by[:2]) + [by[2] + 4], "target": list(by)},
                    "animate": {"frames": 2, "nodes": {"n": {"rotate": {"axis": "x", "degrees": 60}}}}}
        near, far = (zraster.render(turned(by), ["depth"])["depth"] for by in ((0, 0, 0), (5e5, -3e5, 62500)))
        close = abs(numpy.nan_to_num(far, posinf=0) - numpy.nan_to_num(near, posinf=0)) < 1e-5
        self.assertGreater(close.mean(), 0.998)


if __name__ == "__main__":
    unittest.main()
