"""Filters and wraps of textures."""
from __future__ import annotations

from typing import Any, Optional

from ._checks import Checked, text
from .constants import GLTF


class Sampler:
    """Filters and wraps, as numbers of GLTF."""

    name = Checked(text)

    def __init__(self, name: Optional[str] = None, magFilter: Any = None, minFilter: Any = None,
                 wrapS: Any = GLTF.REPEAT, wrapT: Any = GLTF.REPEAT):  # fmt: skip
        self.name, self.magFilter, self.minFilter, self.wrapS, self.wrapT = name, magFilter, minFilter, wrapS, wrapT
