"""Meshes."""
from __future__ import annotations

import copy
from typing import Any, List, Optional

import numpy as np

from ._checks import Checked, text
from .constants import GLTF
from .material import Material, MetallicRoughnessMaterial
from .primitive import Primitive


class Mesh:
    """A list of primitives. Those that are not visible are not drawn."""

    name = Checked(text)

    def __init__(self, primitives: List[Primitive], name: Optional[str] = None, weights: Any = None,
                 is_visible: bool = True):  # fmt: skip
        self.primitives, self.name, self.weights, self.is_visible = primitives, name, weights, is_visible

    @property
    def bounds(self) -> Any:
        """(2, 3): the corners of the box around all primitives; inf and -inf without positions."""
        boxes = np.array([[[np.inf] * 3, [-np.inf] * 3], *(primitive.bounds for primitive in self.primitives)])
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
        """Makes a mesh of a trimesh, or of a list of them. material: copied. smooth: normals of vertices, else of faces."""
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
                 "baseColorTexture", "metallicFactor", "roughnessFactor", "metallicRoughnessTexture",
                 "alphaCutoff")  # fmt: skip
        values = {name: getattr(given, name) for name in names}
        return MetallicRoughnessMaterial(alphaMode="BLEND", doubleSided=bool(given.doubleSided), **values)
    glossiness = np.ravel(given.kwargs.get("Ns", 1.0))[0]
    return MetallicRoughnessMaterial(
        alphaMode="BLEND", roughnessFactor=float((2 / (glossiness + 2)) ** 0.25), baseColorFactor=given.diffuse,
        baseColorTexture=given.image,
    )  # fmt: skip


def _copy_of(material: Material) -> Material:
    """Returns a copy that shares the textures."""
    return copy.deepcopy(material, {id(texture): texture for texture in material.textures})


def _primitive_of(mesh: Any, material: Optional[Material], poses: Any, wireframe: bool, smooth: bool) -> Primitive:
    faces = np.asarray(mesh.faces)
    if not len(faces):
        return Primitive(np.zeros((0, 3)), material=material and _copy_of(material), poses=poses)

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
    material = _copy_of(material)
    material.wireframe = wireframe
    try:
        normals = mesh.vertex_normals if smooth else np.repeat(mesh.face_normals, 3, axis=0)
    except ImportError:  # trimesh averages normals by scipy; without it, the renderer does
        normals = None
    return Primitive(corners(mesh.vertices), normals, texcoord_0=texcoords, color_0=colors, material=material,
                     indices=faces if smooth else None, poses=poses)  # fmt: skip
