"""Lights, which shine along the -z axis of their node. Colours are linear light."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np


def format_color_vector(value: Any, length: int) -> Any:
    """Returns a colour of `length` floats. Integers are 0..255; missing ones are 1."""
    if isinstance(value, (int, np.integer)):
        value = float(value) / 255.0
    array = np.repeat(value, length) if np.ndim(value) == 0 else np.asarray(value).squeeze()
    if array.ndim != 1:
        raise ValueError("a colour is a number or a vector")
    if np.issubdtype(array.dtype, np.integer):
        array = array / 255.0
    array = np.concatenate([array, np.ones(max(0, length - len(array)))])[:length]
    return array.astype(np.float32)


class Light:
    """Base of lights."""

    def __init__(self, color: Any = None, intensity: Optional[float] = None, name: Optional[str] = None):
        self.name = name
        self.color = np.ones(3) if color is None else color
        self.intensity = 1.0 if intensity is None else float(intensity)

    @property
    def color(self) -> Any:
        return self._color

    @color.setter
    def color(self, value: Any) -> None:
        self._color = format_color_vector(value, 3)


class DirectionalLight(Light):
    """Parallel light of `intensity` lux."""


class PointLight(Light):
    """Light of `intensity` candela in all directions. `range` has no effect, as in pyrender."""

    def __init__(self, color: Any = None, intensity: Optional[float] = None, range: Optional[float] = None,
                 name: Optional[str] = None):  # fmt: skip
        super().__init__(color, intensity, name)
        self.range = range


class SpotLight(Light):
    """Light of `intensity` candela in a cone. innerConeAngle, outerConeAngle: radians from the axis."""

    def __init__(self, color: Any = None, intensity: Optional[float] = None, range: Optional[float] = None,
                 innerConeAngle: float = 0.0, outerConeAngle: float = np.pi / 4.0, name: Optional[str] = None):  # fmt: skip
        super().__init__(color, intensity, name)
        if not 0 <= innerConeAngle < outerConeAngle <= np.pi / 2 + 1e-9:
            raise ValueError("0 <= innerConeAngle < outerConeAngle <= pi / 2")
        self.range, self.innerConeAngle, self.outerConeAngle = range, float(innerConeAngle), float(outerConeAngle)
