"""Technical drawings as SVG and PNG."""
from __future__ import annotations

import json
import os
import warnings
from ctypes import byref, c_void_p, string_at
from typing import Any, Dict, List, Mapping, Optional
from urllib.parse import urlencode

from . import _interrupt
from . import _library as c
from ._errors import OptionError, Warning, expect, raise_status
from ._renderer import Cancel, Renderer, given_or_shared
from ._request import make
from ._scene import Scene


class Drawing:
    """A technical drawing.

    data: bytes of the file
    type: "image/svg+xml" or "image/png"
    facts: summary in one line, page, scale, projection, units of the file, width, height and depth in millimetres, holes
    warnings: holes without a note, parts without a cap, and so on
    """

    def __init__(self, handle: c.Handle) -> None:
        found = c.library.drawing_file(handle.pointer)
        self.data: bytes = string_at(found.data, found.size)
        self.type: str = found.type.decode()
        self.facts: Dict[str, Any] = json.loads(c.library.drawing_json(handle.pointer))
        self.warnings: List[str] = []
        while True:
            text = c.library.drawing_warning(handle.pointer, len(self.warnings))
            if text is None:
                break
            self.warnings.append(text.decode())

    def save(self, path: Any) -> None:
        """Writes the file."""
        with open(path, "wb") as file:
            file.write(self.data)

    def _repr_svg_(self) -> Optional[str]:
        return self.data.decode() if self.type == "image/svg+xml" else None

    def _repr_png_(self) -> Optional[bytes]:
        return self.data if self.type == "image/png" else None

    def __repr__(self) -> str:
        return f"<zraster.Drawing: {self.type}, {len(self.data)} bytes>"


def _make(scene: c.Handle, query: str, cancel: Cancel) -> c.Handle:
    def run() -> c.Handle:
        made, error = c_void_p(), c_void_p()
        status = c.library.drawing_make(scene.pointer, query.encode(), cancel._handle.pointer, byref(made), byref(error))
        if status != c.OK or not made.value:
            raise_status(status, error)
        return c.Handle(made.value, c.library.drawing_free)

    result: c.Handle = _interrupt.run(run, cancel)
    return result


def drawing(
    source: Any,
    *,
    page: Optional[str] = None,
    scale: Optional[str] = None,
    projection: Optional[str] = None,
    section: Optional[str] = None,
    hidden: Optional[bool] = None,
    title: Optional[str] = None,
    date: Optional[str] = None,
    format: Optional[str] = None,
    dpi: Optional[float] = None,
    parts: Optional[Mapping[str, Any]] = None,
    root: Any = None,
    renderer: Optional[Renderer] = None,
    cancel: Optional[Cancel] = None,
    **options: Any,
) -> Drawing:
    """Makes a technical drawing: front, top, right and isometric view at one standard scale, sizes, holes, title block.

    source: as for `render`, or a Scene
    page: "a4" or "a3" (default)
    scale: such as "1:2"; default: the largest standard one that fits
    projection: "third" (default) or "first" angle
    section: section A-A across "x", "y" or "z" of world space, with a share of the bounds such as "x:0.3"
    hidden: hidden lines in dashes; default: True
    title, date: texts of the title block; default: the name of the file, and none
    format, dpi: "svg" (default), or "png" with pixels per inch (default: 150)
    parts, root, renderer, cancel: as for `render`
    options: parameters of reading, such as up="y" and hide=["bolt*"]

    >>> zraster.drawing("part.stl", page="a4", section="x").save("part.svg")
    """
    expect(cancel is None or isinstance(cancel, Cancel), "cancel", "a Cancel", cancel)
    if isinstance(source, Scene):
        if source._handle is None:
            raise OptionError("source: the scene is closed, or a server's")
        scene = source._handle
    else:
        request = make(source, None, None, parts, {**options, "root": root})
        for line in request.warnings:
            warnings.warn(line, Warning, stacklevel=2)
        scene = request.read_scene(given_or_shared(renderer))
        if title is None and isinstance(source, (str, os.PathLike)):
            title = os.path.basename(os.fspath(source))
    given: Dict[str, Any] = {
        "page": page, "scale": scale, "projection": projection, "section": section, "title": title, "date": date,
        "format": format, "dpi": dpi, "hidden": None if hidden is None else str(bool(hidden)).lower(),
    }  # fmt: skip
    query = urlencode({name: str(value) for name, value in given.items() if value is not None})
    return Drawing(_make(scene, query, cancel or Cancel()))
