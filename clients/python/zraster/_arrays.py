"""Arrays of numpy, and of others that numpy can read, as parts of a request. numpy is imported once an array is seen."""
from __future__ import annotations

import json
import numbers
from collections.abc import Mapping as AbstractMapping
from ctypes import c_char_p, c_void_p, cast
from typing import Any, Dict, Mapping, Optional, Set, Tuple

from . import _library as c
from ._errors import OptionError, SceneError, expect

INLINE_MAX = 64  # numbers of an array that is written as a list: matrices, vectors, colours
_CONVERTED = {"f2": "f4", "f16": "f8", "i1": "i4", "i2": "i4", "u2": "u4"}


def load_numpy() -> Any:
    """Returns numpy. Raises ImportError, which names the ways without it."""
    try:
        import numpy
    except ImportError:
        raise ImportError(
            "arrays need numpy, which is not installed: python3 -m pip install numpy. Without it, picture.file(channel) "
            "returns the file of a channel, and picture.save(path) writes it"
        ) from None
    return numpy


def is_array(value: Any) -> bool:
    return hasattr(value, "__array_interface__") or hasattr(value, "__array__")


def plain(value: Any) -> Any:
    """Converts a number or truth value of numpy to Python's. Returns other values unchanged."""
    if isinstance(value, (int, float, str)):
        return value
    if isinstance(value, numbers.Integral):
        return int(value)
    if isinstance(value, numbers.Real):
        return float(value)
    if getattr(value, "ndim", None) == 0 and hasattr(value, "item") and not getattr(value, "mask", False):
        item = value.item()
        return item if item is value else plain(item)
    return value


def whole(value: Any) -> Optional[int]:
    """Converts a whole number, of numpy too, to an int. Returns None for other values, such as True, 1.0 and "1"."""
    value = plain(value)
    return int(value) if isinstance(value, int) and not isinstance(value, bool) else None


def as_numbers(value: Any) -> Any:
    """Converts an array to a type of the library, C order and native byte order. Copies it only if it has others."""
    numpy = load_numpy()

    if numpy.ma.is_masked(value):
        raise SceneError("a masked array lacks numbers: give .filled(number), or leave out its masked rows")
    array = numpy.asarray(value)
    name = f"{array.dtype.kind}{array.dtype.itemsize}"
    name = _CONVERTED.get(name, name)
    if name not in c.NUMBERS:
        raise SceneError(f"arrays of the type {array.dtype} are no numbers")
    return numpy.ascontiguousarray(array, dtype="=" + name)


def as_list(name: str, value: Any) -> Any:
    """Converts an array to a list. Returns other values unchanged. name: option, for errors."""
    try:
        return as_numbers(value).tolist() if is_array(value) else value
    except SceneError as error:
        raise OptionError(f"{name}: {error}") from None


class Parts:
    """Parts of a request by name: files as bytes, numbers as arrays."""

    def __init__(self, named: Optional[Mapping[str, Any]] = None) -> None:
        self.named: Dict[str, Any] = {}
        self.optional: Set[str] = set()  # names of parts that the scene need not use
        expect(named is None or isinstance(named, AbstractMapping), "parts", "a dict of bytes or arrays by name", named)
        for name, value in (named or {}).items():
            expect(isinstance(name, str), "parts", "names as str", name)
            is_file = isinstance(value, (bytes, bytearray, memoryview))
            expect(is_file or is_array(value), f"parts: {name}", "bytes or an array", value)
            self.named[name] = as_numbers(value) if is_array(value) else bytes(value)

    def put(self, value: Any) -> Any:
        """Returns the JSON value that stands for an array: a short list, or the name of a new part."""
        array = as_numbers(value)
        is_column = array.ndim == 2 and array.shape[1] == 1  # the array of scalars may be one, their list may not
        if array.size <= INLINE_MAX and array.dtype.name != "uint8" and not is_column:
            return array.tolist()
        name = f"array{len(self.named)}"
        self.named[name] = array
        return {"asset": name}

    def add_optional(self, files: Mapping[str, bytes]) -> None:
        self.named.update(files)
        self.optional.update(files)

    def own(self) -> None:
        """Copies arrays that the caller may change."""
        for name, value in self.named.items():
            if is_array(value):
                self.named[name] = value.copy()

    def __bool__(self) -> bool:
        return bool(self.named)

    def fill(self, request: c.Request) -> Any:
        """Puts the parts into a request. Returns the objects that it points to, which must live as long as the call."""
        parts = (c.Part * len(self.named))()
        kept = [parts]
        for part, (name, value) in zip(parts, self.named.items()):
            part.name = name.encode("utf-8", "surrogateescape")
            part.flags = c.OPTIONAL if name in self.optional else 0
            array = part.array
            if isinstance(value, bytes):
                array.data, array.type, array.ndim = cast(c_char_p(value), c_void_p), c.BYTES, 1
                array.shape[0] = len(value)
            else:
                array.data = value.__array_interface__["data"][0]
                array.type, array.ndim = c.NUMBERS.index(f"{value.dtype.kind}{value.dtype.itemsize}"), value.ndim
                array.shape[: value.ndim] = value.shape
            kept.append(value)
        request.parts, request.part_count = parts, len(parts)
        return kept

    def files(self) -> Dict[str, bytes]:
        """Returns the parts as files, for a server: arrays as NPY."""
        return {name: value if isinstance(value, bytes) else npy(value) for name, value in self.named.items()}


def npy(array: Any) -> bytes:
    """Returns an array as the bytes of an NPY file."""
    import io

    numpy = load_numpy()

    file = io.BytesIO()
    write: Any = numpy.lib.format.write_array
    write(file, array, version=(1, 0), allow_pickle=False)
    return file.getvalue()


def dump(scene: Any, parts: Parts) -> bytes:
    """Returns a scene as JSON. Its arrays become parts."""

    def convert(value: Any) -> Any:
        value = plain(value)
        if isinstance(value, (int, float, str)):
            return value
        if is_array(value):
            return parts.put(value)
        if isinstance(value, AbstractMapping):
            return dict(value)
        if hasattr(value, "__iter__"):
            return list(value)
        raise SceneError(f"{type(value).__name__} is no value of a scene")

    try:
        return json.dumps(scene, default=convert, allow_nan=False, separators=(",", ":")).encode()
    except ValueError as error:
        found = _find_fault(scene, "")
        if not found:
            raise SceneError(str(error)) from None
        raise SceneError(": ".join(found), [found]) from None


def _find_fault(value: Any, pointer: str) -> Optional[Tuple[str, str]]:
    """Returns the JSON Pointer and the detail of the first array or number that JSON cannot hold."""
    value = plain(value)
    if isinstance(value, float):
        return None if value - value == 0 else (pointer, f"a finite number expected, got {value}")
    items: Any = ()
    if isinstance(value, AbstractMapping):
        items = ((str(key).replace("~", "~0").replace("/", "~1"), item) for key, item in value.items())
    elif is_array(value):
        try:
            items = enumerate(as_numbers(value).tolist())
        except SceneError as error:
            return pointer, str(error)
    elif isinstance(value, (list, tuple)):
        items = enumerate(value)
    for key, item in items:
        found = _find_fault(item, f"{pointer}/{key}")
        if found:
            return found
    return None
