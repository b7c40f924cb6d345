"""zraster.pyrender: the documented example, depth, flags, scenes; and signatures beside the original's."""
import inspect
import math
import unittest
import warnings

import zraster
from support import needs_numpy, numpy

# pyrender 0.1.45: the parameters of its public functions, without self.
SIGNATURES = {
    "Scene": "nodes bg_color ambient_light name",
    "Scene.add": "obj name pose parent_node parent_name",
    "Scene.get_nodes": "node name obj obj_name",
    "Scene.add_node": "node parent_node",
    "Scene.has_node": "node",
    "Scene.remove_node": "node",
    "Scene.get_pose": "node",
    "Scene.set_pose": "node pose",
    "Scene.clear": "",
    "Scene.from_trimesh_scene": "trimesh_scene bg_color ambient_light",
    "Node": "name camera children skin matrix mesh rotation scale translation weights light",
    "Mesh": "primitives name weights is_visible",
    "Mesh.from_points": "points colors normals is_visible poses",
    "Mesh.from_trimesh": "mesh material is_visible poses wireframe smooth",
    "Primitive": "positions normals tangents texcoord_0 texcoord_1 color_0 joints_0 weights_0 indices material mode "
    "targets poses",
    "Material": "name normalTexture occlusionTexture emissiveTexture emissiveFactor alphaMode alphaCutoff doubleSided "
    "smooth wireframe",
    "MetallicRoughnessMaterial": "name normalTexture occlusionTexture emissiveTexture emissiveFactor alphaMode "
    "alphaCutoff doubleSided smooth wireframe baseColorFactor baseColorTexture metallicFactor roughnessFactor "
    "metallicRoughnessTexture",
    "Texture": "name sampler source source_channels width height tex_type data_format",
    "Sampler": "name magFilter minFilter wrapS wrapT",
    "Camera": "znear zfar name",
    "PerspectiveCamera": "yfov znear zfar aspectRatio name",
    "OrthographicCamera": "xmag ymag znear zfar name",
    "IntrinsicsCamera": "fx fy cx cy znear zfar name",
    "PerspectiveCamera.get_projection_matrix": "width height",
    "Light": "color intensity name",
    "DirectionalLight": "color intensity name",
    "PointLight": "color intensity range name",
    "SpotLight": "color intensity range innerConeAngle outerConeAngle name",
    "OffscreenRenderer": "viewport_width viewport_height point_size",
    "OffscreenRenderer.render": "scene flags seg_node_map",
    "OffscreenRenderer.delete": "",
}
PROPERTIES = {
    "Scene": "nodes bg_color ambient_light meshes mesh_nodes lights light_nodes point_lights point_light_nodes "
    "spot_lights spot_light_nodes directional_lights directional_light_nodes cameras camera_nodes main_camera_node "
    "bounds centroid extents scale",
    "Node": "matrix rotation scale translation",
    "Mesh": "bounds centroid extents scale is_transparent",
    "Primitive": "bounds centroid extents scale is_transparent",
}
FLAGS = {"NONE": 0, "DEPTH_ONLY": 1, "OFFSCREEN": 2, "FLIP_WIREFRAME": 4, "ALL_WIREFRAME": 8, "ALL_SOLID": 16,
         "SHADOWS_DIRECTIONAL": 32, "SHADOWS_POINT": 64, "SHADOWS_SPOT": 128, "SHADOWS_ALL": 224, "VERTEX_NORMALS": 256,
         "FACE_NORMALS": 512, "SKIP_CULL_FACES": 1024, "RGBA": 2048, "FLAT": 4096, "SEG": 8192}  # fmt: skip


class Visual:
    """A stand-in for trimesh.visual."""

    def __init__(self, kind=None, **values):
        self.kind, self.defined = kind, kind is not None
        self.__dict__.update(values)


class Box:
    """A stand-in for trimesh.creation.box."""

    def __init__(self, visual=None):
        corners = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
        quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        self.vertices = numpy.array(corners)
        self.faces = numpy.array([[(q[0], q[1], q[2]), (q[0], q[2], q[3])] for q in quads]).reshape(-1, 3)
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        normals = numpy.cross(b - a, c - a)
        self.face_normals = normals / numpy.linalg.norm(normals, axis=1, keepdims=True)
        self.vertex_normals = self.vertices / numpy.linalg.norm(self.vertices, axis=1, keepdims=True)
        self.visual = visual or Visual()


def pose(x=0, y=0, z=0):
    made = numpy.eye(4)
    made[:3, 3] = x, y, z
    return made


@needs_numpy
class Pyrender(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        import zraster.pyrender as pyrender

        cls.p = pyrender
        cls.renderer = pyrender.OffscreenRenderer(80, 60)

    def scene(self, camera=None, **options):
        """Returns a scene with a box 5 m in front of the camera and a light, and the box's node."""
        scene = self.p.Scene(**options)
        node = scene.add(self.p.Mesh.from_trimesh(Box(), smooth=False))
        scene.add(camera or self.p.PerspectiveCamera(yfov=math.pi / 3), pose=pose(z=5))
        scene.add(self.p.DirectionalLight(color=[1.0, 1.0, 1.0], intensity=3.0), pose=pose(z=5))
        return scene, node

    def test_signatures(self):
        """functions take the original's parameters"""
        for name, wanted in SIGNATURES.items():
            found = self.p
            for part in name.split("."):
                found = getattr(found, part)
            parameters = [one for one in inspect.signature(found).parameters if one != "self"]
            self.assertEqual(parameters, wanted.split(), name)
        for name, wanted in PROPERTIES.items():
            for attribute in wanted.split():
                self.assertTrue(hasattr(getattr(self.p, name), attribute), f"{name}.{attribute}")
        flags = {name: value for name, value in vars(self.p.RenderFlags).items() if name.isupper()}
        self.assertEqual(flags, FLAGS)
        with self.assertRaisesRegex(NotImplementedError, "opens no window"):
            self.p.Viewer(self.p.Scene())

    def test_example(self):
        """the documented example draws colour and depth"""
        pyrender, np = self.p, numpy
        mesh = pyrender.Mesh.from_trimesh(Box())
        scene = pyrender.Scene()
        scene.add(mesh)
        camera = pyrender.PerspectiveCamera(yfov=np.pi / 3.0, aspectRatio=1.0)
        s = np.sqrt(2) / 2
        camera_pose = np.array([[0.0, -s, s, 0.3], [1.0, 0.0, 0.0, 0.0], [0.0, s, s, 0.35], [0.0, 0.0, 0.0, 1.0]])
        camera_pose[:3, 3] *= 4
        scene.add(camera, pose=camera_pose)
        light = pyrender.SpotLight(
            color=np.ones(3), intensity=3.0, innerConeAngle=np.pi / 16.0, outerConeAngle=np.pi / 6.0
        )
        scene.add(light, pose=camera_pose)
        r = pyrender.OffscreenRenderer(400, 400)
        color, depth = r.render(scene)
        r.delete()
        self.assertEqual((color.shape, color.dtype.name), ((400, 400, 3), "uint8"))
        self.assertEqual((depth.shape, depth.dtype.name), ((400, 400), "float32"))
        self.assertEqual(depth[0, 0], 0)
        self.assertTrue((color[0, 0] == 255).all())
        self.assertTrue(0.5 < depth[200, 200] < 2)
        self.assertTrue(20 < color[200, 200].max() < 255)

    def test_depth(self):
        """depth is in metres for each camera, bit-equal to the renderer's own, and 0 for background pixels"""
        p = self.p
        cameras = [
            (p.PerspectiveCamera(yfov=1.0), {"perspective": {"yfov": 1.0}, "znear": 0.05, "zfar": 100}),
            (p.PerspectiveCamera(yfov=1.0, zfar=20.0), {"perspective": {"yfov": 1.0}, "znear": 0.05, "zfar": 20}),
            (p.OrthographicCamera(3.0, 1.0), {"orthographic": {"xmag": 80 / 60, "ymag": 1}, "zfar": 100}),
            (p.IntrinsicsCamera(50, 60, 41, 29), {"intrinsics": {"fx": 50, "fy": 60, "cx": 41, "cy": 29}}),
        ]
        box = Box()
        for camera, projection in cameras:
            scene, _ = self.scene(camera)
            place = pose(0.3, 0.2, 5)
            scene.set_pose(scene.main_camera_node, place)
            color, depth = self.renderer.render(scene)
            numpy.testing.assert_array_equal(self.renderer.render(scene, p.RenderFlags.DEPTH_ONLY), depth)
            given = {"meshes": [{"positions": box.vertices, "faces": box.faces}], "window": {"width": 80, "height": 60}}
            if hasattr(camera, "yfov") and camera.zfar is None:
                matrix = camera.get_projection_matrix(80, 60).tolist()
                own = zraster.render({**given, "view": {"cameraToWorld": place, "projectionMatrix": matrix}}, "depth")
                numpy.testing.assert_array_equal(numpy.where(numpy.isinf(own["depth"]), 0, own["depth"]), depth)
            own = zraster.render({**given, "view": {"cameraToWorld": place, **projection}}, "depth")["depth"]
            nothing = numpy.isinf(own)
            numpy.testing.assert_array_equal(depth[nothing], 0)
            numpy.testing.assert_allclose(depth[~nothing], own[~nothing], rtol=1e-6)
            self.assertAlmostEqual(depth[30, 40], 4.5, places=5)

    def test_colors(self):
        """a lit face has the colour of pyrender's formula; the background stays"""
        material = self.p.MetallicRoughnessMaterial(
            baseColorFactor=[0.2, 0.4, 0.8, 1.0], metallicFactor=0, roughnessFactor=1
        )
        scene, node = self.scene(bg_color=[10, 20, 30])
        node.mesh = self.p.Mesh.from_trimesh(Box(), smooth=False, material=material)
        color, _ = self.renderer.render(scene)
        self.assertEqual(color[0, 0].tolist(), [10, 20, 30])
        # n = l = v: F = 0.04, G = 1, D = 1 / pi; diffuse (1 - F) 0.96 c / pi, specular F D / 4.001, times 3.
        light = 3 * (0.96 * 0.96 * numpy.array([0.2, 0.4, 0.8]) / math.pi + 0.04 / math.pi / 4.001)
        numpy.testing.assert_allclose(color[30, 40], light ** (1 / 2.2) * 255, atol=4)
        dark = self.p.Scene(ambient_light=[0.5, 0.5, 0.5])
        dark.add(node.mesh)
        dark.add(self.p.PerspectiveCamera(yfov=1.0), pose=pose(z=5))
        ambient = numpy.array([0.2, 0.4, 0.8]) * 0.5
        numpy.testing.assert_allclose(self.renderer.render(dark)[0][30, 40], ambient ** (1 / 2.2) * 255, atol=6)
        dark.ambient_light = [0, 0, 0]
        self.assertEqual(self.renderer.render(dark)[0][30, 40].tolist(), [0, 0, 0])

    def test_flags(self):
        """RGBA, FLAT, SEG, culling, wireframes and shadows"""
        flags = self.p.RenderFlags
        scene, node = self.scene(bg_color=[0.0, 0.0, 0.0, 0.0])
        other = scene.add(self.p.Mesh.from_trimesh(Box(), smooth=False), pose=pose(1.2))
        color, depth = self.renderer.render(scene, flags.RGBA)
        self.assertEqual(color.shape, (60, 80, 4))
        self.assertEqual((color[0, 0].tolist(), color[30, 40, 3]), ([0, 0, 0, 0], 255))
        flat, _ = self.renderer.render(scene, flags.FLAT)
        self.assertEqual(flat[30, 40].tolist(), [76, 76, 76])  # 0.3, as given
        seg, seg_depth = self.renderer.render(scene, flags.SEG, {node: (255, 0, 7), other: 9})
        self.assertEqual({tuple(c) for c in seg.reshape(-1, 3).tolist()}, {(0, 0, 0), (255, 0, 7), (9, 9, 9)})
        numpy.testing.assert_array_equal(seg_depth, depth)
        self.assertEqual(seg[30, 40].tolist(), [255, 0, 7])
        only, only_depth = self.renderer.render(scene, flags.SEG, {other: 9})
        self.assertEqual((only[30, 40].tolist(), only_depth[30, 40]), ([0, 0, 0], 0))
        none, none_depth = self.renderer.render(scene, flags.SEG)
        self.assertEqual((none.any(), none_depth.any()), (False, False))
        scene.set_pose(scene.main_camera_node, pose(z=0.1))  # within the box: its sides are culled
        self.assertFalse(self.renderer.render(scene)[1][30, 40])
        self.assertTrue(self.renderer.render(scene, flags.SKIP_CULL_FACES)[1][30, 40])
        scene.set_pose(scene.main_camera_node, pose(z=5))
        wire, _ = self.renderer.render(scene, flags.ALL_WIREFRAME | flags.RGBA)
        self.assertTrue(0 < (wire[:, :, 3] > 0).sum() < (color[:, :, 3] > 0).sum())
        self.renderer.render(scene, flags.SHADOWS_DIRECTIONAL | flags.SHADOWS_SPOT)
        scene.add(self.p.PointLight(intensity=2.0))
        with self.assertRaisesRegex(
            NotImplementedError, "point lights have no shadows, here as in pyrender: leave out SHADOWS_POINT"
        ):
            self.renderer.render(scene, flags.SHADOWS_ALL)
        with self.assertWarns(zraster.Warning):
            self.renderer.render(scene, flags.VERTEX_NORMALS)

    def test_shadows(self):
        """a box casts a shadow on a floor"""
        scene, node = self.scene()
        floor = self.p.Mesh([self.p.Primitive([[-9, -9, -2], [9, -9, -2], [9, 9, -2], [-9, 9, -2]],
                                              normals=[[0, 0, 1]] * 4, indices=[0, 1, 2, 0, 2, 3])])  # fmt: skip
        scene.add(floor)
        light = scene.directional_light_nodes.pop()
        tilted = pose(2, 0, 5)
        tilted[:3, 0], tilted[:3, 2] = (0.8, 0, -0.6), (0.6, 0, 0.8)
        scene.set_pose(light, tilted)
        lit, _ = self.renderer.render(scene)
        dark, _ = self.renderer.render(scene, self.p.RenderFlags.SHADOWS_DIRECTIONAL)
        self.assertGreater((dark.astype(int) < lit.astype(int) - 50).sum(), 50)

    def test_meshes(self):
        """vertex and face colours, points, lines, strips, instances and textures are drawn"""
        p, count = self.p, 36
        renderer = p.OffscreenRenderer(80, 60, point_size=4)

        def draw(mesh, flags=p.RenderFlags.FLAT):
            scene = p.Scene(bg_color=[0, 0, 0, 1.0])
            scene.add(mesh)
            scene.add(p.PerspectiveCamera(yfov=1.0), pose=pose(z=3))
            return renderer.render(scene, flags)

        faces = numpy.tile(numpy.uint8([10, 200, 30, 255]), (12, 1))
        box = Box(Visual("face", face_colors=faces))
        self.assertEqual(draw(p.Mesh.from_trimesh(box, smooth=False))[0][30, 40].tolist(), [10, 200, 30])
        with self.assertRaises(ValueError):
            p.Mesh.from_trimesh(box)
        box = Box(Visual("vertex", vertex_colors=numpy.tile(numpy.uint8([10, 200, 30, 255]), (8, 1))))
        self.assertEqual(draw(p.Mesh.from_trimesh(box))[0][30, 40].tolist(), [10, 200, 30])
        cloud = p.Mesh.from_points([[0, 0, 0], [0.5, 0, 0]], colors=[[255, 0, 0], [0, 255, 0]])
        color, depth = draw(cloud)
        self.assertEqual((color.any(axis=2).sum(), (depth == 3).sum()), (32, 32))
        square = [[-1, -1, 0], [1, -1, 0], [-1, 1, 0], [1, 1, 0]]
        area = (draw(p.Mesh([p.Primitive(square, indices=[0, 1, 3, 0, 3, 2])]))[1] > 0).sum()
        for mode, indices in ((p.GLTF.TRIANGLE_STRIP, None), (p.GLTF.TRIANGLE_FAN, [0, 1, 3, 2])):
            self.assertEqual((draw(p.Mesh([p.Primitive(square, indices=indices, mode=mode)]))[1] > 0).sum(), area)
        for mode, fewest in ((p.GLTF.LINES, 40), (p.GLTF.LINE_STRIP, 100), (p.GLTF.LINE_LOOP, 140)):
            self.assertGreater((draw(p.Mesh([p.Primitive(square, mode=mode)]))[1] > 0).sum(), fewest)
        poses = numpy.stack([pose(x) * numpy.diag([0.1, 0.1, 0.1, 1]) + pose(x) - numpy.eye(4) for x in (-1, 0, 1)])
        poses[:, range(3), range(3)] = 0.2
        instances = draw(p.Mesh.from_trimesh(Box(), poses=poses))[1] > 0
        self.assertEqual([bool(instances[30, x]) for x in (22, 31, 40, 49, 58)], [True, False, True, False, True])
        texture = p.Texture(source=numpy.uint8([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]]),
                            sampler=p.Sampler(magFilter=p.GLTF.NEAREST, minFilter=p.GLTF.NEAREST))  # fmt: skip
        material = p.MetallicRoughnessMaterial(baseColorTexture=texture)
        textured = p.Primitive(
            square, texcoord_0=[[0, 0], [1, 0], [0, 1], [1, 1]], indices=[0, 1, 3, 0, 3, 2], material=material
        )
        color = draw(p.Mesh([textured]))[0]
        self.assertEqual(color[20, 30].tolist(), [255, 0, 0])  # the top left texel
        self.assertEqual(color[40, 30].tolist(), [0, 0, 255])
        glass = p.MetallicRoughnessMaterial(baseColorFactor=[1.0, 1.0, 1.0, 0.5], alphaMode="BLEND")
        self.assertEqual(draw(p.Mesh.from_trimesh(Box(), material=glass))[0][30, 40].tolist(), [128, 128, 128])
        self.assertEqual(count, 36)

    def test_textures(self):
        """textures that are not drawn are named by a warning at the caller's line; depth and flat colours need none"""
        p = self.p
        image = numpy.full((2, 2, 3), 200, "u1")
        names = ["normalTexture", "occlusionTexture", "emissiveTexture", "metallicRoughnessTexture"]

        def warned(flags, **textures):
            scene = p.Scene()
            scene.add(p.Mesh.from_trimesh(Box(), material=p.MetallicRoughnessMaterial(**textures)))
            scene.add(p.PerspectiveCamera(yfov=1.0), pose=pose(z=3))
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                self.renderer.render(scene, flags)
            self.assertTrue(all(one.filename == __file__ and one.category is zraster.Warning for one in caught))
            return [str(one.message) for one in caught]

        for name in names:
            wanted = [f"{name}: not drawn; baseColorTexture is the only texture that is"]
            self.assertEqual(warned(p.RenderFlags.NONE, **{name: image}), wanted)
        every = dict.fromkeys(names, image)
        self.assertEqual(len(warned(p.RenderFlags.NONE, **every)), 1)
        self.assertTrue(
            warned(p.RenderFlags.NONE, **every)[0].startswith("emissiveTexture, metallicRoughnessTexture, ")
        )
        for flags in (p.RenderFlags.DEPTH_ONLY, p.RenderFlags.FLAT, p.RenderFlags.SEG):
            self.assertEqual(warned(flags, **every), [])
        self.assertEqual(warned(p.RenderFlags.NONE), [])

    def test_scene(self):
        """nodes have parents, poses, names and bounds"""
        p = self.p
        scene, node = self.scene()
        child = scene.add(p.Mesh.from_trimesh(Box()), name="child", pose=pose(1), parent_node=node)
        scene.set_pose(node, pose(0, 2))
        numpy.testing.assert_array_equal(scene.get_pose(child), pose(1, 2))
        self.assertEqual(scene.get_nodes(name="child"), {child})
        self.assertEqual(scene.get_nodes(obj=child.mesh), {child})
        numpy.testing.assert_allclose(scene.bounds, [[-0.5, 1.5, -0.5], [1.5, 2.5, 0.5]])
        self.assertEqual((len(scene.nodes), len(scene.meshes), len(scene.lights)), (4, 2, 1))
        scene.remove_node(node)
        self.assertFalse(scene.has_node(child))
        with self.assertRaises(ValueError):
            scene.get_pose(child)
        color, depth = self.renderer.render(scene)  # nothing is left
        self.assertTrue((color == 255).all() and not depth.any())
        scene.clear()
        with self.assertRaisesRegex(ValueError, "without a camera"):
            self.renderer.render(scene)
        turned = p.Node(rotation=[0, 0, math.sin(0.5), math.cos(0.5)], scale=[1, 2, 3], translation=[4, 5, 6])
        numpy.testing.assert_allclose(turned.matrix @ [1, 0, 0, 1], [math.cos(1) + 4, math.sin(1) + 5, 6, 1])
        copy = p.Node(matrix=turned.matrix)
        numpy.testing.assert_allclose(copy.rotation, turned.rotation, atol=1e-12)
        numpy.testing.assert_allclose(copy.scale, [1, 2, 3])

    def test_quiet(self):
        """calls of which the original does not warn are silent"""
        scene = self.p.Scene()
        scene.add(self.p.Mesh.from_trimesh(Box()), pose=pose(99))
        scene.add(self.p.PerspectiveCamera(yfov=0.5), pose=pose(z=3))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            color, depth = self.renderer.render(scene)
        self.assertFalse(depth.any())
