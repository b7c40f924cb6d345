"""zraster.trimesh with python3-trimesh, and with objects that look like its scenes."""
import unittest

import zraster
from support import needs_numpy, numpy

try:
    import trimesh
except ImportError:
    trimesh = None


def size_of(png):
    return int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")


class Graph(dict):
    """A stand-in for scene.graph: places by name."""

    nodes_geometry = property(lambda self: list(self))


class StandIn:
    """A stand-in for trimesh.Scene."""

    has_camera = False

    def __init__(self, geometry, places):
        self.geometry, self.graph = geometry, Graph(places)


class Sheet:
    def __init__(self):
        self.vertices = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]])
        self.faces = numpy.array([[0, 1, 2], [0, 2, 3]])


@needs_numpy
class StandIns(unittest.TestCase):
    def test_scene(self):
        """geometries are placed by the graph; the window's options have no effect"""
        import zraster.trimesh

        moved = numpy.eye(4)
        moved[0, 3] = 2
        scene = StandIn({"a": Sheet(), "path": object()}, {"one": (numpy.eye(4), "a"), "two": (moved, "a")})
        sheet = scene.geometry["a"]
        mesh = {"name": "a", "positions": sheet.vertices.tolist(), "faces": sheet.faces.tolist(), "doubleSided": True}
        nodes = [{"mesh": "a"}, {"mesh": "a", "matrix": moved.tolist()}]
        wanted = zraster.render({"look": "studio", "meshes": [mesh], "nodes": nodes}, size=(90, 70)).png
        self.assertEqual(zraster.trimesh.save_image(scene, (90, 70)), wanted)
        self.assertEqual(zraster.trimesh.save_image(scene, numpy.array([90, 70]), visible=False, smooth=True), wanted)
        self.assertEqual(zraster.trimesh.save_image(sheet), zraster.render(sheet).png)
        white = zraster.trimesh.save_image(scene, (90, 70), background=[255, 255, 255, 255], look="clay")
        nodes = {"look": "clay", "meshes": [mesh], "nodes": nodes, "background": [1, 1, 1]}
        self.assertEqual(white, zraster.render(nodes, size=(90, 70)).png)

    def test_camera(self):
        """a camera of the scene is used, and none is made"""
        import zraster.trimesh

        class Camera:
            fov, resolution, z_near, z_far = (60.0, 40.0), (50, 30), 0.1, 100.0

        scene = StandIn({"a": Sheet()}, {"one": (numpy.eye(4), "a")})
        scene.has_camera, scene.camera, scene.camera_transform = True, Camera, numpy.eye(4)
        scene.camera_transform[:3, 3] = 0.5, 0.5, 3
        picture = zraster.render(zraster.trimesh.scene_of(scene), ["depth", "info"], size=(50, 30))
        self.assertEqual(size_of(zraster.trimesh.save_image(scene)), (50, 30))
        self.assertAlmostEqual(picture["depth"][17, 25], 3, delta=0.5)
        self.assertAlmostEqual(picture.info["camera"]["eye"][2], 3)


@unittest.skipUnless(trimesh and numpy, "there is no trimesh (python3-trimesh, from Debian 13 on)")
class Trimesh(unittest.TestCase):
    def test_save_image(self):
        """a scene of trimesh gives a PNG of its size; asking for it makes no camera"""
        import zraster.trimesh

        scene = trimesh.Scene([trimesh.creation.box(), trimesh.creation.icosphere()])
        png = zraster.trimesh.save_image(scene, (120, 90))
        self.assertEqual((png[1:4], size_of(png)), (b"PNG", (120, 90)))
        self.assertFalse(scene.has_camera)
        scene.set_camera(resolution=(64, 48), fov=(60, 45))
        self.assertEqual(size_of(zraster.trimesh.save_image(scene)), (64, 48))

    def test_depth(self):
        """depth of a trimesh is that of its file, bit for bit"""
        mesh = trimesh.creation.icosphere(subdivisions=3)
        body = trimesh.exchange.obj.export_obj(mesh, include_normals=False, digits=17).encode()
        view = {"eye": [3, 2, 4], "target": [0, 0, 0]}
        wanted = zraster.render(body, "depth", view=view)["depth"]
        numpy.testing.assert_array_equal(zraster.render(mesh, "depth", view=view)["depth"], wanted)

    def test_colors(self):
        """colours of vertices, faces and clouds are used"""
        import zraster.trimesh

        box = trimesh.creation.box()
        box.visual.face_colors = [255, 0, 0, 255]
        cloud = trimesh.PointCloud([[2, 0, 0], [2, 1, 0]], colors=[[0, 0, 255, 255]] * 2)
        made = zraster.trimesh.scene_of(trimesh.Scene([box, cloud]))
        found = {
            tuple(color)
            for color in zraster.render({**made, "look": "textbook"}, shading="unlit").array.reshape(-1, 3).tolist()
        }
        self.assertEqual(found, {(255, 255, 255), (255, 0, 0), (0, 0, 255)})

    def test_pyrender(self):
        """pyrender's meshes and scenes are made of trimesh's; depth is bit-equal to zraster's own"""
        import zraster.pyrender as pyrender

        source = trimesh.Scene([trimesh.creation.icosphere(subdivisions=2)])
        scene = pyrender.Scene.from_trimesh_scene(source)
        pose = numpy.eye(4)
        pose[2, 3] = 4
        camera = pyrender.PerspectiveCamera(yfov=0.8)
        scene.add(camera, pose=pose)
        scene.add(pyrender.DirectionalLight(intensity=3.0), pose=pose)
        color, depth = pyrender.OffscreenRenderer(100, 100).render(scene)
        view = {"cameraToWorld": pose, "projectionMatrix": camera.get_projection_matrix(100, 100)}
        own = zraster.render(zraster.trimesh.scene_of(source), "depth", view=view, size=100)["depth"]
        numpy.testing.assert_array_equal(depth, numpy.where(numpy.isinf(own), 0, own))
        self.assertAlmostEqual(depth[50, 50], 3, delta=0.01)
        self.assertTrue((color[50, 50] > 60).all())
