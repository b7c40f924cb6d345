"""Views through a lens: positions lie in their own pixels, after OpenCV's formulas and by cv2 where it is installed."""
import unittest
import warnings

import zraster
from support import needs_numpy, numpy

try:
    import cv2
except ImportError:
    cv2 = None

needs_cv2 = unittest.skipUnless(cv2, "there is no cv2 (python3-opencv): OpenCV itself was not compared, only its formulas")

# A pixel's half diagonal is 0.7071; the rest is for rounding.
PIXELS_MAX = 0.71
OPENCV = {
    "none": [],
    "barrel": [-0.28, 0.07, 0.0006, -0.0004, 0.01],
    "pincushion": [0.12, 0.05, 0, 0],
    "tangential": [-0.05, 0.01, 0.02, -0.015],
    "rational": [3.2, 1.4, 0.0003, 0.0002, 0.06, 3.5, 2.6, 0.4],
    "moustache": [-0.3, 0.35, 0, 0, -0.05],
}
FISHEYE = {"equidistant": [0, 0, 0, 0], "wide": [-0.02, 0.004, -0.001, 0.0002], "strong": [0.05, 0.02, 0.01, -0.004]}
WINDOWS = [(320, 240, 210.0, 205.0, 157.3, 124.8), (61, 47, 40.0, 41.0, 33.0, 20.5), (640, 200, 400.0, 400.0, 319.5, 99.5)]
ROTATION = [[0.8, -0.6, 0.0], [-0.48, -0.64, -0.6], [0.36, 0.48, -0.8]]


def scene_of(window, distortion, channels=("position",), **keys):
    """Returns a scene whose wall fills the window, with a few bumps in front; K as OpenCV has it."""
    width, height, fx, fy, cx, cy = window
    heights = [[0.3 * ((x * 7 + y * 3) % 5) for x in range(24)] for y in range(24)]
    back = numpy.linalg.inv(ROTATION)
    pose = numpy.eye(4)
    pose[:3, :3] = numpy.array(ROTATION).T @ numpy.diag([1, -1, -1])
    pose[:3, 3] = back @ [0, 0, 3]
    far = numpy.eye(4)
    far[:3, :3] = pose[:3, :3]
    far[:3, 3] = back @ [0, 0, 5]
    wall = [[-99, -99, 0], [99, -99, 0], [99, 99, 0], [-99, 99, 0]]
    view = {"R": ROTATION, "t": [0.1, -0.2, 0.3], "K": [[fx, 0, cx], [0, fy, cy], [0, 0, 1]], "pixelCenter": 0}
    if distortion is not None:
        view["distortion"] = distortion
    return {
        "window": {"width": width, "height": height},
        "materials": [{"name": "all", "doubleSided": True}],
        "meshes": [
            {"name": "bumps", "heights": heights, "material": "all"},
            {"name": "wall", "positions": wall, "faces": [[0, 1, 2, 3]], "material": "all"},
        ],
        "nodes": [
            {"mesh": "bumps", "matrix": (pose @ numpy.diag([0.1, 0.1, 0.1, 1])).T.ravel().tolist()},
            {"mesh": "wall", "matrix": far.T.ravel().tolist()},
        ],
        "view": view,
        "outputs": [c if isinstance(c, dict) else {"channel": c} for c in channels],
        **keys,
    }


def project_opencv(points, c):
    k1, k2, p1, p2, k3, k4, k5, k6 = (list(c) + [0] * 8)[:8]
    x, y = points[:, 0] / points[:, 2], points[:, 1] / points[:, 2]
    s = x * x + y * y
    g = (1 + k1 * s + k2 * s**2 + k3 * s**3) / (1 + k4 * s + k5 * s**2 + k6 * s**3)
    return numpy.stack([x * g + 2 * p1 * x * y + p2 * (s + 2 * x * x), y * g + p1 * (s + 2 * y * y) + 2 * p2 * x * y], -1)


def project_fisheye(points, k):
    x, y = points[:, 0] / points[:, 2], points[:, 1] / points[:, 2]
    r = numpy.hypot(x, y)
    a = numpy.arctan(r)
    distorted = a * (1 + k[0] * a**2 + k[1] * a**4 + k[2] * a**6 + k[3] * a**8)
    factor = numpy.where(r > 0, distorted / numpy.where(r > 0, r, 1), 1)
    return numpy.stack([x * factor, y * factor], -1)


def lenses():
    """Yields a name, the key `distortion`, the formula and the coefficients."""
    for name, c in OPENCV.items():
        yield name, c, project_opencv, c
    for name, k in FISHEYE.items():
        yield name, {"model": "fisheye", "k": k}, project_fisheye, k


def own_pixels(width, height):
    """Returns the centres of all pixels, as OpenCV counts them: the first is 0, 0."""
    return numpy.stack(numpy.meshgrid(numpy.arange(width), numpy.arange(height)), -1).reshape(-1, 2)


@needs_numpy
class Lenses(unittest.TestCase):
    def check(self, pixels, window):
        away = numpy.hypot(*(pixels.reshape(-1, 2) - own_pixels(*window[:2])).T)
        self.assertLess(away.max(), PIXELS_MAX)

    def test_positions_in_camera(self):
        """every position in camera space projects to its own pixel, by OpenCV's formulas"""
        for window in WINDOWS:
            for name, distortion, project, c in lenses():
                with self.subTest(name, window=window):
                    picture = zraster.render(scene_of(window, distortion), strict=True)
                    points = picture["position"].reshape(-1, 3).astype(float) * [1, -1, -1]
                    self.assertTrue((points[:, 2] > 0).all())
                    self.check(project(points, c) * window[2:4] + window[4:6], window)

    def test_depth_and_distance(self):
        """depth stays along the axis, and distance is the length of the ray"""
        picture = zraster.render(scene_of(WINDOWS[0], OPENCV["barrel"], ["position", "depth", "distance"]))
        points = picture["position"]
        self.assertLess(abs(picture["depth"] + points[..., 2]).max(), 1e-4)
        self.assertLess(abs(picture["distance"] - numpy.linalg.norm(points, axis=-1)).max(), 1e-3)

    def test_info(self):
        """info names the distortion beside the camera matrix of the view"""
        for distortion, told in (
            ([-0.2, 0.1, 0.01, 0.02], {"model": "opencv", "k": [-0.2, 0.1, 0, 0, 0, 0], "p": [0.01, 0.02]}),
            ({"model": "fisheye", "k": [0.1]}, {"model": "fisheye", "k": [0.1, 0, 0, 0]}),
            (None, None),
        ):
            info = zraster.render(scene_of(WINDOWS[0], distortion, ["info"])).info
            self.assertEqual(info["camera"].get("distortion"), told)
            self.assertAlmostEqual(info["camera"]["K"][0][2], WINDOWS[0][4] + 0.5, 4)

    def test_no_ray(self):
        """pixels beyond the fold of a lens are uncovered, with a warning that strict refuses"""
        scene = scene_of(WINDOWS[0], {"k": [-1.5]}, ["color", "depth", "faceId"])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            picture = zraster.render(scene)
        nowhere = numpy.isinf(picture["depth"])
        self.assertRegex(picture.warnings[0], f"^{nowhere.sum()} pixels are beyond the fold of the lens")
        self.assertTrue((picture["faceId"][nowhere] == 0).all() and (picture["faceId"][~nowhere] > 0).all())
        self.assertTrue(((picture["color"][nowhere] == 255).all(-1)).all())
        u = (own_pixels(320, 240) - WINDOWS[0][4:6]) / WINDOWS[0][2:4]
        fold = numpy.sqrt(1 / 4.5)
        beyond = numpy.hypot(*u.T) > fold - 1.5 * fold**3
        self.assertTrue((beyond == nowhere.ravel()).all())
        with self.assertRaisesRegex(zraster.SceneError, "beyond the fold"):
            zraster.render(scene, strict=True)

    def test_color_bar(self):
        """a colour bar over a picture through a lens has the place and the pixels that it has without one"""
        heights = [[((x * 7 + y * 3) % 5) * 0.2 for x in range(9)] for y in range(9)]
        view = {"eye": [4, 4, 14], "target": [4, 4, 0], "intrinsics": {"fx": 200}}
        scene = {"window": {"width": 420, "height": 300}, "meshes": [{"heights": heights, "colormap": "viridis"}]}
        pictures = {
            (bar, distortion): zraster.render({**scene, "colorBar": bar, "view": {**view, "distortion": key}}).array
            for bar in (False, True)
            for distortion, key in (("none", []), ("barrel", [-0.2, 0.05, 0, 0]))
        }
        bars = {key: (pictures[False, key] != pictures[True, key]).any(-1) for key in ("none", "barrel")}
        self.assertTrue((bars["none"] == bars["barrel"]).all() and bars["none"].any())
        self.assertTrue((pictures[True, "none"][bars["none"]] == pictures[True, "barrel"][bars["none"]]).all())
        self.assertTrue((pictures[False, "none"] != pictures[False, "barrel"]).any())

    @needs_cv2
    def test_cv2(self):
        """cv2 projects every position in world space to its own pixel"""
        rotation = cv2.Rodrigues(numpy.array(ROTATION))[0]
        output = {"channel": "position", "space": "world"}
        for window in WINDOWS:
            width, height, fx, fy, cx, cy = window
            matrix, move = numpy.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]]), numpy.array([0.1, -0.2, 0.3])
            for name, distortion, _, c in lenses():
                with self.subTest(name, window=window):
                    points = zraster.render(scene_of(window, distortion, [output]))["position"]
                    points = points.reshape(-1, 1, 3).astype(float)
                    is_fisheye = isinstance(distortion, dict)
                    project = cv2.fisheye.projectPoints if is_fisheye else cv2.projectPoints
                    factors = numpy.array(c, dtype=float) if len(c) else None
                    self.check(project(points, rotation, move, matrix, factors)[0], window)
