"""Textures."""
from __future__ import annotations

import struct
import zlib
from typing import Any, Optional

import numpy as np

from ._checks import Checked, text
from .sampler import Sampler
from .utils import _image_array, format_texture_source


def _source(texture: Any, value: Any) -> Any:
    if value is None:
        return None
    if texture.source_channels is None:
        return _image_array(value, "RGBA")
    return format_texture_source(value, texture.source_channels)


class Texture:
    """An image: (h, w), (h, w, c) uint8 or float 0..1, or an image of PIL. Row 0 is the top.

    source_channels: the channels that are kept: "R", "RG", "GB", "RGB" or "RGBA"; None: all
    """

    name = Checked(text)
    sampler = Checked(lambda _, value: Sampler() if value is None else value)
    source = Checked(_source)

    def __init__(self, name: Optional[str] = None, sampler: Optional[Sampler] = None, source: Any = None,
                 source_channels: Optional[str] = None, width: Any = None, height: Any = None, tex_type: Any = None,
                 data_format: Any = None):  # fmt: skip
        self.source_channels = source_channels
        self.name, self.sampler, self.source = name, sampler, source
        self.width, self.height, self.tex_type, self.data_format = width, height, tex_type, data_format

    def smallest_alpha(self) -> float:
        """Returns the smallest alpha of the texels, 0..1; 1 without alpha."""
        has_alpha = self.source is not None and self.source.ndim == 3 and self.source.shape[2] == 4
        return float(self.source[:, :, 3].min()) / 255 if has_alpha else 1.0

    def is_transparent(self, cutoff: float = 1.0) -> bool:
        return self.smallest_alpha() < cutoff

    def delete(self) -> None:
        """Does nothing: there is no context to free."""

    def rgb(self) -> Any:
        """Returns (h, w, 3) or (h, w, 4) uint8: grey as three channels, two channels as G and B."""
        image = self.source if self.source.ndim == 3 else self.source[:, :, None]
        if image.shape[2] == 2:
            image = np.dstack([np.full(image.shape[:2], 255, np.uint8), image])
        return np.repeat(image, 3, axis=2) if image.shape[2] == 1 else image

    def png(self) -> bytes:
        """Returns the image as a PNG of RGB or RGBA."""
        image = self.rgb()
        height, width, channels = image.shape
        rows = np.zeros((height, 1 + width * channels), np.uint8)
        rows[:, 1:] = image.reshape(height, -1)

        def chunk(kind: bytes, data: bytes) -> bytes:
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        header = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)
        body = zlib.compress(rows.tobytes(), 1)
        return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b"")
