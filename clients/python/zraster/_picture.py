"""Pictures: drawn in this process, or files of a server."""
from __future__ import annotations

import json
import os
import threading
import warnings
from collections.abc import Mapping as AbstractMapping
from ctypes import byref, c_void_p, string_at
from typing import Any, Dict, Iterator, List, Optional, Tuple

from . import _library as c
from ._arrays import load_numpy
from ._errors import OptionError, Warning, expect, raise_status
from ._files import decode, masks, spelled, suffix_of, unzip, zip_files
from ._renderer import shared


class _Lent:
    """Memory of a picture, which it keeps, for numpy."""

    def __init__(self, handle: c.Handle, array: c.Array) -> None:
        self.handle = handle
        self.__array_interface__ = {
            "data": (array.data, True),
            "typestr": "<" + c.NUMBERS[array.type],
            "shape": tuple(array.shape[: array.ndim]),
            "version": 3,
        }


class Drawn:
    """A picture of the library."""

    def __init__(self, handle: c.Handle) -> None:
        self.handle = handle
        self.lock = threading.Lock()  # encoding belongs to one thread at a time

    def encode(self, channel: Optional[str]) -> Optional[Tuple[bytes, str]]:
        """Returns the file of a channel, or the answer, and its type; None without such a channel."""
        data, error = c.Bytes(), c_void_p()
        with self.lock:
            name = channel.encode() if channel is not None else None
            status = c.library.picture_encode(self.handle.pointer, name, byref(data), byref(error))
        if status == c.BAD_REQUEST and channel is not None:
            c.library.error_free(error)
            return None
        if status != c.OK:
            raise_status(status, error)
        return string_at(data.data, data.size), data.type.decode()

    def array(self, channel: str) -> Any:
        """Returns a read-only array in the memory of the picture; None without such a channel."""
        found = c.Array()
        if not c.library.picture_channel(self.handle.pointer, channel.encode(), byref(found)):
            file = self.encode(channel)  # of several views
            return decode(channel, file[0]) if file and file[1] in ("application/x-npy", "image/png") else None
        numpy = load_numpy()

        array = numpy.asarray(_Lent(self.handle, found))
        is_rgb = channel == "color" and not c.library.picture_has_alpha(self.handle.pointer)
        return array[:, :, :3] if is_rgb else array

    def channels(self) -> List[str]:
        found = c.Array()
        rows = shared().tables["channels"]

        def has_pixels(row: Dict[str, Any]) -> bool:
            return bool(c.library.picture_channel(self.handle.pointer, row["name"].encode(), byref(found)))

        def has_file(row: Dict[str, Any]) -> bool:
            return self.encode(row["name"]) is not None

        if any(map(has_pixels, rows)):
            texts = {"json", "svg", "zip"}
            return [r["name"] for r in rows if has_pixels(r) or (not texts.isdisjoint(r["encodings"]) and has_file(r))]
        answer = self.encode(None)
        if answer and answer[1] == "application/zip":
            names = list(unzip(answer[0]))
            return ["masks"] if all(name.startswith("masks/") for name in names) else names
        return [row["name"] for row in rows if has_file(row)]

    @property
    def look(self) -> str:
        return str(c.library.picture_look(self.handle.pointer).decode())

    @property
    def warnings(self) -> List[str]:
        texts: List[str] = []
        while True:
            text = c.library.picture_warning(self.handle.pointer, len(texts))
            if text is None:
                return texts
            texts.append(text.decode())


class Files:
    """A picture as files by channel."""

    def __init__(self, answer: Tuple[bytes, str], files: Dict[str, Tuple[bytes, str]], look: str, warnings: List[str]) -> None:
        self.answer, self.files, self.look, self.warnings = answer, files, look, warnings

    def encode(self, channel: Optional[str]) -> Optional[Tuple[bytes, str]]:
        if channel is None:
            return self.answer
        name = channel if channel in self.files else channel.rsplit(".", 1)[0]  # depth, front.color; depth.npy
        return self.files.get(name)

    def array(self, channel: str) -> Any:
        return decode(channel, self.files[channel][0]) if channel in self.files else None

    def channels(self) -> List[str]:
        return list(self.files)


def _way_to(suffix: str, channels: List[str]) -> str:
    """Returns the way to a file with this ending, of a channel that can have one."""
    names = [row["name"] for row in shared().tables["encodings"] if "." + row["suffix"] == suffix]
    for row in shared().tables["channels"]:
        for name in names:
            if row["name"] in channels and name in row["encodings"]:
                return f'; draw it with [{{"channel": "{row["name"]}", "encoding": "{name}"}}] as channels'
    return "" if names else f"; zraster writes no {suffix}"


class Info(Dict[str, Any]):
    """The channel info: a dict. str() is a table of its parts.

    >>> print(zraster.render("part.3mf", "info", render=False).info)
    """

    def __str__(self) -> str:
        lines = [f"{'part':24} {'triangles':>10}  {'size':29} {'area':>10}  {'':6} {'volume':>12}"]
        for part in self.get("parts", []):
            box, volume = part["box"], part["volume"]
            size = " x ".join(f"{high - low:.4g}" for low, high in zip(box["min"], box["max"])) if box else "-"
            name = "".join(c if c.isprintable() else "?" for c in part["name"])[:24]
            closed = f"closed {volume:12.6g}" if part["closed"] else f"open   {'-':>12}"
            lines.append(f"{name:24} {part['triangles']:10}  {size:29} {part['area']:10.4g}  {closed}")
        if "partsOmitted" in self:
            lines.append(f"and {self['partsOmitted']} more parts")
        return "\n".join(lines)


def _unpickle(answer: Tuple[bytes, str], files: Dict[str, Tuple[bytes, str]], look: str, warnings: List[str]) -> "Picture":
    return Picture(Files(answer, files, look, warnings))


class Picture(AbstractMapping):  # type: ignore[type-arg]
    """A picture: a mapping of channels to arrays, and a file for each of them. Row 0 is the top.

    picture["color"]: (h, w, 3) uint8; (h, w, 4) if the background is not opaque; as in the PNG
    picture["depth"]: (h, w) float32, distance along the view axis in scene units
    picture["distance"]: (h, w) float32, length of the ray from the eye in scene units
    picture["normals"], picture["position"]: (h, w, 3) float32
    picture["instanceId"], picture["faceId"]: (h, w) uint32, counted from 1
    picture["info"], picture["fragments"], picture["trace"]: dicts
    picture["masks"]: {1: {"amodal": (h, w) bool, "visible": ...}, ...} by instanceId; as json, a dict
    Several views: picture["front.color"], ...; picture["depth"]: (views, h, w); file("color"): the animation or the sheet
    Background pixels are inf in depth and distance, and 0 in normals, position and ids.
    dict(picture) has all of them. Arrays are copies; view() returns one without a copy.
    """

    def __init__(self, made: Any) -> None:
        self._made = made
        self._issued = 0  # warnings issued so far

    # ---- files ----

    def _encode(self, channel: Optional[str]) -> Tuple[bytes, str]:
        found = self._made.encode(channel)
        if found is None:
            raise self._missing(str(channel))
        self._warn(4)
        return found  # type: ignore[no-any-return]

    @property
    def content(self) -> bytes:
        """The answer of POST /v1/render: the file of the only channel, or a ZIP of all."""
        return self._encode(None)[0]

    @property
    def content_type(self) -> str:
        """The media type of `content`, such as "image/png"."""
        return self._encode(None)[1]

    @property
    def png(self) -> bytes:
        """The only file if it is a PNG, else the PNG of color."""
        data, type_ = self._encode(None)
        return data if type_ in ("image/png", "image/apng") else self._encode("color")[0]

    def file(self, channel: str) -> bytes:
        """Returns the file of a channel, such as a PNG, a JPEG or an NPY."""
        return self._encode(channel)[0]

    def save(self, path: Any) -> None:
        """Writes the file that the ending of the path selects, such as .png, .jpg, .npy or .json, or .zip for several channels.
        Without an ending, writes `content`. An object with write(), such as io.BytesIO(), gets `content`, too."""
        if not isinstance(path, (str, os.PathLike)):
            expect(hasattr(path, "write"), "save", "a path such as 'part.png', or a file with write()", path)
            path.write(self.content)
            return
        suffix = os.path.splitext(os.fspath(path))[1].lower()
        suffix = spelled(suffix)
        choices = [self._encode(None)] + [self._encode(channel) for channel in self._made.channels()]
        fitting = [data for data, type_ in choices if suffix in ("", suffix_of(type_))]
        if not fitting:
            there = ", ".join(sorted({suffix_of(type_) for _, type_ in choices}))
            way = _way_to(suffix, self._made.channels())
            raise OptionError(f"{os.fspath(path)}: the picture has no file for this ending, but {there}{way}")
        with open(path, "wb") as file:
            file.write(fitting[0])

    def _repr_png_(self) -> Optional[bytes]:
        is_png = self.content_type in ("image/png", "image/apng") or ("color" in self and self._encode("color")[1] == "image/png")
        return self.png if is_png else None

    def _repr_svg_(self) -> Optional[str]:
        return self.content.decode() if self.content_type == "image/svg+xml" else None

    # ---- arrays ----

    def _missing(self, channel: str) -> KeyError:
        there = ", ".join(self._made.channels())
        return KeyError(f"{channel}: the picture has {there}; ask for others by channels=[...]")

    def view(self, channel: str) -> Any:
        """Returns a channel as an array without a copy: read-only, and valid as long as the array is."""
        array = self._made.array(channel)
        if array is None:
            raise self._missing(channel)
        return array

    def __getitem__(self, channel: str) -> Any:
        array = self._made.array(channel) if channel not in ("info", "fragments", "masks", "trace") else None
        if array is not None:
            return array.copy()
        data, type_ = self._encode(channel)
        if type_ == "application/zip":
            return masks(data)
        if type_ != "application/json":
            raise self._missing(channel)
        values = json.loads(data)
        return Info(values) if channel == "info" else values

    @property
    def array(self) -> Any:
        """color, else the only channel, as an array."""
        channels = self._made.channels()
        return self["color" if "color" in channels or len(channels) != 1 else channels[0]]

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> Any:
        return self.array if dtype is None else self.array.astype(dtype)

    @property
    def info(self) -> "Info":
        """Camera, bounds, counts, parts and warnings; needs the channel info. print() shows the parts as a table."""
        return self["info"]  # type: ignore[no-any-return]

    def __iter__(self) -> Iterator[str]:
        return iter(self._made.channels())

    def __len__(self) -> int:
        return len(self._made.channels())

    def __contains__(self, channel: object) -> bool:
        return channel in self._made.channels()

    __eq__ = object.__eq__
    __hash__ = object.__hash__

    # ---- facts ----

    @property
    def look(self) -> str:
        """The look and its version, such as "studio@1"."""
        return str(self._made.look)

    @property
    def warnings(self) -> List[str]:
        """Texts of all warnings."""
        return list(self._made.warnings)

    def _warn(self, level: int) -> None:
        """Issues warnings that are new. level: 2 is the function that calls this one, 3 its caller."""
        texts = self._made.warnings
        for text in texts[self._issued :]:
            warnings.warn(text, Warning, stacklevel=level)
        self._issued = len(texts)

    def __repr__(self) -> str:
        return f"<zraster.Picture {', '.join(self)} in {self.look}>"

    def __reduce__(self):  # type: ignore[no-untyped-def]
        files = {channel: self._encode(channel) for channel in self}
        return _unpickle, (self._encode(None), files, self.look, self.warnings)


def from_answer(data: bytes, type_: str, channel: str, look: str, warnings: List[str]) -> Picture:
    """Makes a picture of an answer of POST /v1/render. channel: the only one, unless the answer is a ZIP."""
    files = unzip(data) if type_ == "application/zip" and channel != "masks" else {channel: (data, type_)}
    return Picture(Files((data, type_), files, look, warnings))


def joined(pictures: List[Picture]) -> Picture:
    """Joins pictures of one channel each."""
    files: Dict[str, Tuple[bytes, str]] = {}
    for picture in pictures:
        files.update({channel: picture._encode(channel) for channel in picture})
    names = {channel: channel + suffix_of(type_) for channel, (_, type_) in files.items()}
    archive = zip_files({names[channel]: data for channel, (data, _) in files.items()})
    warnings = list(dict.fromkeys(text for picture in pictures for text in picture.warnings))
    return Picture(Files((archive, "application/zip"), files, pictures[0].look, warnings))
