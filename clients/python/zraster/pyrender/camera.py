"""Cameras, which look along their -z axis. Their projection matrices are those of OpenGL."""
from __future__ import annotations

import abc
from typing import Any, Optional

import numpy as np

from ._checks import Checked, number, optional, positive, text
from .constants import DEFAULT_Z_FAR, DEFAULT_Z_NEAR


def _near(_: Any, value: Any) -> float:
    made = float(value)
    if made < 0:
        raise ValueError(f"znear must be >= 0, not {made}")
    return made


def _far(camera: Any, value: Any) -> float:
    made = float(value)
    if made <= 0 or made <= camera.znear:
        raise ValueError(f"zfar must be > 0 and > znear, not {made}")
    return made


def _planes(matrix: Any, near: float, far: Optional[float]) -> None:
    """Sets the rows of a perspective for z and w. far: None: infinite."""
    matrix[2, 2], matrix[2, 3] = (-1.0, -2.0 * near) if far is None else (
        (far + near) / (near - far), 2.0 * far * near / (near - far))  # fmt: skip
    matrix[3, 2] = -1.0


class Camera(abc.ABC):
    """Base of cameras. znear, zfar: planes in metres."""

    name, znear, zfar = Checked(text), Checked(_near), Checked(_far)

    def __init__(
        self, znear: float = DEFAULT_Z_NEAR, zfar: Optional[float] = DEFAULT_Z_FAR, name: Optional[str] = None
    ):
        self.name, self.znear, self.zfar = name, znear, zfar

    @abc.abstractmethod
    def get_projection_matrix(self, width: Any = None, height: Any = None) -> Any:
        """Returns the (4, 4) matrix for a viewport in pixels."""


class PerspectiveCamera(Camera):
    """yfov: whole vertical angle in radians; zfar None: infinite; aspectRatio None: the viewport's."""

    zfar, yfov, aspectRatio = Checked(optional(_far)), Checked(positive("yfov")), Checked(optional(positive("aspectRatio")))

    def __init__(self, yfov: float, znear: float = DEFAULT_Z_NEAR, zfar: Optional[float] = None,
                 aspectRatio: Optional[float] = None, name: Optional[str] = None):  # fmt: skip
        super().__init__(znear, zfar, name)
        self.yfov, self.aspectRatio = yfov, aspectRatio

    def get_projection_matrix(self, width: Any = None, height: Any = None) -> Any:
        if self.aspectRatio is None and (width is None or height is None):
            raise ValueError("the camera has no aspectRatio: width and height are needed")
        aspect = self.aspectRatio if self.aspectRatio is not None else float(width) / float(height)
        matrix = np.zeros((4, 4))
        tangent = np.tan(self.yfov / 2.0)
        matrix[0, 0], matrix[1, 1] = 1.0 / (aspect * tangent), 1.0 / tangent
        _planes(matrix, self.znear, self.zfar)
        return matrix


class OrthographicCamera(Camera):
    """ymag: half height in metres. The half width follows from the viewport; without a viewport, it is xmag."""

    znear, xmag, ymag = Checked(positive("znear")), Checked(positive("xmag")), Checked(positive("ymag"))

    def __init__(self, xmag: float, ymag: float, znear: float = DEFAULT_Z_NEAR, zfar: float = DEFAULT_Z_FAR,
                 name: Optional[str] = None):  # fmt: skip
        super().__init__(znear, zfar, name)
        self.xmag, self.ymag = xmag, ymag

    def get_projection_matrix(self, width: Any = None, height: Any = None) -> Any:
        near, far = self.znear, self.zfar
        half_width = self.xmag if width is None or height is None else width / height * self.ymag
        matrix = np.diag([1.0 / half_width, 1.0 / self.ymag, 2.0 / (near - far), 1.0])
        matrix[2, 3] = (far + near) / (near - far)
        return matrix


class IntrinsicsCamera(Camera):
    """A pinhole camera in pixels: fx, fy, cx, cy; (0, 0) is the top left corner of the picture."""

    zfar = Checked(optional(_far))
    fx, fy, cx, cy = (Checked(number) for _ in range(4))

    def __init__(self, fx: float, fy: float, cx: float, cy: float, znear: float = DEFAULT_Z_NEAR,
                 zfar: Optional[float] = DEFAULT_Z_FAR, name: Optional[str] = None):  # fmt: skip
        super().__init__(znear, zfar, name)
        self.fx, self.fy, self.cx, self.cy = fx, fy, cx, cy

    def get_projection_matrix(self, width: Any = None, height: Any = None) -> Any:
        matrix = np.zeros((4, 4))
        matrix[0, 0], matrix[0, 2] = 2.0 * self.fx / width, 1.0 - 2.0 * self.cx / width
        matrix[1, 1], matrix[1, 2] = 2.0 * self.fy / height, 2.0 * self.cy / height - 1.0
        _planes(matrix, self.znear, self.zfar)
        return matrix
