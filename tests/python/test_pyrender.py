"""zraster.pyrender: the documented example, depth, flags, scenes; and signatures beside the original's."""
import importlib
import inspect
import math
import os
import subprocess
import sys
import tempfile
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
    "SpecularGlossinessMaterial": "name normalTexture occlusionTexture emissiveTexture emissiveFactor alphaMode "
    "alphaCutoff doubleSided smooth wireframe diffuseFactor diffuseTexture specularFactor glossinessFactor "
    "specularGlossinessTexture",
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
    "Renderer": "viewport_width viewport_height point_size",
    "Trackball": "pose size scale target",
    "OffscreenRenderer": "viewport_width viewport_height point_size",
    "OffscreenRenderer.render": "scene flags seg_node_map",
    "OffscreenRenderer.delete": "",
}
PROPERTIES = {
    "Scene": "nodes bg_color ambient_light meshes mesh_nodes lights light_nodes point_lights point_light_nodes "
    "spot_lights spot_light_nodes directional_lights directional_light_nodes cameras camera_nodes main_camera_node "
    "bounds centroid extents scale",
    "Node": "matrix rotation scale translation",
    "Material": "is_transparent textures tex_flags",
    "OffscreenRenderer": "viewport_width viewport_height point_size",
    "Mesh": "bounds centroid extents scale is_transparent",
    "Primitive": "bounds centroid extents scale is_transparent buf_flags",
}
FLAGS = {"NONE": 0, "DEPTH_ONLY": 1, "OFFSCREEN": 2, "FLIP_WIREFRAME": 4, "ALL_WIREFRAME": 8, "ALL_SOLID": 16,
         "SHADOWS_DIRECTIONAL": 32, "SHADOWS_POINT": 64, "SHADOWS_SPOT": 128, "SHADOWS_ALL": 224, "VERTEX_NORMALS": 256,
         "FACE_NORMALS": 512, "SKIP_CULL_FACES": 1024, "RGBA": 2048, "FLAT": 4096, "SEG": 8192}  # fmt: skip


# Values that setters refuse, as pyrender's do: the object, the attribute, the value and the exception.
BAD_VALUES = [
    ("PerspectiveCamera(1.0)", "yfov", 0.0, ValueError),
    ("PerspectiveCamera(1.0)", "znear", -1.0, ValueError),
    ("PerspectiveCamera(1.0)", "zfar", 0.05, ValueError),
    ("PerspectiveCamera(1.0)", "aspectRatio", -1.0, ValueError),
    ("OrthographicCamera(1.0, 1.0)", "znear", 0.0, ValueError),
    ("OrthographicCamera(1.0, 1.0)", "znear", None, TypeError),
    ("OrthographicCamera(1.0, 1.0)", "zfar", 0.01, ValueError),
    ("OrthographicCamera(1.0, 1.0)", "xmag", 0.0, ValueError),
    ("OrthographicCamera(1.0, 1.0)", "ymag", None, TypeError),
    ("IntrinsicsCamera(9, 9, 4, 4)", "fx", None, TypeError),
    ("DirectionalLight()", "color", None, ValueError),
    ("DirectionalLight()", "color", [[1.0, 1.0, 1.0], [1.0, 1.0, 1.0]], ValueError),
    ("DirectionalLight()", "intensity", None, TypeError),
    ("PointLight()", "range", 0.0, ValueError),
    ("SpotLight()", "range", -1.0, ValueError),
    ("SpotLight()", "innerConeAngle", 1.0, ValueError),
    ("SpotLight()", "innerConeAngle", -0.1, ValueError),
    ("SpotLight()", "outerConeAngle", 3.0, ValueError),
    ("Material()", "alphaMode", "blend", ValueError),
    ("Material()", "alphaCutoff", 1.5, ValueError),
    ("Material()", "doubleSided", 1, TypeError),
    ("Material()", "smooth", None, TypeError),
    ("Material()", "wireframe", "yes", TypeError),
    ("Material()", "normalTexture", "map.png", TypeError),
    ("MetallicRoughnessMaterial()", "metallicFactor", 1.1, ValueError),
    ("MetallicRoughnessMaterial()", "roughnessFactor", -0.1, ValueError),
    ("MetallicRoughnessMaterial()", "baseColorTexture", [[1, 2], [3, 4]], TypeError),
    ("SpecularGlossinessMaterial()", "glossinessFactor", 2.0, ValueError),
    ("Primitive([[0, 0, 0]])", "normals", [0.0] * 10, ValueError),
    ("Primitive([[0, 0, 0]])", "tangents", [[0.0] * 3], ValueError),
    ("Primitive([[0, 0, 0]])", "texcoord_0", [[0.0]], ValueError),
    ("Primitive([[0, 0, 0]])", "texcoord_1", [[0.0] * 3], ValueError),
    ("Primitive([[0, 0, 0]])", "material", [1.0], TypeError),
    ("Primitive([[0, 0, 0]])", "mode", 10, ValueError),
    ("Primitive([[0, 0, 0]])", "poses", [[1, 0, 0], [0, 1, 0], [0, 0, 1]], ValueError),
    ("Node()", "camera", "front", TypeError),
    ("Node()", "mesh", "box", TypeError),
    ("Node()", "light", 3.0, TypeError),
    ("Node()", "rotation", [0, 0, 0, 2.0], ValueError),
    ("Node()", "rotation", [0, 0, 1], ValueError),
    ("Node()", "translation", [1, 2, 3, 4], ValueError),
    ("Node()", "scale", 2.0, ValueError),
    ("Node()", "matrix", [[1, 0, 0], [0, 1, 0], [0, 0, 1]], ValueError),
    ("Node()", "matrix", [[5, 0, 0, 0], [0, 5, 0, 0], [0, 0, 5, 0], [0, 0, 0, 5]], ValueError),
    ("Scene()", "bg_color", "white", ValueError),
    ("Scene()", "main_camera_node", None, ValueError),
]  # fmt: skip
MODULES = {
    "camera": "Camera PerspectiveCamera OrthographicCamera IntrinsicsCamera",
    "constants": "RenderFlags TextAlign GLTF BufFlags TexFlags ProgramFlags DEFAULT_Z_NEAR DEFAULT_Z_FAR "
    "DEFAULT_SCENE_SCALE MAX_N_LIGHTS FLOAT_SZ UINT_SZ SHADOW_TEX_SZ TEXT_PADDING MIN_OPEN_GL_MAJOR",
    "light": "Light DirectionalLight PointLight SpotLight",
    "material": "Material MetallicRoughnessMaterial SpecularGlossinessMaterial",
    "mesh": "Mesh",
    "node": "Node",
    "offscreen": "OffscreenRenderer",
    "primitive": "Primitive",
    "renderer": "Renderer",
    "sampler": "Sampler",
    "scene": "Scene",
    "texture": "Texture",
    "trackball": "Trackball",
    "utils": "format_color_vector format_color_array format_texture_source",
    "version": "__version__",
    "viewer": "Viewer",
}


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

    # ---- a square of 2 x 2 m in the plane z = 0, seen from z = 3 ----

    SQUARE = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]

    def square(self, material=None, **options):
        options = {"normals": [[0, 0, 1.0]] * 4, "indices": [[0, 1, 2], [0, 2, 3]], **options}
        return self.p.Primitive(self.SQUARE, texcoord_0=[[0, 0], [1, 0], [1, 1], [0, 1]], material=material, **options)

    def seen(self, *primitives, light=None, **options):
        """Returns a scene of a mesh of primitives, and its node."""
        scene = self.p.Scene(**options)
        node = scene.add(self.p.Mesh(list(primitives)))
        scene.add(self.p.PerspectiveCamera(yfov=1.0), pose=pose(z=3))
        if light:
            scene.add(light, pose=pose(z=3))
        return scene, node

    def draw(self, scene, flags=0, nodes=None):
        return self.p.OffscreenRenderer(64, 64, point_size=3).render(scene, flags, nodes)

    def material(self, **options):
        return self.p.MetallicRoughnessMaterial(**options)

    def test_textures(self):
        """all textures of a material change its colour, by the shape of their channels, without a warning"""
        p, half = self.p, numpy.full((2, 2), 100, "u1")
        tilted = numpy.zeros((2, 2, 3), "u1") + numpy.uint8([220, 128, 220])
        sun = p.DirectionalLight(intensity=2.0)

        def color(**options):
            material = self.material(baseColorFactor=[0.5, 0.5, 0.5, 1.0], metallicFactor=0.5, **options)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                return self.draw(self.seen(self.square(material), light=sun, ambient_light=[0.5] * 3)[0])[0][32, 32]

        plain = color()
        for name, image in (("baseColorTexture", half), ("occlusionTexture", half), ("normalTexture", tilted)):
            self.assertTrue((color(**{name: image}) < plain - 4).all(), name)
        self.assertTrue((color(emissiveTexture=half, emissiveFactor=[1.0, 1.0, 1.0]) > plain + 9).all())
        shiny = color(metallicRoughnessTexture=numpy.dstack([half] * 3))
        self.assertTrue((shiny != plain).all())
        numpy.testing.assert_array_equal(color(metallicRoughnessTexture=numpy.dstack([half, half])), shiny)
        with self.assertRaisesRegex(ValueError, "needs texcoord_0"):
            self.draw(self.seen(p.Primitive(self.SQUARE, material=self.material(baseColorTexture=half)))[0])
        gloss = p.SpecularGlossinessMaterial(diffuseFactor=[0.5, 0.5, 0.5, 1.0], glossinessFactor=0.2)
        same = self.material(baseColorFactor=[0.5, 0.5, 0.5, 1.0], metallicFactor=0.0, roughnessFactor=0.8)
        drawn = [self.draw(self.seen(self.square(one), light=sun)[0])[0] for one in (gloss, same)]
        numpy.testing.assert_array_equal(*drawn)
        gloss.specularGlossinessTexture = numpy.dstack([half] * 4)
        with self.assertWarnsRegex(zraster.Warning, "specularGlossinessTexture: not drawn") as caught:
            self.renderer.render(self.seen(self.square(gloss))[0])
        self.assertEqual(caught.filename, __file__)

    def test_channels(self):
        """a texture has the channels that it is asked for; missing ones are 255, or an error"""
        image = numpy.arange(2 * 2 * 4, dtype="u1").reshape(2, 2, 4)
        grey, pair = image[:, :, 0], image[:, :, :2]
        full = numpy.full_like(grey, 255)
        for source, channels, wanted in (
            (image, "R", grey), (image, "RG", pair), (image, "GB", image[:, :, 1:3]), (image, "RGB", image[:, :, :3]),
            (image, "RGBA", image), (image[:, :, :3], "RGBA", numpy.dstack([image[:, :, :3], full])),
            (grey, "RGB", numpy.dstack([grey] * 3)), (grey, "RGBA", numpy.dstack([grey, grey, grey, full])),
            (grey, "GB", numpy.dstack([grey] * 2)), (pair, "GB", pair), (image / 255.0, "RGBA", image),
        ):  # fmt: skip
            found = self.p.Texture(source=source, source_channels=channels).source
            numpy.testing.assert_allclose(found, wanted, atol=1, err_msg=channels)
        for source, channels in ((pair, "RGB"), (pair, "RGBA"), (image, "BGR"), (image[None], "RGB")):
            with self.assertRaises(ValueError):
                self.p.Texture(source=source, source_channels=channels)
        clear = self.material(alphaMode="BLEND", baseColorTexture=self.p.Texture(source=image, source_channels="RGB"))
        self.assertFalse(clear.is_transparent)
        self.assertEqual(self.draw(self.seen(self.square(clear))[0], self.p.RenderFlags.RGBA)[0][32, 32, 3], 255)

    def test_blended_depth(self):
        """blended surfaces have a depth, and one texel of alpha 254 changes no depth; the colour is blended"""
        p = self.p
        glass = self.material(alphaMode="BLEND", baseColorFactor=[1.0, 0, 0, 0.5])
        wall = p.Primitive([[x, y, -1] for x, y, _ in self.SQUARE], indices=[[0, 1, 2], [0, 2, 3]],
                           material=self.material(baseColorFactor=[0.0, 0, 1, 1]))  # fmt: skip
        scene, _ = self.seen(wall, self.square(glass))
        color, depth = self.draw(scene, p.RenderFlags.FLAT)
        self.assertEqual((color[32, 32].tolist(), depth[32, 32]), ([128, 0, 128], 3))
        numpy.testing.assert_array_equal(self.draw(scene, p.RenderFlags.DEPTH_ONLY), depth)
        image = numpy.full((8, 8, 4), 255, "u1")
        opaque = self.draw(self.seen(self.square(self.material(alphaMode="BLEND", baseColorTexture=image)))[0])[1]
        image[0, 0, 3] = 254
        texel = self.draw(self.seen(self.square(self.material(alphaMode="BLEND", baseColorTexture=image)))[0])[1]
        numpy.testing.assert_array_equal(texel, opaque)
        self.assertEqual(opaque[32, 32], 3)

    def test_masks(self):
        """MASK cuts what is below alphaCutoff, in colours, depth and SEG"""
        p, image = self.p, numpy.full((8, 8, 4), 255, "u1")
        image[:, 4:, 3] = 100
        scene, node = self.seen(self.square(self.material(alphaMode="MASK", baseColorTexture=image)), bg_color=[0.0] * 4)
        drawn = [self.draw(scene, p.RenderFlags.RGBA), self.draw(scene, p.RenderFlags.RGBA | p.RenderFlags.FLAT)]
        drawn += [self.draw(scene, p.RenderFlags.SEG | p.RenderFlags.RGBA, {node: 9})]
        for color, depth in drawn:
            self.assertEqual((depth[32, 20], depth[32, 44], color[32, 44, :3].any()), (3, 0, False))
        self.assertEqual(drawn[0][0][32, 44, 3], 0)
        node.mesh.primitives[0].material.alphaCutoff = 0.3
        self.assertEqual(self.draw(scene)[1][32, 44], 3)

    def test_background(self):
        """with RGBA, colours are in front of the background's colour, whatever its alpha: that of pixels without a mesh stays"""
        p = self.p
        for back in ([1.0, 1, 1, 0], [0.2, 0.4, 0.6, 0.0], [0.2, 0.4, 0.6, 0.5]):
            scene, _ = self.seen(self.square(self.material(baseColorFactor=[0.0, 0, 0, 1])), bg_color=back)
            scene.main_camera_node.matrix = pose(0.013, 0.021, 3)
            bytes_of = numpy.rint(numpy.array(back) * 255).tolist()
            color, _ = self.draw(scene, p.RenderFlags.RGBA)
            self.assertEqual((color[0, 0].tolist(), color[32, 32].tolist()), (bytes_of, [0, 0, 0, 255]))
            if back[3] == 0:  # the borders of the black square
                coverage = color[:, :, 3:] / 255
                numpy.testing.assert_allclose(color[:, :, :3], (1 - coverage) * bytes_of[:3], atol=2)
                self.assertTrue(((coverage > 0.2) & (coverage < 0.8)).any())
            self.assertEqual(self.draw(p.Scene(nodes=[p.Node(camera=p.PerspectiveCamera(1.0))], bg_color=back),
                                       p.RenderFlags.RGBA)[0][0, 0].tolist(), bytes_of)  # fmt: skip

    def test_lit_lines(self):
        """wireframes, lines and points have the light of faces, and none without lights; FLAT shows their colour"""
        p, flags = self.p, self.p.RenderFlags
        lights = [p.DirectionalLight(intensity=1.0), p.PointLight(intensity=9.0), p.SpotLight(intensity=9.0)]
        middle = [[-0.1, 0.0256, 0], [0.1, 0.0256, 0], [0, 0.1, 0], [0, -0.1, 0]]  # along the middles of pixels
        color = [[0.7, 1.0, 1.0]] * 4
        material = self.material(baseColorFactor=[0.9, 0.6, 0.3, 1.0], metallicFactor=0.4, roughnessFactor=0.7)
        kinds = [(p.GLTF.TRIANGLES, flags.ALL_WIREFRAME), (p.GLTF.LINES, 0), (p.GLTF.POINTS, 0)]
        for light in lights:
            scene, _ = self.seen(self.square(material, color_0=color), light=light, ambient_light=[0.1, 0, 0.05])
            wanted = self.draw(scene)[0][32, 32]
            for mode, flag in kinds:
                one = p.Primitive(middle, normals=[[0, 0, 1.0]] * 4, color_0=color, material=material, mode=mode)
                scene, _ = self.seen(one, light=light, ambient_light=[0.1, 0, 0.05], bg_color=[0.0, 0, 0])
                found = self.draw(scene, flag)[0].max(axis=(0, 1))
                numpy.testing.assert_allclose(found.astype(int), wanted, atol=6, err_msg=f"{light} {mode}")
                one.normals = None
                facing = self.draw(scene, flag)[0].max(axis=(0, 1))
                numpy.testing.assert_allclose(facing.astype(int), wanted, atol=6)
                dark, _ = self.seen(one, bg_color=[0.0, 0, 0])
                self.assertFalse(self.draw(dark, flag)[0].any())
                flat = self.draw(dark, flag | flags.FLAT)[0].max(axis=(0, 1))
                self.assertEqual(flat.tolist(), [161, 153, 76])

    def test_lit_instances(self):
        """instances of points are lit at their own places"""
        p = self.p
        poses = numpy.stack([pose(-0.5), pose(0.5)])
        cloud = p.Primitive([[0, 0, 0]], mode=p.GLTF.POINTS, poses=poses)
        scene, _ = self.seen(cloud, light=p.PointLight(intensity=1.0), bg_color=[0.0, 0, 0])
        scene.set_pose(next(iter(scene.light_nodes)), pose(-0.5, 0, 0.5))
        color = self.draw(scene)[0].max(axis=2)
        self.assertGreater(color[:, :32].max(), color[:, 32:].max() + 50)

    def test_setters(self):
        """setters refuse values with the exceptions of pyrender, also in constructors, and keep good ones"""
        for text, name, value, error in BAD_VALUES:
            one = eval(f"self.p.{text}", {"self": self})
            before = getattr(one, name)
            with self.assertRaises(error, msg=f"{text}.{name} = {value}"):
                setattr(one, name, value)
            self.assertIs(type(getattr(one, name)), type(before))
        for call in ("PerspectiveCamera()", "Camera()", "Mesh()", "Primitive()", "OrthographicCamera()"):
            with self.assertRaises(TypeError, msg=call):
                eval(f"self.p.{call}", {"self": self})
        with self.assertRaises(ValueError):
            self.p.Primitive([], mode=10)
        material = self.material(name=7, baseColorFactor=255, metallicFactor=None)
        self.assertEqual((material.name, material.metallicFactor), ("7", 1.0))
        self.assertEqual(material.baseColorFactor.tolist(), [1, 1, 1, 1])

    def test_modules(self):
        """after install, code imports pyrender and its modules; objects of both names are the same"""
        kept = {name: module for name, module in sys.modules.items() if name.split(".")[0] == "pyrender"}
        try:
            self.p.install()
            for module, names in MODULES.items():
                found = importlib.import_module("pyrender." + module)
                for name in names.split():
                    self.assertTrue(hasattr(found, name), f"{module}.{name}")
                    self.assertIs(getattr(found, name), getattr(getattr(self.p, module), name))
            self.assertIs(importlib.import_module("pyrender"), self.p)
        finally:
            for name in [name for name in sys.modules if name.split(".")[0] == "pyrender"]:
                del sys.modules[name]
            sys.modules.update(kept)

    def test_script(self):
        """python3 -m zraster.pyrender runs a script as it is, with its arguments and its folder"""
        text = (
            "import sys, helper, pyrender\nfrom pyrender.constants import RenderFlags\n"
            "print(sys.argv[1:], helper.SIZE, RenderFlags.SEG, pyrender.OffscreenRenderer(2, 3).viewport_height)\n"
        )
        with tempfile.TemporaryDirectory() as folder:
            for name, content in (("script.py", text), ("helper.py", "SIZE = 5\n")):
                with open(os.path.join(folder, name), "w") as file:
                    file.write(content)
            command = [sys.executable, "-m", "zraster.pyrender"]
            ran = subprocess.run([*command, os.path.join(folder, "script.py"), "-x"], capture_output=True, text=True)
            self.assertEqual((ran.stdout, ran.returncode), ("['-x'] 5 8192 3\n", 0), ran.stderr)
            ran = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual((ran.returncode, "usage" in ran.stderr), (1, True))

    def test_empty(self):
        """meshes without primitives, faces or points are drawn as nothing, and have no part in bounds"""
        p, scene = self.p, self.p.Scene()
        empty = Box()
        empty.vertices, empty.faces = numpy.zeros((0, 3)), numpy.zeros((0, 3), int)
        meshes = [p.Mesh([]), p.Mesh.from_trimesh(empty), p.Mesh.from_trimesh(empty, smooth=False)]
        meshes += [p.Mesh.from_points(numpy.zeros((0, 3))), p.Mesh([p.Primitive([[0, 0, 0]], mode=mode)
                   for mode in (p.GLTF.LINES, p.GLTF.LINE_STRIP, p.GLTF.TRIANGLE_STRIP, p.GLTF.TRIANGLE_FAN)])]  # fmt: skip
        for mesh in meshes:
            scene.add(mesh)
        scene.add(p.PerspectiveCamera(yfov=1.0), pose=pose(z=3))
        color, depth = self.renderer.render(scene)
        self.assertTrue((color == 255).all() and not depth.any())
        self.assertFalse(scene.bounds.any())
        scene.add(p.Mesh.from_trimesh(Box()))
        numpy.testing.assert_array_equal(scene.bounds, [[-0.5] * 3, [0.5] * 3])

    def test_visibility(self):
        """is_visible hides a mesh; copies of a material keep later changes apart"""
        material = self.material(baseColorFactor=[1.0, 0, 0, 1])
        mesh = self.p.Mesh.from_trimesh(Box(), material=material)
        material.baseColorFactor = [0.0, 1, 0, 1]
        self.assertEqual(mesh.primitives[0].material.baseColorFactor.tolist(), [1, 0, 0, 1])
        scene = self.p.Scene()
        scene.add(mesh)
        scene.add(self.p.PerspectiveCamera(yfov=1.0), pose=pose(z=3))
        mesh.is_visible = False
        self.assertFalse(self.draw(scene)[1].any())
        mesh.is_visible = True
        self.assertTrue(self.draw(scene)[1].any())

    def test_trackball(self):
        """drags turn, roll, move and zoom the camera around the target"""
        ball = self.p.Trackball(pose(0, 0, 5), (640, 480), 2.0, numpy.array([0.0, 0, 1]))
        ball.down((100, 100))
        ball.drag((100, 100))
        numpy.testing.assert_allclose(ball.pose, pose(0, 0, 5))
        ball.drag((100 + 0.3 * 480 * math.pi / 2, 100))  # a quarter turn about y
        numpy.testing.assert_allclose(ball.pose[:3, 3], [-4, 0, 1], atol=1e-12)
        ball.down((0, 0))
        for state, length in ((ball.STATE_ROTATE, 4), (ball.STATE_ROLL, 4), (ball.STATE_ZOOM, 4 * (2 - math.exp(-0.25)))):
            ball.set_state(state)
            ball.drag((-37, -60))
            self.assertAlmostEqual(numpy.linalg.norm(ball.pose[:3, 3] - [0, 0, 1]), length)
        ball.set_state(ball.STATE_PAN)
        ball.drag((36, 0))  # 36 / (1.5 * 480) of the scale, against the x axis of the camera, which is z
        numpy.testing.assert_allclose(ball.pose[:3, 3], [-4, 0, 0.9], atol=1e-12)
        ball = self.p.Trackball(pose(0, 0, 5), (640, 480), 2.0)
        ball.scroll(2)
        self.assertAlmostEqual(ball.pose[2, 3], 5 * 0.81)
        ball.rotate(math.pi, axis=[0, 1, 0])
        numpy.testing.assert_allclose(ball.pose[:3, 3], [0, 0, -5 * 0.81], atol=1e-12)

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
