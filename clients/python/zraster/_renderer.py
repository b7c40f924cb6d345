"""Renderers and cancels."""
from __future__ import annotations

import json
import os
from ctypes import byref, c_void_p, sizeof
from typing import Any, Dict, Optional

from . import _library as c
from ._arrays import whole
from ._errors import MemoryLimitError, OptionError, expect, raise_status


class Cancel:
    """A flag that stops calls: pass it to `render`, and call `cancel()` in any thread. Calls under way then raise
    Cancelled, usually within 10 ms, and later calls at once."""

    def __init__(self) -> None:
        pointer = c.library.cancel_new()
        if not pointer:
            raise MemoryLimitError("the system has no memory for a cancel")
        self._handle = c.Handle(pointer, c.library.cancel_free)
        self._is_raised = False  # for calls of a server

    def cancel(self) -> None:
        self._is_raised = True
        c.library.cancel_raise(self._handle.pointer)


class Renderer:
    """Threads, limits, and memory kept for the next call. Any number of threads may use one at once.

    threads: number of threads that share the work of a call; 0: one per processor
    memory_max: bytes that a scene and the drawing of it may hold together, and its picture as many; 0: three quarters of
        what the machine, the control groups and limits of this process leave, at least 1 GiB
    memory_keep: bytes kept for the next calls; 0: 64 MiB
    Limits, as in GET /v1/limits; 0: the default: window_side_max (pixels), window_pixels_max, image_pixels_max,
    instances_max
    """

    def __init__(
        self,
        threads: int = 0,
        memory_max: int = 0,
        memory_keep: int = 0,
        *,
        window_side_max: int = 0,
        window_pixels_max: int = 0,
        image_pixels_max: int = 0,
        instances_max: int = 0,
    ) -> None:
        self._options: Dict[str, int] = {
            "threads": threads,
            "memory_max": memory_max,
            "memory_keep": memory_keep,
            "window_side_max": window_side_max,
            "window_pixels_max": window_pixels_max,
            "image_pixels_max": image_pixels_max,
            "instances_max": instances_max,
        }
        for name, value in self._options.items():
            bits = 8 * getattr(c.Options, name).size
            number = whole(value)
            if number is None or not 0 <= number < 1 << bits:
                raise OptionError(f"{name}: {value!r} is no whole number from 0 to 2^{bits} - 1")
            self._options[name] = number
        options = c.Options(struct_size=sizeof(c.Options), **self._options)
        pointer = c_void_p()
        status = c.library.open(byref(options), byref(pointer))
        if status != c.OK or not pointer.value:
            raise_status(status, c_void_p())
        self._handle = c.Handle(pointer.value, c.library.close)
        self._tables: Optional[Dict[str, Any]] = None

    def trim(self) -> None:
        """Returns kept memory to the system."""
        c.library.trim(self._handle.pointer)

    @property
    def tables(self) -> Dict[str, Any]:
        """Parameters, keys of scenes, looks, channels, formats and limits, as lists and dicts."""
        if self._tables is None:
            text = c.library.tables(self._handle.pointer)
            if not text:
                raise MemoryLimitError("the system has no memory for the tables")
            self._tables = json.loads(text)
        return self._tables

    @property
    def schema(self) -> Dict[str, Any]:
        """The JSON Schema (2020-12) of a scene."""
        text = c.library.schema(self._handle.pointer)
        if not text:
            raise MemoryLimitError("the system has no memory for the schema")
        return dict(json.loads(text))

    def __reduce__(self):  # type: ignore[no-untyped-def]
        return _open, (self._options,)


def _open(options: Dict[str, int]) -> Renderer:
    return Renderer(**options)


def given_or_shared(renderer: Optional[Renderer]) -> Renderer:
    if renderer is None:
        return shared()
    expect(isinstance(renderer, Renderer), "renderer", "a Renderer", renderer)
    return renderer


_shared: Dict[int, Renderer] = {}


def shared() -> Renderer:
    """Returns the process's renderer, made at the first call. A child process gets one of its own."""
    process = os.getpid()
    return _shared.get(process) or _shared.setdefault(process, Renderer())
