"""Nodes: places in a scene."""
from __future__ import annotations

from typing import Any, List, Optional, Tuple

import numpy as np

from ._checks import Checked, instance, optional, text
from .camera import Camera
from .light import Light
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


def _split(matrix: Any) -> Tuple[Any, Any, Any]:
    """Returns translation, rotation and scale of a matrix."""
    lengths = np.linalg.norm(matrix[:3, :3], axis=0)
    return matrix[:3, 3].copy(), _quaternion(matrix[:3, :3] / np.where(lengths > 0, lengths, 1)), lengths


def _composed(translation: Any, rotation: Any, scale: Any) -> Any:
    matrix = np.eye(4)
    matrix[:3, :3] = _rotation(rotation) * scale
    matrix[:3, 3] = translation
    return matrix


def _vector(name: str, value: Any, size: int) -> Any:
    array = np.array(value, np.float64)
    if array.shape != (size,):
        raise ValueError(f"{name}: a vector of {size} numbers expected, not the shape {array.shape}")
    return array


def _affine(value: Any) -> Any:
    matrix = np.array(value, np.float64)
    if matrix.shape != (4, 4):
        raise ValueError(f"matrix: the shape (4, 4) expected, not {matrix.shape}")
    if not np.allclose(matrix[3], [0, 0, 0, 1]):
        raise ValueError("matrix: the bottom row is not 0 0 0 1")
    return matrix


class Node:
    """A place in a scene, with a mesh, camera or light. matrix: (4, 4), or rotation (x, y, z, w), scale, translation."""

    name = Checked(text)
    camera = Checked(optional(instance("camera", Camera, "a Camera")))
    mesh, light = Checked(optional(instance("mesh", Mesh, "a Mesh"))), Checked(optional(instance("light", Light, "a Light")))

    def __init__(self, name: Optional[str] = None, camera: Optional[Camera] = None,
                 children: Optional[List["Node"]] = None, skin: Any = None, matrix: Any = None,
                 mesh: Optional[Mesh] = None, rotation: Any = None, scale: Any = None, translation: Any = None,
                 weights: Any = None, light: Optional[Light] = None):  # fmt: skip
        self.name, self.camera, self.children, self.skin = name, camera, children or [], skin
        self.mesh, self.weights, self.light = mesh, weights, light
        self.matrix = np.eye(4) if matrix is None else matrix
        if matrix is None:
            for key, value in (("rotation", rotation), ("scale", scale), ("translation", translation)):
                if value is not None:
                    setattr(self, key, value)

    @property
    def matrix(self) -> Any:
        """(4, 4): a copy."""
        return self._matrix.copy()

    @matrix.setter
    def matrix(self, value: Any) -> None:
        self._matrix = _affine(value)
        self._parts: Any = None  # translation, rotation and scale, once they are needed

    def _part(self, number: int) -> Any:
        self._parts = self._parts or list(_split(self._matrix))
        return self._parts[number]

    def _set_part(self, number: int, value: Any) -> None:
        self._part(number)
        self._parts[number] = value
        self._matrix = _composed(*self._parts)

    @property
    def translation(self) -> Any:
        return self._part(0)

    @translation.setter
    def translation(self, value: Any) -> None:
        self._set_part(0, _vector("translation", value, 3))

    @property
    def rotation(self) -> Any:
        """(4,): a quaternion x, y, z, w."""
        return self._part(1)

    @rotation.setter
    def rotation(self, value: Any) -> None:
        quaternion = _vector("rotation", value, 4)
        if abs(np.linalg.norm(quaternion) - 1) > 1e-3:
            raise ValueError("rotation: a quaternion (x, y, z, w) of length 1 expected")
        self._set_part(1, quaternion)

    @property
    def scale(self) -> Any:
        return self._part(2)

    @scale.setter
    def scale(self, value: Any) -> None:
        self._set_part(2, _vector("scale", value, 3))
