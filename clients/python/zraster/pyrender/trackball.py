"""Trackball: poses of a camera from movements of the mouse."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np


def _turn(angle: float, axis: Any, point: Any) -> Any:
    """Returns the (4, 4) rotation by an angle about an axis through a point (Rodrigues)."""
    x, y, z = np.asarray(axis, np.float64) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)
    matrix[:3, 3] = point - matrix[:3, :3] @ point
    return matrix


def _shift(vector: Any) -> Any:
    matrix = np.eye(4)
    matrix[:3, 3] = vector
    return matrix


class Trackball:
    """A camera that moves around a target.

    pose: (4, 4), from camera to world; size: of the window in pixels; scale: diagonal of the scene, for the speed of pans
    """

    STATE_ROTATE, STATE_PAN, STATE_ROLL, STATE_ZOOM = range(4)

    def __init__(self, pose: Any, size: Any, scale: float, target: Any = (0.0, 0.0, 0.0)):
        self._start = self._pose = np.array(pose, np.float64)  # when the button was pressed, and now
        self._start_target = self._target = np.array(target, np.float64)
        self._scale, self._state = float(scale), Trackball.STATE_ROTATE
        self.resize(size)
        self.down((0, 0))

    @property
    def pose(self) -> Any:
        return self._pose

    def set_state(self, state: int) -> None:
        self._state = state

    def resize(self, size: Any) -> None:
        self._size = np.array(size)

    def down(self, point: Any) -> None:
        """Begins a drag at a pixel."""
        self._down = np.array(point, np.float64)
        self._start, self._start_target = self._pose, self._target

    def drag(self, point: Any) -> None:
        """Moves the camera by the way from the pixel of down()."""
        moves = {
            Trackball.STATE_ROTATE: self._rotated, Trackball.STATE_PAN: self._panned,
            Trackball.STATE_ROLL: self._rolled, Trackball.STATE_ZOOM: self._zoomed,
        }  # fmt: skip
        point = np.array(point, np.float64)
        self._pose = moves[self._state](point, *(point - self._down)) @ self._start

    def _rotated(self, _: Any, dx: float, dy: float) -> Any:
        step = 0.3 * self._size.min()
        about_y = _turn(-dx / step, self._start[:3, 1], self._start_target)
        return _turn(dy / step, self._start[:3, 0], self._start_target) @ about_y

    def _panned(self, _: Any, dx: float, dy: float) -> Any:
        step = self._scale / (1.5 * self._size.min())
        way = -step * (dx * self._start[:3, 0] + dy * self._start[:3, 1])
        self._target = self._start_target + way
        return _shift(way)

    def _rolled(self, point: Any, *_: float) -> Any:
        before, after = self._down - self._size / 2, point - self._size / 2
        angle = np.arctan2(before[1], before[0]) - np.arctan2(after[1], after[0])
        return _turn(angle, self._start[:3, 2], self._start_target)

    def _zoomed(self, _: Any, __: float, dy: float) -> Any:
        ratio = np.exp(abs(dy) / (0.5 * self._size[1])) - 1 if dy > 0 else 1 - np.exp(dy / (0.5 * self._size[1]))
        radius = np.linalg.norm(self._start[:3, 3] - self._start_target)
        return _shift(-np.sign(dy) * ratio * radius * self._start[:3, 2])

    def scroll(self, clicks: float) -> None:
        """Moves the camera towards the target: by a tenth of the distance per click."""
        for name in ("_start", "_pose"):
            pose = getattr(self, name)
            radius = np.linalg.norm(pose[:3, 3] - self._target)
            setattr(self, name, _shift((0.9**clicks - 1) * radius * pose[:3, 2]) @ pose)

    def rotate(self, azimuth: float, axis: Optional[Any] = None) -> None:
        """Turns the camera about an axis through the target. axis: default: the camera's y."""
        for name in ("_start", "_pose"):
            pose = getattr(self, name)
            setattr(self, name, _turn(azimuth, pose[:3, 1] if axis is None else axis, self._target) @ pose)
