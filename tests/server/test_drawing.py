"""POST /v1/drawing: technical drawings, and faults."""
import json
import unittest

import daemon

CUBE = b"".join(b"v %d %d %d\n" % (i & 1, i >> 1 & 1, i >> 2) for i in range(8)) + b"".join(
    b"f " + side + b"\n" for side in (b"1 3 4 2", b"5 6 8 7", b"1 2 6 5", b"3 7 8 4", b"1 5 7 3", b"2 4 8 6")
)


class Drawing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.daemon = daemon.Daemon()

    @classmethod
    def tearDownClass(cls):
        cls.daemon.stop()

    def draw(self, query, body=CUBE, kind="model/obj"):
        status, headers, data = self.daemon.send("/v1/drawing" + query, body, Content_Type=kind)
        return status, headers, data

    def test_formats(self):
        """SVG by default, or PNG"""
        status, headers, data = self.draw("?title=Cube%20%26%20more")
        self.assertEqual((status, headers["Content-Type"]), (200, "image/svg+xml"))
        self.assertIn(b'aria-label="Cube &amp; more"', data)
        self.assertIn(b'data-scale="50:1"', data)
        status, headers, data = self.draw("?format=png&dpi=30&page=a4")
        self.assertEqual((status, headers["Content-Type"], data[:4]), (200, "image/png", b"\x89PNG"))

    def test_reading(self):
        """parameters of reading count, and scenes in JSON are drawn"""
        self.assertEqual(self.draw("")[2], self.draw("?up=y&look=clay")[2])
        scene = {"meshes": [{"positions": [[0, 0, 0], [4, 0, 0], [0, 2, 0], [0, 0, 1]],
                             "faces": [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]}]}  # fmt: skip
        status, _, data = self.draw("?section=x", json.dumps(scene).encode(), "application/json")
        self.assertEqual(status, 200)
        self.assertIn(b'aria-label="A-A"', data)

    def test_warnings(self):
        """warnings are in the header"""
        _, headers, _ = self.draw("?section=x", CUBE[: CUBE.rindex(b"f ")])
        self.assertIn("not closed", headers["Zraster-Warnings"])

    def test_faults(self):
        """wrong parameters are 400, scenes without a drawing 422"""
        for query, status, text in (
            ("?page=a5", 400, "a5 is not a4 or a3"),
            ("?dpi=5000", 400, "dpi: 5000 is not 30 to 600"),
            ("?section=x:2", 400, "share between 0 and 1"),
            ("?nix=1", 400, "nix"),
            ("?scale=1", 400, "N:M"),
            ("?scale=1000:1", 422, "50:1"),
        ):
            found, _, data = self.draw(query)
            self.assertEqual(found, status, query)
            self.assertIn(text, json.loads(data)["detail"])
        self.assertEqual(self.draw("", b"v 0 0 0\nv 1 1 1\nl 1 2\n")[0], 422)
        self.assertEqual(self.draw("", b"x", "text/html")[0], 415)
        self.assertEqual(self.draw("", b"{", "application/json")[0], 400)


if __name__ == "__main__":
    unittest.main()
