"""Scenes that are read once and drawn many times."""
from __future__ import annotations

import json
import warnings
from collections.abc import Mapping as AbstractMapping
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

from . import _library as c
from . import _options, _server
from ._arrays import as_list, is_array, whole
from ._errors import OptionError, Warning, expect
from ._picture import Picture
from ._renderer import Cancel, Renderer, given_or_shared
from ._request import Request, draw_change, make, view_of
from ._views import Views


class Scene:
    """A scene that is read once and drawn many times, with other views, poses and looks.

    source, size, view, parts, root, renderer, server, options: as for `render`; they apply to each picture that does not
    give its own. Arrays are copied, so later changes to them have no effect. Any number of threads may draw a scene at
    once. It works in a child process after fork. A pickled scene is read again when it is loaded.

    >>> scene = zraster.Scene({"meshes": [{"name": "arm", "positions": positions, "faces": faces}], "nodes": [...]})
    >>> for matrix in matrices:
    ...     depth = scene.render("depth", poses={"arm": matrix})["depth"]
    """

    def __init__(
        self,
        source: Any,
        *,
        size: Any = None,
        view: Any = None,
        parts: Optional[Mapping[str, Any]] = None,
        renderer: Optional[Renderer] = None,
        server: Optional[str] = None,
        **options: Any,
    ) -> None:
        request = make(source, None, size, parts, {**options, "view": view})
        for line in request.warnings:
            warnings.warn(line, Warning, stacklevel=2)
        request.parts.own()
        self._state: Tuple[Request, Optional[Renderer], Optional[str]] = (request, renderer, server)
        self._handle: Optional[c.Handle] = None
        self._read()

    def _read(self) -> None:
        request, renderer, server = self._state
        if server is None:
            self._handle = request.read_scene(given_or_shared(renderer))

    def render(
        self,
        channels: Optional[_options.Channels] = None,
        *,
        size: Any = None,
        view: Any = None,
        poses: Optional[Mapping[str, Any]] = None,
        out: Optional[Dict[str, Any]] = None,
        cancel: Optional[Cancel] = None,
        **options: Any,
    ) -> Any:
        """Draws the scene with other keys; meshes are not read again.

        channels: such as ["color", "depth", "instanceId"]; else those of the scene
        size, view: as for `render`
        poses: 4x4 matrices of nodes by name, which replace those of the scene
        out: dict of arrays by channel, which are filled and returned instead of a Picture. Their shapes and types are
            those of `view`; without `channels`, their names are the channels
        options: each key of the scene, in snake_case, replaces the scene's own
        Returns a Picture, or `out`. Raises and warns as `render` does.
        """
        expect(out is None or isinstance(out, AbstractMapping), "out", "a dict of arrays by channel", out)
        if out is not None and channels is None:
            channels = list(out)
        picture = self._draw(channels, size, poses, cancel, {**options, "view": view_of(view)})
        picture._warn(3)
        return picture if out is None else _fill(out, picture)

    def _draw(self, channels: Any, size: Any, poses: Any, cancel: Any, options: Dict[str, Any]) -> Picture:
        request, _, server = self._state
        handle = self._handle  # close() in another thread then frees it after this call
        if handle is None and server is None:
            raise OptionError("the scene is closed")
        query, keys = _options.split(options, channels, size, request.source)
        keys = {**request.keys, **keys}
        keys.update(_poses(poses))
        if server is not None:
            return _server.render(server, request, {**request.query, **query}, keys, cancel)
        return draw_change(handle, keys, query, cancel)  # type: ignore[arg-type]

    # ---- several views ----

    def views(
        self, views: Sequence[Any] = ("front", "top", "right", "isometric"), channels: Optional[_options.Channels] = None, **options: Any
    ) -> Views:
        """Draws several views by one request, which reads the scene once more.

        views: presets such as "front", or dicts with a name and the keys that the view changes, as in the scene format
        channels, options, such as size and poses: as for `render`
        Returns Views: a sequence of Pictures, which notebooks show as a sheet.

        >>> scene.views(["front", {"name": "high", "view": {"azimuthDegrees": 30, "elevationDegrees": 60}}]).save("views/")
        """
        is_list = isinstance(views, (list, tuple)) and len(views) > 0
        expect(is_list, "views", "a list of presets such as 'front', or of dicts", views)
        return self._several([_view_name(i, view) for i, view in enumerate(views)], False, channels, {**options, "views": list(views)})

    def turntable(
        self,
        frames: int = 36,
        channels: Optional[_options.Channels] = None,
        *,
        elevation: Optional[float] = None,
        seconds: Optional[float] = None,
        **options: Any,
    ) -> Views:
        """Draws views from around the scene, in equal steps.

        elevation: degrees; default: that of the scene's view
        seconds: time of a turn in the animation; default: 4
        channels, options: as for `views`. Returns Views, which notebooks show as an animation.

        >>> scene.turntable(look="clay").save("turn.webp")
        """
        turn = {"turntable": frames, "turntable_elevation": elevation, "turntable_seconds": seconds}
        return self._several(_numbers(frames), True, channels, {**options, **turn})

    def orbit(self, count: int, channels: Optional[_options.Channels] = None, *, distance: Optional[float] = None, **options: Any) -> Views:
        """Draws views from all directions, such as those of a data set.

        distance: from the cameras to the target; fitted by default
        channels, options: as for `views`. Returns Views.
        """
        return self._several(_numbers(count), False, channels, {**options, "orbit": count, "orbit_distance": distance})

    def _several(self, names: List[str], is_turn: bool, channels: Any, options: Dict[str, Any]) -> Views:
        size, poses, cancel = (options.pop(name, None) for name in ("size", "poses", "cancel"))
        view = view_of(options.pop("view", None))

        def draw(outputs: Any, **more: Any) -> Picture:
            request, renderer, server = self._state
            given = {**options, "view": view, **more}
            query, keys = _options.split(given, outputs, given.pop("size", size), request.source)
            keys = {**request.keys, **keys, **_poses(poses)}
            if server is not None:
                return _server.render(server, request, {**request.query, **query}, keys, cancel)
            return request.merged(query, keys).draw(given_or_shared(renderer), cancel)

        return Views(names, is_turn, channels, draw)

    def _source(self) -> Tuple[Any, Dict[str, Any], Optional[Renderer]]:
        """Returns the scene as a dict, with its parts and its renderer, for requests of their own."""
        request, renderer, _ = self._state
        if request.source.is_mesh:
            raise OptionError("a Scene of a model: give its path instead")
        merged = request.merged({}, request.keys)
        return json.loads(merged.body), merged.parts.named, renderer

    def close(self) -> None:
        """Frees the scene; its pictures stay valid."""
        self._handle = None

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __getstate__(self) -> Any:
        return self._state

    def __setstate__(self, state: Any) -> None:
        self._state, self._handle = state, None
        self._read()


def _poses(poses: Any) -> Dict[str, Any]:
    """Returns the key of a change for matrices of nodes, if there are any."""
    is_dict = isinstance(poses, AbstractMapping)
    expect(poses is None or is_dict, "poses", "a dict of 4x4 matrices by the names of nodes", poses)
    return {"poses": {name: _matrix(name, matrix) for name, matrix in poses.items()}} if poses else {}


def _numbers(count: Any) -> List[str]:
    number = whole(count)
    expect(number is not None and number > 0, "frames", "a whole number from 1 on", count)
    return [f"{i + 1:04}" for i in range(number or 0)]


def _view_name(number: int, view: Any) -> str:
    name = view.get("name") if isinstance(view, AbstractMapping) else view
    return str(name) if name is not None else f"{number + 1:04}"


def _matrix(name: str, matrix: Any) -> Any:
    rows = as_list(f"poses: {name}", matrix)
    if not isinstance(rows, (list, tuple)) or len(rows) not in (4, 16):
        raise OptionError(f"poses: {name}: a 4x4 matrix expected")
    return rows


def _fill(out: Dict[str, Any], picture: Picture) -> Dict[str, Any]:
    for channel, array in out.items():
        drawn = picture.view(channel)
        expect(is_array(array), f"out: {channel}", "an array", array)
        if array.shape != drawn.shape or array.dtype != drawn.dtype:
            raise OptionError(f"out: {channel} is {drawn.dtype} {drawn.shape}, not {array.dtype} {array.shape}")
        array[...] = drawn
    return out
