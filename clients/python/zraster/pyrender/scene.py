"""Nodes and scenes."""
from __future__ import annotations

from typing import Any, Dict, List, Optional, Set

import numpy as np

from .camera import Camera
from .light import DirectionalLight, Light, PointLight, SpotLight, format_color_vector
from .mesh import Mesh


def _rotation(quaternion: Any) -> Any:
    x, y, z, w = quaternion
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip


def _quaternion(rotation: Any) -> Any:
    m = rotation
    terms = np.array(
        [m[0, 0] - m[1, 1] - m[2, 2], m[1, 1] - m[0, 0] - m[2, 2], m[2, 2] - m[0, 0] - m[1, 1], np.trace(m)]
    )
    i = int(terms.argmax())
    if i == 3:
        q = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1 + terms[3]])
    else:
        j, k = (i + 1) % 3, (i + 2) % 3
        q = np.zeros(4)
        q[i], q[j], q[k], q[3] = 1 + terms[i], m[j, i] + m[i, j], m[k, i] + m[i, k], m[k, j] - m[j, k]
    return q / np.linalg.norm(q)


class Node:
    """A place in a scene, with a mesh, camera or light. matrix: (4, 4), or rotation (x, y, z, w), scale, translation."""

    def __init__(self, name: Optional[str] = None, camera: Optional[Camera] = None,
                 children: Optional[List["Node"]] = None, skin: Any = None, matrix: Any = None,
                 mesh: Optional[Mesh] = None, rotation: Any = None, scale: Any = None, translation: Any = None,
                 weights: Any = None, light: Optional[Light] = None):  # fmt: skip
        self.name, self.camera, self.children, self.skin = name, camera, children or [], skin
        self.mesh, self.weights, self.light = mesh, weights, light
        self._matrix = np.eye(4)
        if matrix is not None:
            self.matrix = matrix
        else:
            self._compose([0, 0, 0, 1] if rotation is None else rotation, 1 if scale is None else scale,
                          0 if translation is None else translation)  # fmt: skip

    def _compose(self, rotation: Any, scale: Any, translation: Any) -> None:
        rotation = np.asarray(rotation, np.float64)
        if rotation.shape != (4,) or abs(np.linalg.norm(rotation) - 1) > 1e-3:
            raise ValueError("rotation: a quaternion (x, y, z, w) of length 1 expected")
        self._matrix = np.eye(4)
        self._matrix[:3, :3] = _rotation(rotation) * np.broadcast_to(scale, 3)
        self._matrix[:3, 3] = translation

    @property
    def matrix(self) -> Any:
        return self._matrix.copy()

    @matrix.setter
    def matrix(self, value: Any) -> None:
        self._matrix = np.array(value, np.float64)
        if self._matrix.shape != (4, 4):
            raise ValueError("matrix: (4, 4) expected")

    @property
    def translation(self) -> Any:
        return self._matrix[:3, 3].copy()

    @translation.setter
    def translation(self, value: Any) -> None:
        self._matrix[:3, 3] = value

    @property
    def scale(self) -> Any:
        return np.linalg.norm(self._matrix[:3, :3], axis=0)

    @scale.setter
    def scale(self, value: Any) -> None:
        self._compose(self.rotation, value, self.translation)

    @property
    def rotation(self) -> Any:
        return _quaternion(self._matrix[:3, :3] / self.scale)

    @rotation.setter
    def rotation(self, value: Any) -> None:
        self._compose(value, self.scale, self.translation)


class Scene:
    """A tree of nodes. bg_color: (4,); ambient_light: (3,), linear light."""

    def __init__(self, nodes: Any = None, bg_color: Any = None, ambient_light: Any = None, name: Optional[str] = None):
        self.bg_color = np.ones(4) if bg_color is None else bg_color
        self.ambient_light = np.zeros(3) if ambient_light is None else ambient_light
        self.name = name
        self._parents: Dict[Node, Optional[Node]] = {}
        self._main_camera_node: Optional[Node] = None
        children = [child for node in nodes or () for child in node.children]
        if len(children) != len(set(children)):
            raise ValueError("a node has more than one parent")
        for node in nodes or ():
            if node not in children:
                self.add_node(node)

    @property
    def bg_color(self) -> Any:
        return self._bg_color

    @bg_color.setter
    def bg_color(self, value: Any) -> None:
        self._bg_color = format_color_vector(np.ones(4) if value is None else value, 4)

    @property
    def ambient_light(self) -> Any:
        return self._ambient_light

    @ambient_light.setter
    def ambient_light(self, value: Any) -> None:
        self._ambient_light = format_color_vector(np.zeros(3) if value is None else value, 3)

    # ---- sets ----

    def _nodes_with(self, attribute: str, kind: Any = object) -> Set[Node]:
        found = ((node, getattr(node, attribute)) for node in self._parents)
        return {node for node, value in found if value is not None and isinstance(value, kind)}

    nodes = property(lambda self: set(self._parents))
    mesh_nodes = property(lambda self: self._nodes_with("mesh"))
    camera_nodes = property(lambda self: self._nodes_with("camera"))
    light_nodes = property(lambda self: self._nodes_with("light"))
    point_light_nodes = property(lambda self: self._nodes_with("light", PointLight))
    spot_light_nodes = property(lambda self: self._nodes_with("light", SpotLight))
    directional_light_nodes = property(lambda self: self._nodes_with("light", DirectionalLight))
    meshes = property(lambda self: {node.mesh for node in self.mesh_nodes})
    cameras = property(lambda self: {node.camera for node in self.camera_nodes})
    lights = property(lambda self: {node.light for node in self.light_nodes})
    point_lights = property(lambda self: {node.light for node in self.point_light_nodes})
    spot_lights = property(lambda self: {node.light for node in self.spot_light_nodes})
    directional_lights = property(lambda self: {node.light for node in self.directional_light_nodes})

    @property
    def main_camera_node(self) -> Optional[Node]:
        return self._main_camera_node

    @main_camera_node.setter
    def main_camera_node(self, value: Node) -> None:
        self._check(value)
        self._main_camera_node = value

    def get_nodes(self, node: Optional[Node] = None, name: Optional[str] = None, obj: Any = None,
                  obj_name: Optional[str] = None) -> Set[Node]:  # fmt: skip
        """Returns the nodes that fit all given values."""
        if node is not None:
            return {node} if node in self._parents else set()

        def objects(one: Node) -> List[Any]:
            return [item for item in (one.mesh, one.camera, one.light) if item is not None]

        return {one for one in self._parents
                if (name is None or one.name == name) and (obj is None or any(item is obj for item in objects(one)))
                and (obj_name is None or any(item.name == obj_name for item in objects(one)))}  # fmt: skip

    # ---- the tree ----

    def _check(self, node: Node) -> None:
        if node not in self._parents:
            raise ValueError("the node is not in the scene")

    def add(self, obj: Any, name: Optional[str] = None, pose: Any = None, parent_node: Optional[Node] = None,
            parent_name: Optional[str] = None) -> Node:  # fmt: skip
        """Adds a mesh, light or camera in a new node. pose: (4, 4), relative to the parent."""
        kinds = {"mesh": Mesh, "light": Light, "camera": Camera}
        fitting = [attribute for attribute, kind in kinds.items() if isinstance(obj, kind)]
        if not fitting:
            raise TypeError(f"expected a Mesh, Light or Camera, got a {type(obj)}")
        node = Node(name=name, matrix=pose, **{fitting[0]: obj})
        if parent_node is None and parent_name is not None:
            named = self.get_nodes(name=parent_name)
            if len(named) != 1:
                raise ValueError(f"{len(named)} nodes have the name {parent_name}")
            parent_node = named.pop()
        self.add_node(node, parent_node)
        return node

    def add_node(self, node: Node, parent_node: Optional[Node] = None) -> None:
        if node in self._parents:
            raise ValueError("the node is already in the scene")
        if parent_node is not None:
            self._check(parent_node)
            if node not in parent_node.children:
                parent_node.children.append(node)
        self._parents[node] = parent_node
        if node.camera is not None and self._main_camera_node is None:
            self._main_camera_node = node
        for child in node.children:
            self.add_node(child, node)

    def has_node(self, node: Node) -> bool:
        return node in self._parents

    def remove_node(self, node: Node) -> None:
        """Removes a node and its children."""
        self._check(node)
        parent = self._parents[node]
        self._remove(node)
        if parent is not None:
            parent.children.remove(node)

    def _remove(self, node: Node) -> None:
        for child in node.children:
            self._remove(child)
        del self._parents[node]
        if self._main_camera_node is node:
            self._main_camera_node = next((one for one in self._parents if one.camera is not None), None)

    def clear(self) -> None:
        self._parents, self._main_camera_node = {}, None

    def get_pose(self, node: Node) -> Any:
        """Returns the (4, 4) matrix of a node in the world."""
        self._check(node)
        pose, at = node.matrix, self._parents[node]
        while at is not None:
            pose, at = at.matrix @ pose, self._parents[at]
        return pose

    def set_pose(self, node: Node, pose: Any) -> None:
        """Sets the (4, 4) matrix of a node relative to its parent."""
        self._check(node)
        node.matrix = pose

    # ---- size ----

    @property
    def bounds(self) -> Any:
        corners = []
        for node in self.mesh_nodes:
            box, pose = node.mesh.bounds, self.get_pose(node)
            local = np.array([[box[i >> k & 1][k] for k in range(3)] for i in range(8)])
            corners.append(local @ pose[:3, :3].T + pose[:3, 3])
        every = np.vstack(corners) if corners else np.zeros((1, 3))
        return np.array([every.min(axis=0), every.max(axis=0)])

    centroid, extents, scale = Mesh.centroid, Mesh.extents, Mesh.scale

    @staticmethod
    def from_trimesh_scene(trimesh_scene: Any, bg_color: Any = None, ambient_light: Any = None) -> "Scene":
        """Makes a scene of a trimesh.Scene."""
        meshes = {name: Mesh.from_trimesh(geometry) for name, geometry in trimesh_scene.geometry.items()}
        scene = Scene(bg_color=bg_color, ambient_light=ambient_light)
        for name in trimesh_scene.graph.nodes_geometry:
            pose, geometry = trimesh_scene.graph[name]
            scene.add(meshes[geometry], pose=pose)
        return scene
