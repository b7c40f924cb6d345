"""POST /v1/compare: numbers and pictures of two models, and faults."""
import json
import unittest

import daemon


class Daemon(daemon.Daemon):
    def compare(self, query, parts, **headers):
        """Posts a form. Returns status, type and bytes."""
        body = b""
        for name, data in parts.items():
            body += b'--bound\r\nContent-Disposition: form-data; name="%s"\r\n' % name.encode()
            body += b"\r\n" + data + b"\r\n"
        body += b"--bound--\r\n"
        status, headers, data = self.send(
            "/v1/compare" + query, body, Content_Type="multipart/form-data; boundary=bound", **headers
        )
        return status, headers["Content-Type"], data


def box(low, size, faces=6):
    """Returns an OBJ of a box."""
    sides = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"]
    corners = [[low[k] + size[k] * (i >> k & 1) for k in range(3)] for i in range(8)]
    lines = ["v %g %g %g" % tuple(corner) for corner in corners] + ["f " + side for side in sides[:faces]]
    return "\n".join(lines).encode() + b"\n"


CUBE = box((0, 0, 0), (1, 1, 1))
LONG = box((0, 0, 0), (2, 1, 1))
COMBINED = (
    b'{"meshes": [{"name": "a", "shape": {"type": "box", "size": 2}}, {"name": "b", "shape": {"type": "sphere", "radius": 1.3}}],'
    b' "csg": {"difference": ["a", "b"]}}'
)


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()

    def test_switches_leave_numbers_out(self):
        parts = {"a": CUBE, "b": LONG}
        everything = json.loads(self.daemon.compare("", parts)[2])
        self.assertIn("deviation", everything)
        self.assertEqual(everything["features"]["holes"], {"removed": [], "added": [], "moved": [], "changed": []})
        less = json.loads(self.daemon.compare("?deviation=off&features=off", parts)[2])
        self.assertNotIn("deviation", less)
        self.assertNotIn("features", less)
        self.assertEqual(less["volume"], everything["volume"])
        self.assertFalse(less["same"])
        self.assertTrue(json.loads(self.daemon.compare("?deviation=off", {"a": CUBE, "b": CUBE})[2])["same"])
        self.assertEqual(self.daemon.compare("?features=no", parts)[0], 400)

    def test_alignments_scale_if_asked(self):
        small = {"a": LONG, "b": box((3, 0, 0), (0.5, 0.25, 0.25))}
        found = json.loads(self.daemon.compare("?align=principal&rescale=on", small)[2])
        self.assertTrue(found["same"])
        self.assertAlmostEqual(found["alignment"]["scale"], 4, 9)
        self.assertNotIn("scale", json.loads(self.daemon.compare("?align=principal", small)[2])["alignment"])
        self.assertEqual(self.daemon.compare("?rescale=on", small)[0], 400)

    def test_numbers(self):
        """two parts give the numbers of both models"""
        status, kind, data = self.daemon.compare("", {"a": CUBE, "b": LONG})
        numbers = json.loads(data)
        self.assertEqual((status, kind), (200, "application/json"))
        self.assertAlmostEqual(numbers["volume"]["iou"], 0.5, 5)
        self.assertEqual(numbers["b"]["volume"], 2)
        self.assertEqual([region["in"] for region in numbers["regions"]], ["b"])

    def test_parameters(self):
        """alignment and tolerance"""
        moved = box((5, 6, 7), (1, 1, 1))
        for query, same in (("", False), ("?align=bounds", True), ("?tolerance=20&precision=quick", True)):
            data = self.daemon.compare(query, {"a": CUBE, "b": moved})[2]
            self.assertEqual(json.loads(data)["same"], same, query)

    def test_pictures(self):
        """show gives a picture, with the numbers beside it if parts are accepted"""
        models = {"a": CUBE, "b": LONG}
        for show in ("difference", "deviation", "side"):
            query = f"?show={show}&width=64&height=48&look=clay&view=front"
            status, kind, data = self.daemon.compare(query, models)
            self.assertEqual((status, kind), (200, "image/png"), data[:300])
            self.assertEqual(data[16:24], b"\0\0\0\x40\0\0\0\x30")
        status, kind, data = self.daemon.compare("?show=side&width=64&height=48", models, Accept="multipart/mixed")
        self.assertTrue(status == 200 and kind.startswith("multipart/mixed"))
        self.assertIn(b"comparison.json", data)
        self.assertIn(b"\x89PNG", data)

    def test_faults(self):
        """faults name the part or the parameter"""
        for status, query, parts, text in (
            (400, "", {"a": CUBE}, "the part 'b' is missing"),
            (415, "", {"a": CUBE, "b": b"?"}, "b: no type is given"),
            (400, "?align=best", {"a": CUBE, "b": CUBE}, "one of: none, bounds, principal, icp"),
            (400, "?width=9", {"a": CUBE, "b": CUBE}, "show=difference asks for one"),
            (400, "?show=side&width=no", {"a": CUBE, "b": CUBE}, "width"),
            (422, "?show=side&look=none", {"a": CUBE, "b": CUBE}, "/look"),
            (422, "", {"a": CUBE, "b": b"v 0 0 0\nv 1 0 0\nl 1 2\n"}, "b has no faces"),
            (422, "", {"a": CUBE, "b": COMBINED}, "leave out csg of b"),
            (422, "?show=side", {"a": COMBINED, "b": CUBE}, "leave out csg of a"),
        ):
            found, _, data = self.daemon.compare(query, parts)
            self.assertEqual(found, status, data)
            self.assertIn(text, data.decode())
        found, _, data = self.daemon.send("/v1/compare", CUBE, Content_Type="model/obj")
        self.assertEqual(found, 415)

    def test_cost(self):
        """work beyond costMaxMs is refused before it begins"""
        small = Daemon("--cost-max-ms", "20")
        self.addCleanup(small.stop)
        status, _, data = small.compare("", {"a": CUBE, "b": CUBE})
        self.assertEqual(status, 422)
        self.assertIn(b"precision=quick", data)


if __name__ == "__main__":
    unittest.main()
