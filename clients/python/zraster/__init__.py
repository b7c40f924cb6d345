"""Renders 3D scenes and meshes to pictures, depth, normals and ids, within this process, without a GPU or a display.

>>> import zraster
>>> zraster.render("part.stl", look="technical", size=(800, 600)).save("part.png")
>>> picture = zraster.render(scene, ["color", "depth"])  # scene: a dict as in server/api/v1.md, arrays for lists
>>> picture["depth"]  # (h, w) float32, scene units
"""
from __future__ import annotations

import importlib as _importlib
import warnings as _warnings
from typing import Any, Mapping, Optional

from . import _library, _server
from ._comparison import Comparison, compare
from ._drawing import Drawing, drawing
from ._errors import (
    Cancelled,
    Error,
    Fault,
    InternalError,
    MemoryLimitError,
    OptionError,
    OptionTypeError,
    SceneError,
    ServerError,
    Warning,
)
from ._options import Channels as _Channels
from ._options import options
from ._picture import Picture
from ._renderer import Cancel, Renderer, given_or_shared
from ._request import make as _make
from ._scene import Scene
from ._views import Views

__all__ = [
    "Cancel", "Cancelled", "Comparison", "Drawing", "Error", "Fault", "InternalError", "MemoryLimitError", "OptionError", "OptionTypeError",
    "Picture", "Renderer", "Scene", "SceneError", "ServerError", "Views", "Warning", "compare", "drawing", "options", "render", "rules",
]  # fmt: skip

__version__: str = _library.library.version().decode()


_MODULES = ("bop", "coco", "mujoco", "pyrender", "trimesh")  # loaded once they are named


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return _importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def rules() -> int:
    """Returns the number of the drawing rules, which rises when the same scene gets other pixels."""
    return int(_library.library.rules())


def render(
    source: Any,
    channels: Optional[_Channels] = None,
    *,
    size: Any = None,
    view: Any = None,
    parts: Optional[Mapping[str, Any]] = None,
    root: Any = None,
    renderer: Optional[Renderer] = None,
    cancel: Optional[Cancel] = None,
    server: Optional[str] = None,
    **options: Any,
) -> Picture:
    """Draws a file, bytes, a scene or a mesh.

    source: a path (STL, OBJ, PLY, glTF, GLB, 3MF, ZIP, JSON); the bytes of such a file; a dict as in the scene format, with arrays in place of
        lists; or an object with `vertices` (n, 3) and `faces` (m, 3), such as those of trimesh and Open3D
    channels: "depth", or a list such as ["color", "depth", {"channel": "normals", "space": "world"}]; default: color,
        or the outputs of the scene
    size: (width, height) in pixels, or one number for both; default: (640, 480), or the scene's window
    view: a dict as in the scene format, a preset such as "front", or a 4x4 matrix from camera to world
    parts: bytes or arrays by name; a scene refers to them by {"asset": name}, glTF by a path
    root: folder of the files that a path's file may refer to, such as textures; default: its own. They are read as
        parts. Files outside of it cause a warning
    renderer: threads and limits of its own; default: one renderer that the process shares
    cancel: a flag that ends the call. Ctrl-C, and other signals whose handlers raise, end a call of the main thread,
        and raise this flag
    server: "http://host:port" of a daemon that draws instead, with the same keywords and bytes. ZRASTER_TOKEN is its token
    options: parameters and keys of scenes in snake_case, such as look="technical", samples=16; options() lists all.
        They replace keys of a scene. Those of the camera (preset, azimuth, padding, ...) make a view, which for scenes
        and objects is orthographic by default

    Raises SceneError (.pointer, .faults), OptionError, OptionTypeError, MemoryLimitError, Cancelled, ServerError, and
    OSError for files.
    Issues zraster.Warning at the caller's line for each problem that does not stop the render.

    >>> zraster.render("part.stl", look="clay").save("part.png")
    """
    request = _make(source, channels, size, parts, {**options, "view": view, "root": root})
    if server is not None:
        picture = _server.render(server, request, request.query, request.keys, cancel)
    else:
        picture = request.draw(given_or_shared(renderer), cancel)
    for line in request.warnings:
        _warnings.warn(line, Warning, stacklevel=2)
    picture._warn(3)
    return picture
