"""Colours and images as arrays."""
from __future__ import annotations

from typing import Any

import numpy as np


def _fractions(array: Any) -> Any:
    """Returns integers 0..255 as floats 0..1, and floats as they are."""
    return array / 255.0 if np.issubdtype(array.dtype, np.integer) else array


def format_color_vector(value: Any, length: int) -> Any:
    """Returns a colour of `length` floats. Integers are 0..255; missing components are 1."""
    if isinstance(value, (int, float, np.number)):
        value = np.repeat(float(value) / 255.0 if isinstance(value, (int, np.integer)) else value, length)
    if not isinstance(value, (list, tuple, np.ndarray)) and not hasattr(value, "__array__"):
        raise ValueError(f"a colour is a number or a vector, not {type(value).__name__}")
    array = _fractions(np.asarray(value).squeeze())
    if array.ndim != 1:
        raise ValueError("a colour is a number or a vector")
    return np.concatenate([array, np.ones(max(0, length - len(array)))])[:length].astype(np.float32)


def format_color_array(value: Any, shape: Any) -> Any:
    """Returns (n, components) floats of one colour or of n colours. Integers are 0..255."""
    array = _fractions(np.asanyarray(value))
    if array.ndim == 1:
        array = np.tile(array, (shape[0], 1))
    missing = np.ones((len(array), max(0, shape[1] - array.shape[1])))
    return np.hstack([array, missing])[:, : shape[1]].astype(np.float32)


def _image_array(image: Any, channels: str) -> Any:
    """Returns (h, w) or (h, w, c) uint8 of an array or of an image of PIL. Palettes and the like are converted."""
    if getattr(image, "mode", None) in ("P", "1", "CMYK", "LA", "PA") and channels in ("RGB", "RGBA"):
        image = image.convert(channels)
    if not hasattr(image, "__array__") and not hasattr(image, "__array_interface__"):
        raise TypeError(f"a texture is an array or an image of PIL, not {type(image).__name__}")
    array = np.asarray(image)
    if np.issubdtype(array.dtype, np.floating):
        array = array * 255.0
    elif not np.issubdtype(array.dtype, np.integer):
        raise TypeError(f"a texture has numbers, not {array.dtype}")
    if array.ndim not in (2, 3):
        raise ValueError(f"a texture has the shape (h, w) or (h, w, c), not {array.shape}")
    return array.astype(np.uint8)


_PICKED = {"R": (0,), "RG": (0, 1), "GB": (1, 2), "RGB": (0, 1, 2), "RGBA": (0, 1, 2, 3)}


def format_texture_source(texture: Any, target_channels: str = "RGB") -> Any:
    """Returns the channels "R", "RG", "GB", "RGB" or "RGBA" of an image as uint8. A missing alpha is 255."""
    if texture is None:
        return None
    array = _image_array(texture, target_channels)
    if target_channels not in _PICKED:
        raise ValueError(f"invalid channels of a texture: {target_channels}")
    if target_channels == "R":
        return array if array.ndim == 2 else array[:, :, 0]
    array = array.reshape(*array.shape[:2], -1)
    wanted = _PICKED[target_channels]
    if array.shape[2] == 1:
        array = np.repeat(array, min(3, len(wanted)), axis=2)
    elif array.shape[2] == 2:
        if len(wanted) > 2:
            raise ValueError(f"a texture with 2 channels is not {target_channels}")
        return array
    if target_channels == "RGBA" and array.shape[2] == 3:
        array = np.dstack([array, np.full(array.shape[:2], 255, np.uint8)])
    return array if array.shape[2] == len(wanted) else array[:, :, wanted]
