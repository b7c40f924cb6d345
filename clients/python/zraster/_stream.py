"""Views of a request, one by one as they are drawn: their cameras, instances and poses for data sets."""
from __future__ import annotations

import json
import os
import queue
import re
import struct
import threading
import warnings
from collections.abc import Mapping as MappingClass
from ctypes import byref, c_void_p, string_at
from typing import Any, Dict, Iterator, List, Mapping, NamedTuple, Optional, Set, Tuple

from . import _library as c
from . import _neighbours
from ._errors import OptionError, Warning, expect, raise_status
from ._renderer import Cancel, Renderer, given_or_shared
from ._request import Call, Request, make, view_of
from ._scene import Scene
from ._source import read

Rows = List[List[float]]

_LOCAL = struct.Struct("<22xIHH")  # of APPNOTE.TXT 4.3.7: sizes of the file, of its name and of further fields

AHEAD = 4  # drawn views that are kept for the caller


class Drawn(NamedTuple):
    number: int
    count: int
    files: Dict[str, bytes]  # by channel and ending, such as "color.png"


class _End(NamedTuple):
    error: Optional[BaseException]


class _Drawing:
    """Draws in a thread, up to AHEAD views before the caller takes them."""

    def __init__(self, request: Request, renderer: Renderer) -> None:
        self._cancel = Cancel()
        self._views: "queue.Queue[Any]" = queue.Queue(AHEAD)
        self._is_ended = False
        self._warned: Set[str] = set()
        self._call = Call(request.body, request.type, request.query, request.parts, self._cancel)
        self._renderer = renderer
        self._thread = threading.Thread(target=self._draw, daemon=True)
        self._thread.start()

    def _take(self, _: Any, view: Any) -> int:
        made = view.contents
        files = {}
        for i in range(made.file_count):
            file = made.files[i]
            files[file.name.decode().split(".", 1)[1]] = string_at(file.data, file.size)
        texts = [made.warnings[i].decode() for i in range(made.warning_count)]
        self._put((Drawn(made.number, made.count, files), texts))
        return int(self._is_ended)

    def _put(self, item: Any) -> None:
        while not self._is_ended:
            try:
                return self._views.put(item, timeout=0.2)
            except queue.Full:
                pass

    def _draw(self) -> None:
        error = c_void_p()
        take = c.TakeView(self._take)
        end: Optional[BaseException] = None
        try:
            status = c.library.draw_views(
                self._renderer._handle.pointer, byref(self._call.struct), take, None, byref(error)
            )
            if status != c.OK:
                raise_status(status, error)
        except BaseException as found:
            end = found
        self._put(_End(end))

    def __iter__(self) -> Iterator[Drawn]:
        while True:
            item = self._views.get()
            if isinstance(item, _End):
                if item.error is not None:
                    raise item.error
                return
            drawn, texts = item
            for text in texts:
                kind = re.sub("[0-9]+", "", text)  # views differ in numbers of pixels
                if kind not in self._warned:
                    self._warned.add(kind)
                    warnings.warn(text, Warning, stacklevel=5)
            yield drawn

    def close(self) -> None:
        self._is_ended = True
        self._cancel.cancel()
        self._thread.join()


def _scene_of(source: Any, options: Dict[str, Any]) -> Any:
    """Returns a scene for the name of a file, its own, or one of the model in the look studio; and for a Scene, its dict."""
    if isinstance(source, Scene):
        scene, parts, renderer = source._source()
        options["parts"] = {**parts, **(options.get("parts") or {})}
        options.setdefault("renderer", renderer)
        return scene
    if not isinstance(source, (str, os.PathLike)):
        return source
    path, found = os.fspath(source), read(source, None)
    files, lines = _neighbours.read(path, found.body, found.type, options.pop("root", None), {})
    for line in lines:
        warnings.warn(line, Warning, stacklevel=5)
    if not found.is_mesh:
        options["parts"] = {**files, **(options.get("parts") or {})}
        return json.loads(found.body or b"")
    name = os.path.basename(path)
    options["parts"] = {**files, **(options.get("parts") or {}), name: found.body}
    return {"look": "studio", "meshes": [{"asset": name}]}


_PROJECTIONS = {"perspective", "orthographic", "intrinsics", "K", "projectionMatrix", "camera"}  # of a view
_DEFAULT_PROJECTION = {"yfovDegrees": 45}


def _with_pinhole(scene: Any, options: Dict[str, Any]) -> Any:
    """Returns a scene with a perspective, if neither it nor the options choose a projection or a look, which has one."""
    if not isinstance(scene, MappingClass) or options.get("look") or "look" in scene:
        return scene
    place = scene if options.get("view") is None else options
    view = view_of(place.get("view", {}))
    if not isinstance(view, MappingClass) or not _PROJECTIONS.isdisjoint(view):
        return scene
    changed = {**place, "view": {**view, "perspective": _DEFAULT_PROJECTION}}
    if place is scene:
        return changed
    options.update(changed)
    return scene


def _request_of(source: Any, outputs: Any, options: Dict[str, Any], needs_pinhole: bool) -> Tuple[Request, Renderer]:
    scene = _scene_of(source, options)
    parts, renderer, size = (options.pop(name, None) for name in ("parts", "renderer", "size"))
    expect(not isinstance(scene, (bytes, bytearray, memoryview)), "source", "a scene, a path or a mesh", scene)
    if needs_pinhole:
        scene = _with_pinhole(scene, options)
    return make(scene, outputs, size, parts, options), given_or_shared(renderer)


def stream(source: Any, outputs: Any, options: Dict[str, Any], needs_pinhole: bool = False) -> Iterator[Drawn]:
    """Draws the views of a request: views, orbit, turntable or animate, a few ahead of the caller. Memory does not grow
    with their number.

    needs_pinhole: a scene without a projection and a look gets a perspective
    """
    options = dict(options)
    drawing = _Drawing(*_request_of(source, outputs, options, needs_pinhole))
    try:
        yield from drawing
    finally:
        drawing.close()


# ---- cameras, instances and their poses ----


class Camera(NamedTuple):
    """A pinhole camera: matrices by rows. Axes as in OpenCV: x right, y down, z forward."""

    k: Rows  # 3x3; (0, 0) is the middle of the first pixel, as in OpenCV
    world_to_camera: Rows  # 3x4


class View(NamedTuple):
    """A drawn view. files: by channel and ending, such as "color.png", and "masks/000001.amodal.png"."""

    number: int
    camera: Any  # a Camera, if the data set needs one
    files: Dict[str, bytes]
    instances: List[Dict[str, Any]]  # the list `visibility`, server/api/v1.md


def _rows(flat: Any) -> Rows:
    """Returns the rows of a flat matrix of columns."""
    return [[flat[4 * column + row] for column in range(4)] for row in range(4)]


def _camera(number: int, camera: Mapping[str, Any]) -> Camera:
    if "K" not in camera:
        raise OptionError(f"view {number}: data sets have pinhole cameras: give the view a perspective or intrinsics")
    if "distortion" in camera:
        raise OptionError(f"view {number}: these data sets have no distortion of lenses: leave it out of the view")
    k = [list(row) for row in camera["K"]]
    k[0][2] -= 0.5
    k[1][2] -= 0.5
    x, y, z = _rows(camera["worldToCamera"])[:3]
    return Camera(k, [x, [-value for value in y], [-value for value in z]])


def _unzip(data: bytes) -> Dict[str, bytes]:
    """Returns the files of a ZIP of the library, which stores them one after the other, much faster than zipfile."""
    files: Dict[str, bytes] = {}
    at = 0
    while data[at : at + 4] == b"PK\3\4":
        size, name_size, extra = _LOCAL.unpack_from(data, at)
        begin = at + 30 + name_size + extra
        files[data[at + 30 : at + 30 + name_size].decode()] = data[begin : begin + size]
        at = begin + size
    return files


def draw(
    source: Any, outputs: List[Dict[str, Any]], options: Dict[str, Any], needs_pinhole: bool = True
) -> Iterator[View]:
    """Draws all views of a data set. Masks as json are added to the outputs, and those as zip are unpacked."""
    for drawn in stream(source, [*outputs, {"channel": "masks", "encoding": "json"}], options, needs_pinhole):
        files = dict(drawn.files)
        masks = json.loads(files.pop("masks.json"))
        if "masks.zip" in files:
            files.update(_unzip(files.pop("masks.zip")))
        camera = _camera(drawn.number, masks["camera"]) if needs_pinhole else None
        yield View(drawn.number, camera, files, masks["visibility"])


class Numbers:
    """Numbers of objects, by the names of nodes or meshes. Without given ones, meshes are numbered as they appear."""

    def __init__(self, key: str, given: Optional[Mapping[str, int]]) -> None:
        expect(given is None or isinstance(given, MappingClass), key, "numbers by the names of nodes or meshes", given)
        if given is not None and not given:
            raise OptionError(f"{key}: no name, so nothing would be listed; leave it out to list all meshes")
        self.found: Dict[str, int] = dict(given or {})
        self._key, self._unused = key, set(self.found)
        self._names: Set[str] = set()
        self._is_given = given is not None

    def of(self, instance: Mapping[str, Any]) -> Optional[int]:
        """Returns the number of an instance; None: it is left out."""
        for key in ("node", "name"):
            name = instance.get(key)
            if name in self.found:
                self._unused.discard(name)
                return self.found[name]
            if name is not None:
                self._names.add(name)
        return None if self._is_given else self.found.setdefault(instance["name"], len(self.found) + 1)

    def warn_of_unused(self) -> None:
        """Warns of given names that no instance has in any view."""
        if self._is_given and self._unused:
            others = f"; others have {', '.join(sorted(self._names))}" if self._names else ""
            text = f"{self._key}: no view shows {', '.join(sorted(self._unused))}{others}"
            warnings.warn(text, Warning, stacklevel=3)


class Replacing:
    """A text file that replaces another once it is complete, and leaves it as it is after an error."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._file = open(path + ".part", "w")
        self.write = self._file.write

    def __enter__(self) -> "Replacing":
        return self

    def __exit__(self, error: Any, *_: Any) -> None:
        self._file.close()
        if error is None:
            os.replace(self._path + ".part", self._path)
        else:
            os.remove(self._path + ".part")


def empty(folder: str) -> None:
    """Makes the folder, and removes the numbered pictures of an earlier data set from it."""
    os.makedirs(folder, exist_ok=True)
    for name in os.listdir(folder):
        if re.fullmatch(r"[0-9]{6}(_[0-9]{6})?\.png", name):
            os.remove(os.path.join(folder, name))


def pose_of(camera: Camera, instance: Mapping[str, Any]) -> Tuple[Rows, List[float]]:
    """Returns the rotation and translation from the mesh to the camera. A scale of the instance is left out."""
    to_world = list(zip(*_rows(instance["objectToWorld"])))  # columns
    matrix = [[sum(a * b for a, b in zip(row, column)) for column in to_world] for row in camera.world_to_camera]
    x, y, z = ([row[k] for row in matrix] for k in range(3))
    lengths = [sum(value * value for value in column) ** 0.5 for column in (x, y, z)]
    largest = max(lengths)
    volume = sum(x[i] * (y[(i + 1) % 3] * z[(i + 2) % 3] - y[(i + 2) % 3] * z[(i + 1) % 3]) for i in range(3))
    if not largest > 0 or abs(volume / largest**3 - 1) > 1e-4 or min(lengths) < largest * (1 - 1e-4):
        name = instance.get("node", instance["name"])
        raise OptionError(f"{name}: stretched, skewed or mirrored, which no rotation and translation are")
    return [[value / largest for value in row[:3]] for row in matrix], [row[3] for row in matrix]


def size_of(box: Optional[List[int]]) -> List[int]:
    """Converts x0, y0, x1, y1 to x, y, width, height; -1 without a box."""
    return [box[0], box[1], box[2] - box[0], box[3] - box[1]] if box else [-1, -1, -1, -1]
