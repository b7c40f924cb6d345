"""zraster.mujoco with a stand-in for mujoco: its scenes are what mjv_updateScene would fill in."""
import inspect
import math
import sys
import types
import unittest

from support import needs_numpy, numpy


def make_mujoco():
    """Returns a module with what the renderer calls."""
    module = types.ModuleType("mujoco")

    class MjvScene:
        def __init__(self, model, maxgeom):
            self.geoms, self.ngeom, self.lights, self.nlight, self.camera = [], 0, [], 0, []

    class Named:
        pass

    def update(model, data, option, perturb, camera, mask, scene):
        eyes = [types.SimpleNamespace(**data.eye) for _ in range(2)]
        eyes[0].pos, eyes[1].pos = (numpy.add(data.eye["pos"], [shift, 0, 0]) for shift in (-0.1, 0.1))
        scene.camera, scene.geoms, scene.ngeom = eyes, data.geoms, len(data.geoms)
        scene.lights, scene.nlight = data.lights, len(data.lights)
        data.updated = (camera.fixedcamid, camera.type, mask)

    module.MjvScene, module.MjvOption, module.MjvCamera = MjvScene, Named, Named
    module.mjtObj = types.SimpleNamespace(mjOBJ_CAMERA=7)
    module.mjtCamera = types.SimpleNamespace(mjCAMERA_FREE=0, mjCAMERA_FIXED=2)
    module.mjtCatBit = types.SimpleNamespace(mjCAT_ALL=7)
    module.mj_name2id = lambda model, kind, name: {"eye": 0}.get(name, -1)
    module.mjv_defaultFreeCamera = lambda model, camera: None
    module.mjv_updateScene = update
    return module


def geom(kind, size, pos=(0, 0, 0), objid=3, dataid=-1, rgba=(1, 0, 0, 1), segid=0, shininess=0.5):
    return types.SimpleNamespace(type=kind, size=numpy.float32(size), pos=pos, mat=numpy.eye(3), objid=objid, objtype=5, dataid=dataid,
                                 rgba=numpy.float32(rgba), segid=segid, specular=0.5, shininess=shininess)  # fmt: skip


@needs_numpy
class Mujoco(unittest.TestCase):
    def setUp(self):
        import zraster.mujoco

        sys.modules["mujoco"] = make_mujoco()
        self.addCleanup(sys.modules.pop, "mujoco")
        tangent = math.tan(0.4)
        eye = {"pos": [0, 0, 5], "forward": numpy.float32([0, 0, -1]), "up": numpy.float32([0, 1, 0]), "frustum_center": 0,
               "frustum_bottom": -0.1 * tangent, "frustum_top": 0.1 * tangent, "frustum_near": 0.1, "frustum_far": 50}  # fmt: skip
        light = types.SimpleNamespace(dir=[0, 0, -1], ambient=[0.1] * 3, diffuse=[0.7] * 3, specular=[0.3] * 3)
        self.model = types.SimpleNamespace(
            ncam=1, stat=types.SimpleNamespace(extent=1.0), hfield_nrow=[2], hfield_ncol=[3], hfield_adr=[0], hfield_size=[[1, 1, 2, 0.1]],
            hfield_data=numpy.ones(6, "f4"), mesh_vertadr=[0, 3], mesh_vertnum=[3, 3], mesh_faceadr=[0, 1], mesh_facenum=[1, 1],
            mesh_vert=numpy.float32([[9, 9, 9]] * 3 + [[-1, -1, 0], [1, -1, 0], [0, 1, 0]]), mesh_face=numpy.int32([[0, 1, 2]] * 2),
        )  # fmt: skip
        self.data = types.SimpleNamespace(eye=eye, lights=[light], geoms=[])
        self.renderer = zraster.mujoco.Renderer(self.model, 60, 80)

    def depth(self, *geoms):
        self.data.geoms = list(geoms)
        self.renderer.update_scene(self.data)
        self.renderer.enable_depth_rendering()
        return self.renderer.render()

    def test_signatures(self):
        """functions take the original's parameters (mujoco 3)"""
        wanted = {"__init__": "model height width max_geom", "update_scene": "data camera scene_option", "render": "out", "close": "",
                  "enable_depth_rendering": "", "disable_depth_rendering": "", "enable_segmentation_rendering": "",
                  "disable_segmentation_rendering": ""}  # fmt: skip
        for name, parameters in wanted.items():
            found = inspect.signature(getattr(type(self.renderer), name)).parameters
            self.assertEqual([one for one in found if one not in ("self", "_")], parameters.split(), name)
        self.assertEqual((self.renderer.width, self.renderer.height, self.renderer.model), (80, 60, self.model))

    def test_depth(self):
        """each kind of geom has its depth in metres; background pixels have that of the far plane"""
        nearest = [
            (geom(0, [1, 1, 0]), 5), (geom(1, [0, 0, 0], dataid=0), 3), (geom(2, [1, 1, 1]), 4),
            (geom(3, [0.5, 0.5, 1]), 3.5), (geom(4, [1, 1, 2]), 3), (geom(5, [1, 1, 0.5]), 4.5), (geom(6, [1, 1, 0.7]), 4.3),
            (geom(7, [1, 1, 1], dataid=2), 5), (geom(0, [0, 0, 0]), 5),
        ]  # fmt: skip
        for one, wanted in nearest:
            depth = self.depth(one)
            self.assertEqual((depth.shape, depth.dtype.name), ((60, 80), "float32"))
            self.assertAlmostEqual(depth[30, 40], wanted, delta=0.01, msg=str(one.type))
            self.assertEqual(depth[0, 0], 5 if max(one.size) == 0 and one.type == 0 else 50)
            self.assertTrue(0 < (depth < 50).sum())
        self.assertTrue((self.depth() == 50).all())
        out = numpy.empty((60, 80))
        self.assertIs(self.renderer.render(out=out), out)
        with self.assertRaisesRegex(ValueError, "out.shape"):
            self.renderer.render(out=numpy.empty((80, 60)))

    def test_segmentation(self):
        """segmentation gives objid and objtype, and -1 for background pixels"""
        left, right, mark = (
            geom(2, [1] * 3, (-1, 0, 0), 11),
            geom(2, [1] * 3, (1, 0, 0), 12),
            geom(2, [1] * 3, (0, 0, 3), 13, segid=-1),
        )
        self.data.geoms = [left, right, mark, geom(100, [1] * 3)]
        self.renderer.update_scene(self.data)
        self.renderer.enable_segmentation_rendering()
        pairs = self.renderer.render()
        self.assertEqual((pairs.shape, pairs.dtype.name), ((60, 80, 2), "int32"))
        self.assertEqual([pairs[30, x].tolist() for x in (30, 50, 0)], [[11, 5], [12, 5], [-1, -1]])

    def test_color(self):
        """colours are lit; the background is black"""
        self.data.geoms = [geom(6, [1, 1, 1]), geom(2, [0.3] * 3, (0, 0, 2), rgba=(0, 0, 1, 0.5))]
        with self.renderer as renderer:
            renderer.update_scene(self.data, "eye")
            color = renderer.render()
        self.assertEqual((color.shape, color.dtype.name), ((60, 80, 3), "uint8"))
        self.assertEqual(color[0, 0].tolist(), [0, 0, 0])
        self.assertTrue(color[18, 28, 0] > 150 and color[18, 28, 2] < 150)
        self.assertTrue(color[30, 40, 2] > 90)
        self.assertEqual(self.data.updated, (0, 2, 7))

    def test_shininess(self):
        """geoms that differ in shininess alone have materials of their own"""

        def draw(*shininesses):
            places = zip((-1, 1), shininesses)
            self.data.geoms = [geom(2, [0.9] * 3, (x, 0, 0), shininess=shininess) for x, shininess in places]
            self.renderer.update_scene(self.data)
            return self.renderer.render()

        mixed = draw(0.1, 1)
        numpy.testing.assert_array_equal(mixed[:, :40], draw(0.1, 0.1)[:, :40])
        numpy.testing.assert_array_equal(mixed[:, 40:], draw(1, 1)[:, 40:])
        self.assertTrue((mixed != draw(0.1, 0.1)).any())

    def test_cameras(self):
        """cameras that do not exist are refused"""
        for camera in ("none", 1, -2):
            with self.assertRaises(ValueError):
                self.renderer.update_scene(self.data, camera)
        self.renderer.update_scene(self.data)
        self.assertEqual(self.data.updated, (-1, 0, 7))
