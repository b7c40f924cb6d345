"""Renderer: draws a Scene of pyrender.

Depth is in metres along the axis of the camera, at the centres of pixels; 0 for background pixels. Colours follow the
formulas of pyrender, but are encoded as sRGB instead of by a power of 1 / 2.2. They differ by a few steps of 255.
"""
from __future__ import annotations

import warnings
from typing import Any, Dict, Optional

from .._errors import Warning
from ._checks import Checked, number
from ._drawing import Drawing
from .constants import RenderFlags
from .scene import Node, Scene

_DATA = RenderFlags.DEPTH_ONLY | RenderFlags.SEG


class Renderer:
    """Draws pictures of viewport_width x viewport_height pixels. point_size: pixels. Any thread may use it."""

    viewport_width, viewport_height = (Checked(lambda _, value: int(value)) for _ in range(2))
    point_size = Checked(number)

    def __init__(self, viewport_width: int, viewport_height: int, point_size: float = 1.0):
        self.viewport_width, self.viewport_height, self.point_size = viewport_width, viewport_height, point_size

    def render(
        self, scene: Scene, flags: int = RenderFlags.NONE, seg_node_map: Optional[Dict[Node, Any]] = None
    ) -> Any:
        """Draws a scene.

        flags: RenderFlags, combined by |
        seg_node_map: with SEG, colours of nodes, 0..255; other nodes are not drawn
        Returns color, (h, w, 3) uint8 or, with RGBA, (h, w, 4), and depth, (h, w) float32; with DEPTH_ONLY, depth alone.
        Raises NotImplementedError for SHADOWS_POINT if the scene has point lights.
        """
        if scene.main_camera_node is None:
            raise ValueError("Cannot render scene without a camera")
        if flags & RenderFlags.SHADOWS_POINT and scene.point_lights and not flags & _DATA:
            raise NotImplementedError("point lights have no shadows, here as in pyrender: leave out SHADOWS_POINT")
        if flags & (RenderFlags.VERTEX_NORMALS | RenderFlags.FACE_NORMALS):
            warnings.warn("VERTEX_NORMALS and FACE_NORMALS draw nothing", Warning, stacklevel=2)
        size = (self.viewport_width, self.viewport_height)
        drawing = Drawing(scene, flags, seg_node_map or {}, size, self.point_size)
        if drawing.undrawn:
            warnings.warn(f"{', '.join(sorted(drawing.undrawn))}: not drawn", Warning, stacklevel=2)
        return drawing.depth() if flags & RenderFlags.DEPTH_ONLY else (drawing.color(), drawing.depth())

    def delete(self) -> None:
        """Does nothing: there is no context to free."""
