"""Keywords: the parameters and keys of scenes that the library lists, in snake_case."""
from __future__ import annotations

import difflib
from collections.abc import Mapping as AbstractMapping
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

from ._arrays import as_list, plain, whole
from ._errors import OptionError, OptionTypeError, expect, snake
from ._renderer import shared
from ._source import Source

Channels = Union[str, Sequence[Union[str, Mapping[str, Any]]]]


class _Row(NamedTuple):
    name: str  # of the parameter; "": a key of scenes alone
    pointer: str  # of the key of a scene that it sets
    is_mesh: bool  # a parameter for meshes; scenes have the key instead
    kind: str
    help: str


_rows: Dict[str, _Row] = {}


def rows() -> Dict[str, _Row]:
    """Returns the rows by keyword."""
    if not _rows:
        tables = shared().tables
        made = {snake(key["name"]): _Row("", "/" + key["name"], False, "", key["help"]) for key in tables["keys"]}
        for row in tables["parameters"]:
            is_mesh = row["bodies"] == "mesh"
            made[snake(row["name"])] = _Row(row["name"], row["key"], is_mesh, row["value"], row["help"])
        _rows.update(made)
    return _rows


def options() -> Dict[str, str]:
    """Returns all keywords of `render` that come from the renderer's tables, with their help."""
    return {keyword: row.help for keyword, row in sorted(rows().items())}


def _find(keyword: str) -> _Row:
    row = rows().get(keyword)
    if row:
        return row
    known = [*rows(), "size", "channels"]
    near = difflib.get_close_matches(keyword, known, 1) or difflib.get_close_matches(snake(keyword), known, 1)
    hint = f" (did you mean {near[0]}?)" if near else "; zraster.options() lists all"
    raise OptionError(f"unknown option: {keyword}{hint}")


def _text(keyword: str, value: Any, kind: str = "") -> str:
    """Converts a value to the text of a parameter."""
    value = as_list(keyword, plain(value))
    if isinstance(value, bool):
        return "true" if value else "false"
    if kind == "PIXEL_LIST" and isinstance(value, (list, tuple)) and value and isinstance(value[0], (list, tuple)):
        return " ".join(_text(keyword, item) for item in value)
    if isinstance(value, (list, tuple)):
        return ",".join(_text(keyword, item) for item in value)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return value
    raise OptionTypeError(f"{keyword}: {type(value).__name__} is no value of a parameter")


def _set(keys: Dict[str, Any], pointer: str, value: Any) -> None:
    """Sets the key at a JSON Pointer. Copies the objects and lists around it."""
    *path, last = pointer.strip("/").split("/")
    at: Any = keys
    for name, below in zip(path, [*path[1:], last]):
        place: Any = int(name) if name.isdigit() else name
        around = at[place] if isinstance(at, list) else at.get(place)
        if below.isdigit():
            around = list(around) if isinstance(around, list) else [{}]
        else:
            around = dict(around) if isinstance(around, AbstractMapping) else {}
        at[place] = around
        at = around
    at[last] = value


def _has_objects(value: Any) -> bool:
    is_list = isinstance(value, (list, tuple))
    return isinstance(value, AbstractMapping) or (is_list and any(isinstance(item, AbstractMapping) for item in value))


def _set_scene_key(keys: Dict[str, Any], keyword: str, row: _Row, value: Any, source: Source) -> None:
    if row.pointer.startswith("/materials/"):
        if not source.is_object:
            raise OptionError(f"{keyword}: for meshes without a scene; in a scene, the materials have it")
        keys.setdefault("materials", source.scene["materials"])  # type: ignore[index]
    if row.pointer == "/query/projection":
        _set(keys, f"/view/{value}", {})
    elif row.pointer.startswith(f"/{row.name}/") and _has_objects(value):
        keys[row.name] = value  # sets the whole key: highlight={"parts": "axle", "color": "red"}
    else:
        _set(keys, row.pointer.replace("/query/", "/"), value)
    if row.pointer.startswith("/lights/0/"):
        keys["lights"][0].setdefault("type", "directional")


def _is_key(row: _Row, value: Any, is_mesh: bool) -> bool:
    """True if the value is set as a key of a scene, false if it is a parameter."""
    if not row.name or (row.is_mesh and not is_mesh):
        return True
    is_list = isinstance(value, (list, tuple)) or getattr(value, "ndim", 0) > 0
    if row.kind in ("PARTS", "PRESETS", "WORDS") and is_list:  # joined by commas, unless an item is an object or has a comma
        return _has_objects(value) or any("," in str(item) for item in value)
    if row.kind == "PIXEL_LIST":
        return False
    return isinstance(value, AbstractMapping) or (is_list and row.kind != "VECTOR")


def _size(size: Any) -> Tuple[int, int]:
    is_pair = isinstance(size, (list, tuple)) or getattr(size, "ndim", 0) == 1
    sides = [whole(side) for side in (size if is_pair else (size, size))]
    if len(sides) != 2 or None in sides:
        raise OptionTypeError(f"size: {size!r} is neither (width, height) nor one number of whole pixels")
    if min(sides) < 1:  # type: ignore[type-var]
        limit = shared().tables["limits"]["windowSideMax"]
        raise OptionError(f"size: {size!r}: 1 to {limit} pixels per side are allowed")
    return sides[0], sides[1]  # type: ignore[return-value]


def outputs_of(channels: Channels) -> List[Dict[str, Any]]:
    """Converts "depth", or ["color", {"channel": "depth", "encoding": "png16"}], to the outputs of a scene."""
    expect(hasattr(channels, "__iter__"), "channels", "a name such as 'depth', or a list of them", channels)
    names: List[Any] = [channels] if isinstance(channels, str) else list(channels)
    for item in names:
        expect(
            isinstance(item, (str, AbstractMapping)), "channels", "names or dicts such as {'channel': 'depth'}", item
        )
    if not names:
        raise OptionError("channels: the list is empty")
    return [{"channel": item} if isinstance(item, str) else dict(item) for item in names]


def split(
    given: Dict[str, Any], channels: Optional[Channels], size: Any, source: Source
) -> Tuple[Dict[str, str], Dict[str, Any]]:
    """Splits keywords into parameters of a query and keys of a scene."""
    given = {keyword: value for keyword, value in given.items() if value is not None}
    found = [(keyword, value, _find(keyword)) for keyword, value in given.items()]
    if "view" in given and "preset" in given:
        raise OptionError("preset: view is given, too; give one of them")
    if size is not None:
        if "width" in given or "height" in given:
            raise OptionError("size: width and height are given, too; give one of them")
        found += [(name, number, rows()[name]) for name, number in zip(("width", "height"), _size(size))]
    query: Dict[str, str] = {}
    keys: Dict[str, Any] = {}
    for keyword, value, row in sorted(found, key=lambda item: bool(item[2].name)):  # whole keys first
        if _is_key(row, value, source.is_mesh):
            _set_scene_key(keys, keyword, row, value, source)
        else:
            query[row.name] = _text(keyword, value, row.kind)
    if channels is not None:
        if "channel" in query or "outputs" in keys:
            raise OptionError("channels: channel or outputs are given, too; give one of them")
        keys["outputs"] = outputs_of(channels)
    return query, keys
