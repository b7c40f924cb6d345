"""Requests: a body with its parts and parameters, and the keys that change it."""
from __future__ import annotations

import os
from ctypes import byref, c_void_p, sizeof
from typing import Any, Callable, Dict, List, Optional
from urllib.parse import urlencode

from . import _library as c
from . import _interrupt, _neighbours, _options
from ._arrays import Parts, dump
from ._errors import OptionError, OptionTypeError, SceneError, expect, raise_status
from ._picture import Drawn, Picture
from ._renderer import Cancel, Renderer
from ._source import Source, read


def view_of(view: Any) -> Any:
    """Converts "front", or a 4x4 matrix cameraToWorld, to a view."""
    if isinstance(view, str):
        return {"preset": view}
    if view is None or isinstance(view, dict):
        return view
    if getattr(view, "ndim", 0) == 2 or isinstance(view, (list, tuple)):
        return {"cameraToWorld": view}
    raise OptionTypeError("view: give a dict as in the scene format, a preset such as 'front', or a 4x4 matrix")


class Call:
    """A struct zraster_request, and the objects that it points to."""

    def __init__(
        self, body: bytes, type_: Optional[str], query: Dict[str, str], parts: Parts, cancel: Optional[Cancel]
    ):
        self.struct = c.Request(struct_size=sizeof(c.Request), body=body, body_size=len(body))
        if type_:
            self.struct.type = type_.encode()
        if query:
            self.struct.query = urlencode(query).encode()
        self.kept = parts.fill(self.struct) if parts else None
        expect(cancel is None or isinstance(cancel, Cancel), "cancel", "a Cancel", cancel)
        self.cancel = cancel or Cancel()  # Ctrl-C needs one
        self.struct.cancel = self.cancel._handle.pointer

    def run(self, function: Callable[..., int], target: c.Handle, free: Any) -> c.Handle:
        made: c.Handle = _interrupt.run(lambda: self._run(function, target, free), self.cancel)
        return made

    def _run(self, function: Callable[..., int], target: c.Handle, free: Any) -> c.Handle:
        made, error = c_void_p(), c_void_p()
        status = function(target.pointer, byref(self.struct), byref(made), byref(error))
        if status != c.OK or not made.value:
            raise_status(status, error)
        return c.Handle(made.value, free)


class Request:
    """A body with parameters. keys: keys of a scene that change it after it is read; none for a dict, which has them."""

    def __init__(self, source: Source, parts: Parts, query: Dict[str, str], keys: Dict[str, Any]) -> None:
        self.source = source.without_geometry()
        self.type, self.parts, self.query = source.type, parts, query
        self.keys = {} if source.scene is not None else keys
        self.scene = {**source.scene, **keys} if source.scene is not None else None
        self.body = source.body if source.body is not None else dump(self.scene, parts)
        self.warnings: List[str] = []  # of files that are not read

    def read_scene(self, renderer: Renderer) -> c.Handle:
        call = Call(self.body, self.type, self.query, self.parts, None)
        return call.run(c.library.scene_read, renderer._handle, c.library.scene_free)

    def draw(self, renderer: Renderer, cancel: Optional[Cancel]) -> Picture:
        if self.keys:
            return draw_change(self.read_scene(renderer), self.keys, {}, cancel)
        call = Call(self.body, self.type, self.query, self.parts, cancel)
        return Picture(Drawn(call.run(c.library.draw, renderer._handle, c.library.picture_free)))


def draw_change(scene: c.Handle, keys: Dict[str, Any], query: Dict[str, str], cancel: Optional[Cancel]) -> Picture:
    """Draws a scene that was read, with other keys and parameters."""
    parts = Parts()
    call = Call(dump(keys, parts) if keys else b"{}", "json", query, parts, cancel)
    return Picture(Drawn(call.run(c.library.scene_draw, scene, c.library.picture_free)))


def make(source: Any, channels: Any, size: Any, parts: Any, options: Dict[str, Any]) -> Request:
    """Makes a request of a source and keywords."""
    if "view" in options:
        options["view"] = view_of(options["view"])
    found, root, all_parts = read(source, options.pop("type", None)), options.pop("root", None), Parts(parts)
    query, keys = _options.split(options, channels, size, found)
    lines: List[str] = []
    if isinstance(source, (str, os.PathLike)) and found.body is not None:
        path = os.fspath(source)
        files, lines = _neighbours.read(path, found.body, found.type, root, all_parts.named)
        all_parts.add_optional(files)
    elif root is not None:
        raise OptionError("root: for a source that is a path")
    if lines and query.get("strict") == "true":
        raise SceneError("\n".join(lines))
    request = Request(found, all_parts, query, keys)
    request.warnings = lines
    return request
