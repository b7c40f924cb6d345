"""Primitives and meshes. Arrays are converted once, when they are set."""
from __future__ import annotations

from typing import Any, List, Optional

import numpy as np

from .constants import GLTF
from .material import Material, MetallicRoughnessMaterial


def _floats(value: Any) -> Any:
    return None if value is None else np.ascontiguousarray(value, np.float32)


def _colors(value: Any, count: int) -> Any:
    """Returns (n, 4) floats of one colour or of n colours. Integers are 0..255."""
    array = np.asarray(value)
    if np.issubdtype(array.dtype, np.integer):
        array = array / 255.0
    if array.ndim == 1:
        array = np.tile(array, (count, 1))
    missing = np.ones((len(array), max(0, 4 - array.shape[1])))
    return np.hstack([array, missing])[:, :4].astype(np.float32)


class Primitive:
    """Triangles, lines or points, with one material.

    positions: (n, 3); normals: (n, 3); texcoord_0: (n, 2), v up; color_0: (n, 3) or (n, 4)
    indices: (m, 3), or flat; poses: (k, 4, 4), one for each instance
    """

    def __init__(self, positions: Any, normals: Any = None, tangents: Any = None, texcoord_0: Any = None,
                 texcoord_1: Any = None, color_0: Any = None, joints_0: Any = None, weights_0: Any = None,
                 indices: Any = None, material: Optional[Material] = None, mode: Optional[int] = None,
                 targets: Any = None, poses: Any = None):  # fmt: skip
        self.positions, self.normals, self.tangents = _floats(positions), _floats(normals), _floats(tangents)
        self.texcoord_0, self.texcoord_1 = _floats(texcoord_0), _floats(texcoord_1)
        self.color_0 = None if color_0 is None else _colors(color_0, len(self.positions))
        self.joints_0, self.weights_0, self.targets = joints_0, weights_0, targets
        self.indices = None if indices is None else np.ascontiguousarray(indices, np.uint32)
        self.material = MetallicRoughnessMaterial() if material is None else material
        if not isinstance(self.material, Material):
            raise TypeError("material: a Material expected")
        self.mode = GLTF.TRIANGLES if mode is None else int(mode)
        if not GLTF.POINTS <= self.mode <= GLTF.TRIANGLE_FAN:
            raise ValueError("invalid mode")
        self.poses = None if poses is None else np.asarray(poses, np.float32).reshape(-1, 4, 4)

    @property
    def bounds(self) -> Any:
        """(2, 3): the corners of the box around all instances."""
        low, high = self.positions.min(axis=0), self.positions.max(axis=0)
        if self.poses is None:
            return np.array([low, high])
        corners = np.array([[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)])
        placed = np.einsum("kij,cj->kci", self.poses[:, :3, :3], corners) + self.poses[:, None, :3, 3]
        return np.array([placed.min(axis=(0, 1)), placed.max(axis=(0, 1))])

    @property
    def centroid(self) -> Any:
        return self.bounds.mean(axis=0)

    @property
    def extents(self) -> Any:
        return self.bounds[1] - self.bounds[0]

    @property
    def scale(self) -> Any:
        return np.linalg.norm(self.extents)

    @property
    def is_transparent(self) -> bool:
        return self.material.alphaMode == "BLEND"

    def items(self) -> Any:
        """Returns faces, lines or points, the key of a mesh, and the indices."""
        order = np.arange(len(self.positions), dtype=np.uint32) if self.indices is None else self.indices.reshape(-1)
        if self.mode == GLTF.POINTS:
            return "points", order
        if self.mode in (GLTF.LINES, GLTF.LINE_STRIP, GLTF.LINE_LOOP):
            if self.mode == GLTF.LINES:
                return "lines", order[: len(order) // 2 * 2].reshape(-1, 2)
            after = np.roll(order, -1)
            count = len(order) if self.mode == GLTF.LINE_LOOP else len(order) - 1
            return "lines", np.stack([order, after], axis=1)[:count]
        if self.mode == GLTF.TRIANGLES:
            return "faces", order[: len(order) // 3 * 3].reshape(-1, 3)
        first, second = (order[:-2], order[1:-1]) if self.mode == GLTF.TRIANGLE_STRIP else (order[:1], order[1:-1])
        faces = np.stack(np.broadcast_arrays(first, second, order[2:]), axis=1)
        if self.mode == GLTF.TRIANGLE_STRIP:
            faces[1::2, :2] = faces[1::2, 1::-1]
        return "faces", faces


class Mesh:
    """A list of primitives."""

    def __init__(self, primitives: List[Primitive], name: Optional[str] = None, weights: Any = None,
                 is_visible: bool = True):  # fmt: skip
        self.primitives, self.name, self.weights, self.is_visible = primitives, name, weights, is_visible

    @property
    def bounds(self) -> Any:
        boxes = np.array([primitive.bounds for primitive in self.primitives])
        return np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])

    centroid, extents, scale = Primitive.centroid, Primitive.extents, Primitive.scale

    @property
    def is_transparent(self) -> bool:
        return any(primitive.is_transparent for primitive in self.primitives)

    @staticmethod
    def from_points(points: Any, colors: Any = None, normals: Any = None, is_visible: bool = True,
                    poses: Any = None) -> "Mesh":  # fmt: skip
        """Makes a cloud of points: (n, 3)."""
        cloud = Primitive(points, normals, color_0=colors, mode=GLTF.POINTS, poses=poses)
        return Mesh([cloud], is_visible=is_visible)

    @staticmethod
    def from_trimesh(mesh: Any, material: Optional[Material] = None, is_visible: bool = True, poses: Any = None,
                     wireframe: bool = False, smooth: bool = True) -> "Mesh":  # fmt: skip
        """Makes a mesh of a trimesh, or of a list of them. smooth: normals of vertices, else of faces."""
        meshes = list(mesh) if isinstance(mesh, (list, tuple, set, np.ndarray)) else [mesh]
        for one in meshes:
            if not hasattr(one, "vertices") or not hasattr(one, "faces"):
                raise TypeError(f"expected a Trimesh or a list, got a {type(one)}")
        made = [_primitive_of(one, material, poses, wireframe, smooth) for one in meshes]
        return Mesh(made, is_visible=is_visible)


def _default(base: Any) -> MetallicRoughnessMaterial:
    return MetallicRoughnessMaterial(alphaMode="BLEND", baseColorFactor=base, metallicFactor=0.2, roughnessFactor=0.8)


def _material_of(visual: Any) -> Optional[Material]:
    """Returns the material of a trimesh's texture."""
    given = getattr(visual, "material", None)
    if isinstance(given, Material) or given is None:
        return given
    if hasattr(given, "metallicFactor"):
        names = ("normalTexture", "occlusionTexture", "emissiveTexture", "emissiveFactor", "baseColorFactor",
                 "baseColorTexture", "metallicFactor", "roughnessFactor", "metallicRoughnessTexture", "doubleSided",
                 "alphaCutoff")  # fmt: skip
        return MetallicRoughnessMaterial(alphaMode="BLEND", **{name: getattr(given, name) for name in names})
    glossiness = np.ravel(given.kwargs.get("Ns", 1.0))[0]
    return MetallicRoughnessMaterial(
        alphaMode="BLEND", roughnessFactor=float((2 / (glossiness + 2)) ** 0.25), baseColorFactor=given.diffuse,
        baseColorTexture=given.image,
    )  # fmt: skip


def _primitive_of(mesh: Any, material: Optional[Material], poses: Any, wireframe: bool, smooth: bool) -> Primitive:
    faces = np.asarray(mesh.faces)

    def corners(values: Any) -> Any:
        return np.asarray(values) if smooth else np.asarray(values)[faces].reshape(3 * len(faces), -1)

    visual: Any = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None) if getattr(visual, "defined", True) else None
    colors = texcoords = None
    if kind == "face" and material is None:
        if smooth:
            raise ValueError("face colors need smooth=False")
        colors = np.repeat(visual.face_colors, 3, axis=0)
    elif kind == "vertex" and material is None:
        colors = corners(visual.vertex_colors)
    elif kind == "texture":
        texcoords = None if visual.uv is None or len(visual.uv) == 0 else corners(visual.uv)
        material = material or _material_of(visual)
    if material is None:
        material = _default([0.3, 0.3, 0.3, 1.0] if colors is None else [1.0, 1.0, 1.0, 1.0])
    if material.wireframe != wireframe:
        import copy

        material = copy.copy(material)
        material.wireframe = wireframe
    try:
        normals = mesh.vertex_normals if smooth else np.repeat(mesh.face_normals, 3, axis=0)
    except ImportError:  # trimesh averages normals by scipy; without it, the renderer does
        normals = None
    return Primitive(corners(mesh.vertices), normals, texcoord_0=texcoords, color_0=colors, material=material,
                     indices=faces if smooth else None, poses=poses)  # fmt: skip
