"""Loads libzraster and declares the functions of zraster.h."""
from __future__ import annotations

import ctypes
import os
from ctypes import POINTER, c_char_p, c_int, c_size_t, c_uint32, c_uint64, c_void_p
from typing import Any

SONAME = "libzraster.so.0"

# enum zraster_status
OK, BAD_SYNTAX, BAD_TYPE, BAD_REQUEST, BAD_SCENE, NO_MEMORY, CANCELLED, INTERNAL = range(8)
# Types of numbers: their names in numpy, in the order of zraster.h
BYTES = 0
OPTIONAL = 2  # flag of a part
NUMBERS = ("", "f4", "f8", "u1", "i4", "u4", "i8", "u8")


class Array(ctypes.Structure):
    """struct zraster_array"""

    _fields_ = [("data", c_void_p), ("type", c_uint32), ("ndim", c_uint32), ("shape", c_size_t * 4)]


class Part(ctypes.Structure):
    """struct zraster_part"""

    _fields_ = [("name", c_char_p), ("array", Array), ("flags", c_uint32)]


class Request(ctypes.Structure):
    """struct zraster_request"""

    _fields_ = [
        ("struct_size", c_size_t),
        ("body", c_char_p),
        ("body_size", c_size_t),
        ("type", c_char_p),
        ("query", c_char_p),
        ("parts", POINTER(Part)),
        ("part_count", c_size_t),
        ("cancel", c_void_p),
    ]


class Options(ctypes.Structure):
    """struct zraster_options"""

    _fields_ = [
        ("struct_size", c_size_t),
        ("memory_max", c_size_t),
        ("memory_keep", c_size_t),
        ("threads", c_uint32),
        ("window_side_max", c_uint32),
        ("window_pixels_max", c_uint64),
        ("image_pixels_max", c_uint64),
        ("instances_max", c_uint32),
    ]


class Bytes(ctypes.Structure):
    """struct zraster_bytes"""

    _fields_ = [("data", c_void_p), ("size", c_size_t), ("type", c_char_p)]


class File(ctypes.Structure):
    """struct zraster_file"""

    _fields_ = [("name", c_char_p), ("data", c_void_p), ("size", c_size_t), ("type", c_char_p)]


class View(ctypes.Structure):
    """struct zraster_view"""

    _fields_ = [
        ("struct_size", c_size_t),
        ("number", c_uint32),
        ("count", c_uint32),
        ("file_count", c_size_t),
        ("files", POINTER(File)),
        ("warning_count", c_size_t),
        ("warnings", POINTER(c_char_p)),
    ]


TakeView = ctypes.CFUNCTYPE(c_int, c_void_p, POINTER(View))

_FUNCTIONS = {  # name: result, arguments
    "error_text": (c_char_p, c_void_p),
    "error_count": (c_size_t, c_void_p),
    "error_pointer": (c_char_p, c_void_p, c_size_t),
    "error_detail": (c_char_p, c_void_p, c_size_t),
    "error_free": (None, c_void_p),
    "open": (c_int, POINTER(Options), POINTER(c_void_p)),
    "trim": (None, c_void_p),
    "close": (None, c_void_p),
    "cancel_new": (c_void_p,),
    "cancel_raise": (None, c_void_p),
    "cancel_free": (None, c_void_p),
    "draw": (c_int, c_void_p, POINTER(Request), POINTER(c_void_p), POINTER(c_void_p)),
    "draw_views": (c_int, c_void_p, POINTER(Request), TakeView, c_void_p, POINTER(c_void_p)),
    "scene_read": (c_int, c_void_p, POINTER(Request), POINTER(c_void_p), POINTER(c_void_p)),
    "scene_draw": (c_int, c_void_p, POINTER(Request), POINTER(c_void_p), POINTER(c_void_p)),
    "scene_free": (None, c_void_p),
    "picture_encode": (c_int, c_void_p, c_char_p, POINTER(Bytes), POINTER(c_void_p)),
    "picture_channel": (c_int, c_void_p, c_char_p, POINTER(Array)),
    "picture_has_alpha": (c_int, c_void_p),
    "picture_look": (c_char_p, c_void_p),
    "picture_warning": (c_char_p, c_void_p, c_size_t),
    "picture_free": (None, c_void_p),
    "compare": (c_int, c_void_p, c_void_p, c_char_p, c_void_p, POINTER(c_void_p), POINTER(c_void_p)),
    "comparison_json": (c_char_p, c_void_p),
    "comparison_same": (c_int, c_void_p),
    "comparison_scene": (c_void_p, c_void_p),
    "comparison_free": (None, c_void_p),
    "drawing_make": (c_int, c_void_p, c_char_p, c_void_p, POINTER(c_void_p), POINTER(c_void_p)),
    "drawing_file": (Bytes, c_void_p),
    "drawing_json": (c_char_p, c_void_p),
    "drawing_warning": (c_char_p, c_void_p, c_size_t),
    "drawing_free": (None, c_void_p),
    "references": (c_size_t, c_char_p, c_size_t, c_char_p, c_char_p, c_size_t),
    "version": (c_char_p,),
    "rules": (c_uint32,),
    "tables": (c_char_p, c_void_p),
    "schema": (c_char_p, c_void_p),
}


def _load() -> ctypes.CDLL:
    """Loads the library of ZRASTER_LIBRARY, else the one beside this file (wheels), else the system's."""
    given = os.environ.get("ZRASTER_LIBRARY")
    beside = os.path.join(os.path.dirname(__file__), SONAME)
    path = given or (beside if os.path.exists(beside) else SONAME)
    try:
        return ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(
            f"zraster: {error}. Install the wheel or the package libzraster0, or set ZRASTER_LIBRARY to {SONAME}"
        ) from None


class _Functions:
    """The functions of zraster.h without their prefix. All release the interpreter lock."""

    def __init__(self) -> None:
        library = _load()
        for name, (result, *arguments) in _FUNCTIONS.items():
            function = getattr(library, "zraster_" + name)
            function.restype, function.argtypes = result, arguments
            setattr(self, name, function)

    def __getattr__(self, name: str) -> Any:  # for type checkers
        raise AttributeError(name)


library = _Functions()


class Handle:
    """An object of the library, freed with its last reference. It keeps the function that frees it, so that it can
    be freed while the interpreter ends."""

    pointer = 0  # until __init__ has run, which an exception of a handler may prevent

    def __init__(self, pointer: int, free: Any) -> None:
        self._free = free
        self.pointer = pointer

    def __del__(self) -> None:
        if self.pointer:
            self._free(self.pointer)
