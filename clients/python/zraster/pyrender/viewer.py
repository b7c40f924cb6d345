"""Viewer, which is left out."""
from typing import Any


class Viewer:
    """Raises NotImplementedError."""

    def __init__(self, *_: Any, **__: Any):
        raise NotImplementedError("zraster opens no window: save a picture of OffscreenRenderer instead")
