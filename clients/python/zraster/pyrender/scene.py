"""Scenes."""
from __future__ import annotations

from typing import Any, Dict, List, Optional, Set

import numpy as np

from ._checks import Checked, or_default, text
from .camera import Camera
from .light import DirectionalLight, Light, PointLight, SpotLight
from .mesh import Mesh
from .node import Node
from .primitive import corners
from .utils import format_color_vector


class Scene:
    """A tree of nodes. bg_color: (4,); ambient_light: (3,), linear light."""

    name = Checked(text)
    bg_color = Checked(or_default(np.ones(4), lambda _, value: format_color_vector(value, 4)))
    ambient_light = Checked(or_default(np.zeros(3), lambda _, value: format_color_vector(value, 3)))

    def __init__(self, nodes: Any = None, bg_color: Any = None, ambient_light: Any = None, name: Optional[str] = None):
        self.bg_color, self.ambient_light, self.name = bg_color, ambient_light, name
        self._parents: Dict[Node, Optional[Node]] = {}
        self._main_camera_node: Optional[Node] = None
        children = [child for node in nodes or () for child in node.children]
        if len(children) != len(set(children)):
            raise ValueError("a node has more than one parent")
        for node in nodes or ():
            if node not in children:
                self.add_node(node)

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
        boxes = [(node.mesh.bounds, self.get_pose(node)) for node in self.mesh_nodes]
        placed = [corners(box) @ pose[:3, :3].T + pose[:3, 3] for box, pose in boxes if np.isfinite(box).all()]
        every = np.vstack(placed) if placed else np.zeros((1, 3))
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
