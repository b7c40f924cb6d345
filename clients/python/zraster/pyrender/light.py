"""Lights, which shine along the -z axis of their node. Colours are linear light."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._checks import Checked, between, number, optional, positive, text
from .utils import format_color_vector


class Light:
    """Base of lights."""

    name, intensity = Checked(text), Checked(number)
    color = Checked(lambda _, value: format_color_vector(value, 3))

    def __init__(self, color: Any = None, intensity: Optional[float] = None, name: Optional[str] = None):
        self.name = name
        self.color = np.ones(3) if color is None else color
        self.intensity = 1.0 if intensity is None else intensity


class DirectionalLight(Light):
    """Parallel light of `intensity` lux."""


class PointLight(Light):
    """Light of `intensity` candela in all directions. `range` has no effect, as in pyrender."""

    range = Checked(optional(positive("range")))

    def __init__(self, color: Any = None, intensity: Optional[float] = None, range: Optional[float] = None,
                 name: Optional[str] = None):  # fmt: skip
        super().__init__(color, intensity, name)
        self.range = range


def _inner(light: Any, value: Any) -> Any:
    return between("innerConeAngle", 0.0, light.outerConeAngle)(light, value)


class SpotLight(Light):
    """Light of `intensity` candela in a cone. innerConeAngle, outerConeAngle: radians from the axis."""

    range = Checked(optional(positive("range")))
    innerConeAngle, outerConeAngle = Checked(_inner), Checked(between("outerConeAngle", 0.0, np.pi / 2 + 1e-9))

    def __init__(self, color: Any = None, intensity: Optional[float] = None, range: Optional[float] = None,
                 innerConeAngle: float = 0.0, outerConeAngle: float = np.pi / 4.0, name: Optional[str] = None):  # fmt: skip
        super().__init__(color, intensity, name)
        self.range, self.outerConeAngle, self.innerConeAngle = range, outerConeAngle, innerConeAngle
