"""Primitives. Arrays are converted once, when they are set."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._checks import Checked, Convert, instance, optional, or_default
from .constants import GLTF, BufFlags
from .material import Material, MetallicRoughnessMaterial
from .utils import format_color_array


def _floats(value: Any) -> Any:
    return np.ascontiguousarray(np.asanyarray(value, np.float32))


def _per_vertex(name: str, columns: int) -> Convert:
    def convert(primitive: Any, value: Any) -> Any:
        array = _floats(value)
        shape = (len(primitive.positions), columns)
        if array.ndim == 2 and array.shape[1] > columns == 2 and name == "texcoord_0":
            array = np.ascontiguousarray(array[:, :2])
        if array.shape != shape:
            raise ValueError(f"{name}: the shape {shape} expected, not {array.shape}")
        return array

    return convert


def _mode(_: Any, value: Any) -> int:
    mode = int(value)
    if not GLTF.POINTS <= mode <= GLTF.TRIANGLE_FAN:
        raise ValueError(f"invalid mode {mode}")
    return mode


def _poses(_: Any, value: Any) -> Any:
    array = _floats(value)
    array = array[None] if array.ndim == 2 else array
    if array.ndim != 3 or array.shape[1:] != (4, 4):
        raise ValueError(f"poses: the shape (n, 4, 4) expected, not {array.shape}")
    return array


def corners(box: Any) -> Any:
    """Returns the 8 corners of a box (2, 3)."""
    return np.array([[box[i >> k & 1][k] for k in range(3)] for i in range(8)])


class Primitive:
    """Triangles, lines or points, with one material.

    positions: (n, 3); normals: (n, 3); texcoord_0: (n, 2), v up; color_0: (n, 3) or (n, 4)
    indices: (m, 3), or flat; poses: (k, 4, 4), one for each instance
    """

    positions = Checked(lambda _, value: _floats(value))
    normals, tangents = Checked(optional(_per_vertex("normals", 3))), Checked(optional(_per_vertex("tangents", 4)))
    texcoord_0 = Checked(optional(_per_vertex("texcoord_0", 2)))
    texcoord_1 = Checked(optional(_per_vertex("texcoord_1", 2)))
    color_0 = Checked(optional(lambda one, value: format_color_array(value, (len(one.positions), 4))))
    indices = Checked(optional(lambda _, value: np.ascontiguousarray(value, np.uint32)))
    material = Checked(lambda one, value: instance("material", Material, "a Material")(
        one, MetallicRoughnessMaterial() if value is None else value))  # fmt: skip
    mode, poses = Checked(or_default(GLTF.TRIANGLES, _mode)), Checked(optional(_poses))

    def __init__(self, positions: Any, normals: Any = None, tangents: Any = None, texcoord_0: Any = None,
                 texcoord_1: Any = None, color_0: Any = None, joints_0: Any = None, weights_0: Any = None,
                 indices: Any = None, material: Optional[Material] = None, mode: Optional[int] = None,
                 targets: Any = None, poses: Any = None):  # fmt: skip
        self.positions, self.normals, self.tangents = positions, normals, tangents
        self.texcoord_0, self.texcoord_1, self.color_0 = texcoord_0, texcoord_1, color_0
        self.joints_0, self.weights_0, self.targets = joints_0, weights_0, targets
        self.indices, self.material, self.mode, self.poses = indices, material, mode, poses

    @property
    def bounds(self) -> Any:
        """(2, 3): the corners of the box around all instances; inf and -inf without positions."""
        if not len(self.positions):
            return np.array([[np.inf] * 3, [-np.inf] * 3])
        box = np.array([self.positions.min(axis=0), self.positions.max(axis=0)])
        if self.poses is None:
            return box
        placed = np.einsum("kij,cj->kci", self.poses[:, :3, :3], corners(box)) + self.poses[:, None, :3, 3]
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
        return bool(self.material.is_transparent or (self.color_0 is not None and (self.color_0[:, 3] != 1).any()))

    @property
    def buf_flags(self) -> int:
        names = ("normals", "tangents", "texcoord_0", "texcoord_1", "color_0", "joints_0", "weights_0")
        return BufFlags.POSITION + sum(1 << i for i, name in enumerate(names) if getattr(self, name) is not None)

    def delete(self) -> None:
        """Does nothing: there is no context to free."""

    def items(self) -> Any:
        """Returns faces, lines or points, the key of a mesh, and the indices."""
        order = np.arange(len(self.positions), dtype=np.uint32) if self.indices is None else self.indices.reshape(-1)
        if self.mode == GLTF.POINTS:
            return "points", order
        if self.mode in (GLTF.LINES, GLTF.LINE_STRIP, GLTF.LINE_LOOP):
            if self.mode == GLTF.LINES:
                return "lines", order[: len(order) // 2 * 2].reshape(-1, 2)
            after = np.roll(order, -1)
            count = len(order) if self.mode == GLTF.LINE_LOOP else max(0, len(order) - 1)
            return "lines", np.stack([order, after], axis=1)[:count]
        if self.mode == GLTF.TRIANGLES:
            return "faces", order[: len(order) // 3 * 3].reshape(-1, 3)
        first, second = (order[:-2], order[1:-1]) if self.mode == GLTF.TRIANGLE_STRIP else (order[:1], order[1:-1])
        if len(order) < 3:
            return "faces", np.zeros((0, 3), np.uint32)
        faces = np.stack(np.broadcast_arrays(first, second, order[2:]), axis=1)
        if self.mode == GLTF.TRIANGLE_STRIP:
            faces[1::2, :2] = faces[1::2, 1::-1]
        return "faces", faces
