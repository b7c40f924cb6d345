"""Patterns of public scripts for pyrender, as they are written: each runs unchanged and gives the facts that its script relies on."""
import math
import sys
import unittest

from support import needs_numpy, numpy as np
from test_pyrender import Box, Visual, pose

SIZE = 64
FOCAL = 80.0


class Ball:
    """A stand-in for trimesh.creation.uv_sphere."""

    def __init__(self, radius=1.0, count=24, visual=None):
        u, v = np.meshgrid(np.arange(2 * count) * np.pi / count, np.arange(count + 1) * np.pi / count)
        self.vertex_normals = np.stack([np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), np.cos(v)], axis=-1).reshape(-1, 3)
        self.vertices, width = radius * self.vertex_normals, 2 * count
        row, column = np.meshgrid(np.arange(count), np.arange(width), indexing="ij")
        a, b = (row * width + column).ravel(), (row * width + (column + 1) % width).ravel()
        self.faces = np.concatenate([np.stack([a, a + width, b + width], axis=1), np.stack([a, b + width, b], axis=1)])
        self.face_normals = self.vertex_normals[self.faces[:, 0]]
        self.visual = visual or Visual()

    def apply_transform(self, matrix):
        self.vertices = self.vertices @ matrix[:3, :3].T + matrix[:3, 3]
        self.vertex_normals = self.vertex_normals @ matrix[:3, :3].T
        return self


def disc_share(radius, distance, focal=FOCAL, size=SIZE):
    """Returns the share of a square picture that a ball on the axis covers."""
    return math.pi * (focal * radius / math.sqrt(distance**2 - radius**2)) ** 2 / size**2


@needs_numpy
class Scripts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        global pyrender
        cls.before = {name: module for name, module in sys.modules.items() if name.split(".")[0] == "pyrender"}
        import zraster.pyrender

        zraster.pyrender.install()
        import pyrender

    @classmethod
    def tearDownClass(cls):
        for name in [name for name in sys.modules if name.split(".")[0] == "pyrender"]:
            del sys.modules[name]
        sys.modules.update(cls.before)

    def intrinsics(self, **options):
        return pyrender.IntrinsicsCamera(fx=FOCAL, fy=FOCAL, cx=SIZE / 2, cy=SIZE / 2, **options)

    def covers(self, mask, share):
        self.assertAlmostEqual(mask.mean(), share, delta=0.03 * share + 0.003)

    def test_body_over_photo(self):
        """a body is turned by 180 degrees about x, drawn and put over a photo by its depth"""
        renderer = pyrender.OffscreenRenderer(viewport_width=SIZE, viewport_height=SIZE, point_size=1.0)
        material = pyrender.MetallicRoughnessMaterial(metallicFactor=0.2, alphaMode="OPAQUE", baseColorFactor=(0.8, 0.3, 0.3, 1.0))
        body = Ball(0.5).apply_transform(np.diag([1.0, -1, -1, 1]))
        scene = pyrender.Scene(ambient_light=(0.5, 0.5, 0.5))
        scene.add(pyrender.Mesh.from_trimesh(body, material=material), "mesh")
        camera_pose = np.eye(4)
        camera_pose[:3, 3] = np.array([0, 0, 3.0])
        scene.add(self.intrinsics(), pose=camera_pose)
        light = pyrender.DirectionalLight(color=[1.0, 1.0, 1.0], intensity=1)
        light_pose = np.eye(4)
        for place in ([0, -1, 1], [0, 1, 1], [1, 1, 2]):
            light_pose[:3, 3] = np.array(place)
            scene.add(light, pose=light_pose)
        color, rend_depth = renderer.render(scene, flags=pyrender.RenderFlags.RGBA)
        color = color.astype(np.float32) / 255.0
        valid_mask = (rend_depth > 0)[:, :, None]
        photo = np.full((SIZE, SIZE, 3), 0.25, np.float32)
        output_img = color[:, :, :3] * valid_mask + (1 - valid_mask) * photo
        self.assertEqual(output_img[0, 0].tolist(), [0.25] * 3)
        self.assertGreater(output_img[32, 32, 0], 1.3 * output_img[32, 32, 1])
        self.covers(valid_mask, disc_share(0.5, 3))

    def test_weak_perspective_wireframe(self):
        """a camera of the script's own, all wireframe, three point lights, and nodes that are removed after each frame"""
        from pyrender.constants import RenderFlags

        class WeakPerspectiveCamera(pyrender.Camera):
            def __init__(self, scale, translation, znear=pyrender.camera.DEFAULT_Z_NEAR, zfar=None, name=None):
                super(WeakPerspectiveCamera, self).__init__(znear=znear, zfar=10.0 if zfar is None else zfar, name=name)
                self.scale = scale
                self.translation = translation

            def get_projection_matrix(self, width=None, height=None):
                P = np.eye(4)
                P[0, 0] = self.scale[0]
                P[1, 1] = self.scale[1]
                P[0, 3] = self.translation[0] * self.scale[0]
                P[1, 3] = -self.translation[1] * self.scale[1]
                P[2, 2] = -1
                return P

        renderer = pyrender.OffscreenRenderer(viewport_width=SIZE, viewport_height=SIZE, point_size=1.0)
        scene = pyrender.Scene(bg_color=[0.0, 0.0, 0.0, 0.0], ambient_light=(0.3, 0.3, 0.3))
        light = pyrender.PointLight(color=[1.0, 1.0, 1.0], intensity=0.8)
        for place in ([0, -1, 1], [0, 1, 1], [1, 1, 2]):
            light_pose = np.eye(4)
            light_pose[:3, 3] = place
            scene.add(light, pose=light_pose)
        found = []
        for flags in (RenderFlags.RGBA | RenderFlags.ALL_WIREFRAME, RenderFlags.RGBA):
            camera = WeakPerspectiveCamera(scale=[1.0, 1.0], translation=[0.25, 0.0], zfar=1000.0)
            material = pyrender.MetallicRoughnessMaterial(
                metallicFactor=0.0, alphaMode="OPAQUE", smooth=True, wireframe=True, roughnessFactor=1.0, emissiveFactor=(0.1, 0.1, 0.1),
                baseColorFactor=(0.8, 0.8, 0.3, 1.0),
            )  # fmt: skip
            mesh_node = scene.add(pyrender.Mesh.from_trimesh(Ball(0.5, 8), material=material), "mesh")
            cam_node = scene.add(camera, pose=np.eye(4))
            rgb, _ = renderer.render(scene, flags=flags)
            found.append(rgb)
            scene.remove_node(mesh_node)
            scene.remove_node(cam_node)
        wire, solid = (one[:, :, -1] > 0 for one in found)
        self.covers(solid, math.pi * 0.5**2 / 4)
        self.assertAlmostEqual(np.nonzero(solid)[1].mean(), 31.5 + 0.25 * 32, delta=0.5)
        self.assertTrue(0 < wire.sum() < solid.sum())
        self.assertGreater(found[0][:, :, :3].max(), 60)  # lit
        self.assertEqual(len(scene.nodes), 3)

    def test_sequence(self):
        """frames of a motion: a mesh, a ground and a path of joints for each; those of the last frame are removed"""
        scene = pyrender.Scene(bg_color=[1.0, 1.0, 1.0, 0.0], ambient_light=(0.3, 0.3, 0.3))
        colors = np.tile(np.uint8([200, 200, 210, 255]), (12, 1))
        ground = pyrender.Mesh.from_trimesh(Box(Visual("face", face_colors=colors)), smooth=False)
        scene.add(ground, pose=pose(0, -2.5), name="floor")
        camera_node = scene.add(self.intrinsics(znear=0.1, zfar=100.0), pose=pose(0, 0, 5), name="pc-camera")
        scene.add(pyrender.DirectionalLight(color=np.ones(3), intensity=2.0), pose=pose(0, 2, 2))
        renderer, places = pyrender.OffscreenRenderer(SIZE, SIZE), []
        for frame in range(3):
            for node in scene.get_nodes(name="body"):
                scene.remove_node(node)
            scene.add(pyrender.Mesh.from_trimesh(Ball(0.4)), pose=pose(frame - 1), name="body")
            joints = pyrender.Mesh.from_points(np.array([[frame - 1, 1, 0]]), colors=np.array([[1.0, 0, 0]]))
            scene.add(joints, name="body")
            color, depth = renderer.render(scene, flags=pyrender.RenderFlags.RGBA)
            places.append(np.nonzero(depth[:40] > 0)[1].mean())
            self.assertEqual(color[0, 0].tolist(), [255, 255, 255, 0])
        np.testing.assert_allclose(places, [31.5 - 16, 31.5, 31.5 + 16], atol=0.6)
        self.assertEqual(len(scene.get_nodes(name="body")), 2)
        self.assertIs(scene.main_camera_node, camera_node)

    def test_pose_benchmark(self):
        """depth in millimetres of an object by the pose of a benchmark, whose camera is OpenCV's"""
        R, t = np.diag([1.0, 1, 1]), np.array([50.0, -20.0, 800.0])
        K = np.array([[572.4, 0, 325.3], [0, 573.6, 242.0], [0, 0, 1]])
        yz_flip = np.eye(4)
        yz_flip[1, 1], yz_flip[2, 2] = -1, -1
        mat_view = np.eye(4)
        mat_view[:3, :3], mat_view[:3, 3] = R, t
        scene = pyrender.Scene(bg_color=np.array([0.0, 0.0, 0.0, 0.0]), ambient_light=np.array([1.0, 1.0, 1.0, 1.0]))
        camera = pyrender.IntrinsicsCamera(fx=K[0, 0], fy=K[1, 1], cx=K[0, 2], cy=K[1, 2], znear=100, zfar=10000)
        scene.add(camera, pose=np.eye(4))
        node = scene.add(pyrender.Mesh.from_trimesh(Ball(60.0)), pose=yz_flip @ mat_view)
        renderer = pyrender.OffscreenRenderer(640, 480)
        depth = renderer.render(scene, flags=pyrender.RenderFlags.DEPTH_ONLY)
        row, column = np.unravel_index(np.where(depth > 0, depth, np.inf).argmin(), depth.shape)
        u, v, _ = K @ t / t[2]
        self.assertLess(abs(column + 0.5 - u) + abs(row + 0.5 - v), 12)
        self.assertAlmostEqual(depth[depth > 0].min(), 800 - 60, delta=0.6)
        seg, _ = renderer.render(scene, pyrender.RenderFlags.SEG, {node: (3, 3, 3)})
        np.testing.assert_array_equal(seg[:, :, 0] == 3, depth > 0)

    def test_joints_as_balls(self):
        """joints are one ball with a pose for each"""
        sm = Ball(0.05, 6, Visual("vertex", vertex_colors=np.tile(np.uint8([230, 26, 26, 255]), (6 * 2 * 7, 1))))
        sm.vertex_normals = sm.vertices / 0.05
        joints = np.array([[-0.5, 0, 0], [0.5, 0, 0], [0, 0.5, 0]])
        tfs = np.tile(np.eye(4), (len(joints), 1, 1))
        tfs[:, :3, 3] = joints
        joints_pcl = pyrender.Mesh.from_trimesh(sm, poses=tfs)
        scene = pyrender.Scene()
        scene.add(joints_pcl)
        scene.add(pyrender.PerspectiveCamera(yfov=np.pi / 3.0, aspectRatio=1.0), pose=pose(0, 0, 2))
        color, depth = pyrender.OffscreenRenderer(SIZE, SIZE).render(scene, pyrender.RenderFlags.FLAT)
        spots = [(int(31.5 + x / 2 / math.tan(math.pi / 6) * 32), int(31.5 - y / 2 / math.tan(math.pi / 6) * 32)) for x, y, _ in joints]
        self.assertTrue(all(depth[y, x] > 0 and color[y, x].tolist() == [230, 26, 26] for x, y in spots))
        np.testing.assert_allclose(scene.bounds, [[-0.55, -0.05, -0.05], [0.55, 0.55, 0.05]], atol=1e-6)

    def test_instances(self):
        """masks of instances by SEG, counted by their colours"""
        scene = pyrender.Scene(bg_color=[0, 0, 0])
        seg_node_map = {}
        for number, x in enumerate((-1.0, 0.0, 1.0), 1):
            node = scene.add(pyrender.Mesh.from_trimesh(Ball(0.3)), pose=pose(x), name=f"object{number}")
            seg_node_map[node] = [number, 0, 0]
        scene.add(self.intrinsics(), pose=pose(0, 0, 4))
        mask, depth = pyrender.OffscreenRenderer(SIZE, SIZE).render(scene, pyrender.RenderFlags.SEG, seg_node_map)
        ids = mask[:, :, 0]
        self.assertEqual(np.unique(ids).tolist(), [0, 1, 2, 3])
        np.testing.assert_array_equal(ids > 0, depth > 0)
        self.covers(ids == 2, disc_share(0.3, 4))

    def test_height_map(self):
        """heights of a scene from an orthographic camera above"""
        scene = pyrender.Scene()
        scene.add(pyrender.Mesh.from_trimesh(Box(), smooth=False), pose=pose(0, 0, 0.5))
        camera = pyrender.OrthographicCamera(xmag=1.0, ymag=1.0, znear=0.01, zfar=20.0)
        scene.add(camera, pose=pose(0, 0, 10))
        r = pyrender.OffscreenRenderer(SIZE, SIZE)
        depth = r.render(scene, flags=pyrender.constants.RenderFlags.DEPTH_ONLY)
        r.delete()
        heights = np.where(depth == 0, 0, 10 - depth)
        self.assertAlmostEqual(heights.max(), 1.0, places=5)
        self.assertEqual((heights > 0.5).sum(), 32 * 32)

    def test_raymond_lights(self):
        """three directional lights around the camera as nodes with matrices"""
        from pyrender.light import DirectionalLight
        from pyrender.node import Node

        thetas, phis, nodes = np.pi * np.array([1.0 / 6.0] * 3), np.pi * np.array([0.0, 2.0 / 3.0, 4.0 / 3.0]), []
        for phi, theta in zip(phis, thetas):
            z = np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
            x = np.array([-z[1], z[0], 0.0])
            x = np.array([1.0, 0.0, 0.0]) if np.linalg.norm(x) == 0 else x / np.linalg.norm(x)
            matrix = np.eye(4)
            matrix[:3, :3] = np.c_[x, np.cross(z, x), z]
            nodes.append(Node(light=DirectionalLight(color=np.ones(3), intensity=1.0), matrix=matrix))
        scene = pyrender.Scene(bg_color=[0, 0, 0])
        for node in nodes:
            scene.add_node(node)
        scene.add_node(Node(mesh=pyrender.Mesh.from_trimesh(Ball()), translation=np.array([0.0, 0.0, 0.0])))
        scene.add_node(Node(camera=self.intrinsics(), translation=[0, 0, 5]))
        color, _ = pyrender.OffscreenRenderer(SIZE, SIZE).render(scene)
        self.assertEqual(len(scene.directional_light_nodes), 3)
        self.assertGreater(color[32, 32].min(), 60)

    def test_trimesh_scene(self):
        """a scene of trimesh becomes one of pyrender"""

        class Graph(dict):
            nodes_geometry = property(lambda self: list(self))

        class TrimeshScene:
            geometry = {"ball": Ball(0.2), "box": Box()}
            graph = Graph({"a": (pose(1), "ball"), "b": (pose(-1), "ball"), "c": (pose(0, 1), "box")})

        scene = pyrender.Scene.from_trimesh_scene(TrimeshScene(), bg_color=[0.1, 0.2, 0.3], ambient_light=[0.02, 0.02, 0.02])
        self.assertEqual((len(scene.mesh_nodes), len(scene.meshes)), (3, 2))
        np.testing.assert_allclose(scene.bounds[:, 0], [-1.2, 1.2])

    def test_texture(self):
        """a picture on a wall, from an image of four channels of which three are used"""
        image = np.zeros((8, 8, 4), np.uint8)
        image[:4, :, 0], image[4:, :, 1] = 255, 255
        tex = pyrender.Texture(source=image, source_channels="RGB")
        material = pyrender.material.MetallicRoughnessMaterial(baseColorTexture=tex, metallicFactor=0.0)
        corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=np.float32)
        prim = pyrender.primitive.Primitive(
            positions=corners, indices=np.array([[0, 1, 2], [0, 2, 3]]), texcoord_0=np.array([[0, 0], [1, 0], [1, 1], [0, 1]]),
            material=material, mode=pyrender.constants.GLTF.TRIANGLES,
        )  # fmt: skip
        scene = pyrender.Scene()
        scene.add(pyrender.Mesh(primitives=[prim], is_visible=True))
        scene.add(self.intrinsics(), pose=pose(0, 0, 3))
        color, depth = pyrender.OffscreenRenderer(SIZE, SIZE).render(scene, flags=pyrender.RenderFlags.FLAT)
        self.assertEqual((color[24, 32].tolist(), color[40, 32].tolist(), depth[32, 32]), ([255, 0, 0], [0, 255, 0], 3))

    def test_talking_head(self):
        """a head with the default material of scripts, drawn from both sides, as BGR for OpenCV"""
        primitive_material = pyrender.material.MetallicRoughnessMaterial(
            alphaMode="BLEND", baseColorFactor=[0.3, 0.3, 0.3, 1.0], metallicFactor=0.8, roughnessFactor=0.8
        )
        mesh = pyrender.Mesh.from_trimesh(Ball(0.1), material=primitive_material, smooth=True)
        scene = pyrender.Scene(ambient_light=[0.2, 0.2, 0.2], bg_color=[255, 255, 255])
        scene.add(mesh, pose=np.eye(4))
        scene.add(self.intrinsics(znear=0.01, zfar=10), pose=pose(0, 0, 0.5))
        light = pyrender.PointLight(color=np.array([0.0, 0.4, 1.0]), intensity=1.5)
        for angle in (0, np.pi / 6, -np.pi / 6):
            scene.add(light, pose=pose(math.sin(angle), 0, math.cos(angle)))
        flags = pyrender.RenderFlags.SKIP_CULL_FACES
        try:
            r = pyrender.OffscreenRenderer(viewport_width=SIZE, viewport_height=SIZE)
            color, _ = r.render(scene, flags=flags)
        except Exception:
            color = np.zeros((SIZE, SIZE, 3), dtype="uint8")
        bgr = color[..., ::-1]
        self.assertGreater(int(bgr[32, 32, 0]), int(bgr[32, 32, 2]) + 30)
        self.assertEqual(bgr[0, 0].tolist(), [255, 255, 255])

    def test_alpha_over_photo(self):
        """a body is put over a photo by alpha, and by alpha > 0"""
        scene = pyrender.Scene(bg_color=[0.0, 0.0, 0.0, 0.0], ambient_light=(0.3, 0.3, 0.3))
        scene.add(pyrender.Mesh.from_trimesh(Ball(0.5)))
        scene.add(self.intrinsics(), pose=pose(0, 0, 3))
        scene.add(pyrender.DirectionalLight(intensity=3.0), pose=pose(0, 0, 3))
        rgb, _ = pyrender.OffscreenRenderer(SIZE, SIZE).render(scene, flags=pyrender.RenderFlags.RGBA)
        valid_mask = (rgb[:, :, -1] > 0)[:, :, np.newaxis]
        output = rgb[:, :, :-1] * valid_mask + (1 - valid_mask) * np.full((SIZE, SIZE, 3), 99)
        self.assertEqual(output[0, 0].tolist(), [99, 99, 99])
        self.covers(rgb[:, :, 3] / 255, disc_share(0.5, 3))

    def test_scan(self):
        """points of a scan, computed from the depth, lie on the surface"""
        fov = 1.0472
        camera = pyrender.PerspectiveCamera(yfov=fov, aspectRatio=1.0, znear=1.0, zfar=3.0)
        scene = pyrender.Scene()
        scene.add(pyrender.Mesh.from_trimesh(Ball(1.0, 48), smooth=False))
        transform = pose(0, 0, 2)
        scene.add(camera, pose=transform)
        color, depth = pyrender.OffscreenRenderer(100, 100).render(scene, flags=pyrender.constants.RenderFlags.SKIP_CULL_FACES)
        indices = np.argwhere(depth != 0)
        points = np.ones((indices.shape[0], 4))
        points[:, :2] = (2 * (indices[:, [1, 0]] + 0.5) / 100 - 1) * [1, -1] * math.tan(fov / 2)
        points[:, :3] = np.c_[points[:, :2], -np.ones(len(points))] * depth[depth != 0][:, None]
        points = (transform @ points.T).T[:, :3]
        np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1, atol=0.004)

    def test_grippers(self):
        """wireframes of grippers over an object: wireframe=True of from_trimesh, and flipped by a flag"""
        scene = pyrender.Scene(ambient_light=[1.0, 1.0, 1.0], bg_color=[0, 0, 0])
        material = pyrender.MetallicRoughnessMaterial(baseColorFactor=[0.0, 1.0, 0.0, 1.0])
        scene.add(pyrender.Mesh.from_trimesh(Box(), material=material, wireframe=True, smooth=False))
        scene.add(self.intrinsics(), pose=pose(0, 0, 3))
        r = pyrender.OffscreenRenderer(SIZE, SIZE)
        wire, solid = (r.render(scene, flags)[0][:, :, 1] > 100 for flags in (0, pyrender.RenderFlags.FLIP_WIREFRAME))
        self.assertTrue(0 < wire.sum() < solid.sum() / 2)
        self.assertFalse(material.wireframe)

    def test_moving(self):
        """one scene, whose object and camera move by set_pose for each frame"""
        scene = pyrender.Scene()
        node = scene.add(pyrender.Mesh.from_trimesh(Box()))
        cam = scene.add(self.intrinsics())
        r = pyrender.OffscreenRenderer(SIZE, SIZE)
        for distance in (3.0, 4.0, 5.0):
            scene.set_pose(cam, pose=pose(0, 0, distance))
            scene.set_pose(node, pose=pose(0, 0, 0.5))
            self.assertAlmostEqual(r.render(scene)[1][32, 32], distance - 1, places=5)

    def test_cameras(self):
        """several cameras, one after the other the main one; the viewport changes"""
        scene = pyrender.Scene()
        scene.add(pyrender.Mesh.from_trimesh(Box()))
        nodes = [scene.add(pyrender.PerspectiveCamera(yfov=1.0), name=f"camera{z}", pose=pose(0, 0, z)) for z in (2.0, 3.0)]
        r = pyrender.OffscreenRenderer(32, 24)
        for node, wanted in zip(nodes, (1.5, 2.5)):
            scene.main_camera_node = node
            r.viewport_width, r.viewport_height = 40, 30
            depth = r.render(scene)[1]
            self.assertEqual((depth.shape, round(float(depth[15, 20]), 5)), ((30, 40), wanted))
        scene.remove_node(nodes[1])
        self.assertIs(scene.main_camera_node, nodes[0])

    def test_cloud(self):
        """a coloured cloud with large points, flat, and by ambient light alone"""
        points, colors = np.random.default_rng(1).uniform(-0.5, 0.5, (50, 3)), np.tile([0.2, 0.4, 0.6], (50, 1))
        m = pyrender.Mesh.from_points(points, colors=colors)
        scene = pyrender.Scene(bg_color=[0, 0, 0], ambient_light=[1.0, 1.0, 1.0])
        scene.add(m)
        scene.add(self.intrinsics(), pose=pose(0, 0, 3))
        r = pyrender.OffscreenRenderer(SIZE, SIZE, point_size=3.0)
        color, depth = r.render(scene, pyrender.RenderFlags.FLAT)
        self.assertEqual(color.max(axis=(0, 1)).tolist(), [51, 102, 153])
        self.assertTrue(200 < (depth > 0).sum() <= 450)
        lit = r.render(scene)[0].max(axis=(0, 1))
        np.testing.assert_allclose(lit, 255 * np.array([0.2, 0.4, 0.6]) ** (1 / 2.2), atol=4)

    def test_robot(self):
        """links of a robot hang on one another; fingers are found by name and moved"""
        scene = pyrender.Scene()
        base = pyrender.Node(name="base", mesh=pyrender.Mesh.from_trimesh(Box()))
        turn = [0, 0, math.sin(np.pi / 4), math.cos(np.pi / 4)]
        arm = pyrender.Node(name="arm", mesh=pyrender.Mesh.from_trimesh(Box()), translation=[0, 2, 0], rotation=turn)
        base.children.append(arm)
        scene.add_node(base)
        scene.add(pyrender.Mesh.from_trimesh(Ball(0.1)), name="finger", pose=pose(1), parent_name="arm")
        finger = list(scene.get_nodes(name="finger"))[0]
        np.testing.assert_allclose(scene.get_pose(finger)[:3, 3], [0, 3, 0], atol=1e-12)
        base.translation = base.translation + np.array([1.0, 0, 0])
        np.testing.assert_allclose(scene.get_pose(finger)[:3, 3], [1, 3, 0], atol=1e-12)
        scene.remove_node(arm)
        self.assertEqual(scene.nodes, {base})

    def test_spot(self):
        """the documented example with a spot light at the camera; shadows are asked for"""
        scene = pyrender.Scene(bg_color=np.zeros(4), ambient_light=[0.02, 0.02, 0.02, 1.0])
        scene.add(pyrender.Mesh.from_trimesh(Ball(0.5)))
        scene.add(self.intrinsics(), pose=pose(0, 0, 2))
        spot_l = pyrender.SpotLight(color=np.ones(3), intensity=10.0, innerConeAngle=np.pi / 16, outerConeAngle=np.pi / 6)
        scene.add(spot_l, pose=pose(0, 0, 2))
        color, _ = pyrender.OffscreenRenderer(viewport_width=SIZE, viewport_height=SIZE).render(
            scene, flags=pyrender.RenderFlags.SHADOWS_SPOT
        )
        self.assertGreater(color[32, 32].max(), 100)

    def test_clothes(self):
        """clothes of alpha below 1 over a body: both are seen, and the depth is that of the clothes"""
        cloth = pyrender.MetallicRoughnessMaterial(alphaMode="BLEND", baseColorFactor=(1.0, 0.0, 0.0, 0.6), doubleSided=True)
        skin = pyrender.MetallicRoughnessMaterial(alphaMode="OPAQUE", baseColorFactor=(0.0, 0.0, 1.0, 1.0))
        scene = pyrender.Scene(bg_color=[1.0, 1.0, 1.0, 1.0])
        scene.add(pyrender.Mesh.from_trimesh(Ball(0.6), material=cloth))
        scene.add(pyrender.Mesh.from_trimesh(Ball(0.3), material=skin))
        scene.add(self.intrinsics(), pose=pose(0, 0, 3))
        color, depth = pyrender.OffscreenRenderer(SIZE, SIZE).render(scene, pyrender.RenderFlags.FLAT)
        self.assertTrue(color[32, 32, 0] > 100 and color[32, 32, 2] > 50)
        self.assertAlmostEqual(depth[32, 32], 2.4, delta=0.01)
        self.covers(depth > 0, disc_share(0.6, 3))

    def test_chessboard(self):
        """a floor of coloured faces, whose colours are floats of three channels"""
        corners = np.array([[x, 0, z] for x in range(5) for z in range(5)], float) - [2, 1, 2]
        faces = np.array([[5 * i + j, 5 * i + j + 1, 5 * i + j + 6, 5 * i + j + 5] for i in range(4) for j in range(4)])
        shade = np.repeat([[(i + j) % 2 * 0.8 + 0.1] * 3 for i in range(4) for j in range(4)], 6, axis=0)
        vertices = corners[faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1)]
        floor = pyrender.Primitive(positions=vertices, color_0=shade, normals=np.tile([0, 1.0, 0], (len(vertices), 1)), mode=4)
        scene = pyrender.Scene(bg_color=[0.5, 0.5, 0.5])
        scene.add(pyrender.Mesh([floor]))
        scene.add(self.intrinsics(), pose=pose(0, 0, 4))
        color, _ = pyrender.OffscreenRenderer(SIZE, SIZE).render(scene, pyrender.RenderFlags.FLAT)
        self.assertLessEqual({26, 128, 230} - set(np.unique(color).tolist()), set())
