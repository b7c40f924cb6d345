"""OffscreenRenderer: a Renderer, which has no window."""
from .renderer import Renderer


class OffscreenRenderer(Renderer):
    """Draws pictures of viewport_width x viewport_height pixels. point_size: pixels. Any thread may use it."""
