"""Requests: a body with its parts and parameters, and the keys that change it."""
from __future__ import annotations

import copy
import json
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


OF_OUTPUTS = {"render", "visibility", "features", "picks"}  # parameters that are checked with the outputs
SEVERAL = {"views", "turntable", "orbit", "animate", "frames", "sheet"}  # keys and parameters


def _pose(scene: Dict[str, Any], poses: Dict[str, Any]) -> None:
    nodes = [dict(node) for node in scene.get("nodes", ())]
    for name, matrix in poses.items():
        named = [node for node in nodes if node.get("name") == name]
        if not named:
            raise SceneError(f"/poses/{name}: no node has this name", [(f"/poses/{name}", "no node has this name")])
        for node in named:
            for key in ("translation", "rotation", "scale"):
                node.pop(key, None)
            node["matrix"] = matrix
    scene["nodes"] = nodes


def outputs_query(outputs: List[Dict[str, Any]]) -> Dict[str, str]:
    """Returns the parameters that give these outputs of a mesh."""
    query = {"channel": ",".join(str(output["channel"]) for output in outputs)}
    for name, value in ((name, value) for output in outputs for name, value in output.items() if name != "channel"):
        text = str(value).lower() if isinstance(value, bool) else str(value)
        if query.setdefault(name, text) != text:
            raise OptionError(f"channels: several views of a mesh have one {name}, not {query[name]} and {text}")
    return query


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

    def merged(self, query: Dict[str, str], keys: Dict[str, Any]) -> "Request":
        """Returns a request with more parameters and keys, all in its body and query, as servers and several views need it."""
        made = copy.copy(self)
        made.query, made.keys, made.parts = {**self.query, **query}, {}, Parts(self.parts.named)
        made.parts.optional = set(self.parts.optional)
        if self.source.is_mesh:
            rest = dict(keys)
            if "outputs" in rest:
                made.query.update(outputs_query(rest.pop("outputs")))
            if rest:
                raise OptionError(f"{', '.join(rest)}: several views of a mesh have parameters only; zraster.options() lists them")
            return made
        if not keys:
            return made
        try:
            scene = json.loads(self.body)
        except ValueError:
            return made  # the renderer reports the fault
        if not isinstance(scene, dict):
            raise SceneError("the scene is no JSON object")
        scene.update({key: value for key, value in keys.items() if key != "poses"})
        if "poses" in keys:
            _pose(scene, keys["poses"])
        made.body = dump(scene, made.parts)
        return made

    def _may_be_several(self) -> bool:
        """True if keywords ask for several views, or the text of a scene may do so: a change would drop its views."""
        if not SEVERAL.isdisjoint([*self.keys, *self.query]):
            return True
        return not self.source.is_mesh and any(f'"{key}"'.encode() in self.body for key in SEVERAL)

    def draw(self, renderer: Renderer, cancel: Optional[Cancel]) -> Picture:
        if self.keys and self._may_be_several():
            return self.merged({}, self.keys).draw(renderer, cancel)
        if self.keys:  # some of which the parameters of outputs need
            late = {name: value for name, value in self.query.items() if name in OF_OUTPUTS}
            first = copy.copy(self)
            first.query = {name: value for name, value in self.query.items() if name not in late}
            return draw_change(first.read_scene(renderer), self.keys, late, cancel)
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
