"""Answers as files: read from a ZIP, and decoded to arrays without the renderer, for pictures of servers and pickled ones."""
from __future__ import annotations

import io
import struct
import zipfile
import zlib
from typing import Any, Dict, List, Mapping, Tuple

from ._arrays import load_numpy
from ._errors import OptionError
from ._renderer import shared

PNG = b"\x89PNG\r\n\x1a\n"


def suffix_of(type_: str) -> str:
    """Returns the ending of files of a media type, such as ".png"."""
    return next(("." + row["suffix"] for row in shared().tables["encodings"] if row["type"] == type_), type_)


def spelled(suffix: str) -> str:
    """Returns the ending that zraster writes for another spelling of it: ".jpg" for ".jpeg"."""
    return next(("." + row["suffix"] for row in shared().tables["encodings"] if suffix == "." + row.get("spelling", "?")), suffix)


def unzip(data: bytes) -> Dict[str, Tuple[bytes, str]]:
    """Returns the files of a ZIP and their media types by channel: "depth" for depth.npy."""
    types = {row["suffix"]: row["type"] for row in shared().tables["encodings"]}
    files: Dict[str, Tuple[bytes, str]] = {}
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        for name in archive.namelist():
            channel, suffix = name.rsplit(".", 1)
            files[channel] = archive.read(name), types[suffix]
    return files


def masks(data: bytes) -> Dict[int, Dict[str, Any]]:
    """Returns the masks of a ZIP of PNGs, arrays of booleans, by instance: {1: {"amodal": ..., "visible": ...}}."""
    found: Dict[int, Dict[str, Any]] = {}
    for name, (png, _) in unzip(data).items():  # masks/000001.amodal
        number, kind = name.rsplit("/", 1)[1].split(".")
        found.setdefault(int(number), {})[kind] = _decode_png(name, png)[:, :, 0] > 0
    return found


def decode(channel: str, data: bytes) -> Any:
    """Returns the array of an NPY file or of a PNG with 8 bits per channel."""
    numpy = load_numpy()

    if data[:6] == b"\x93NUMPY":
        read: Any = numpy.lib.format.read_array
        return read(io.BytesIO(data), allow_pickle=False)
    if data[:8] == PNG:
        return _decode_png(channel, data)
    raise OptionError(f"{channel} has no pixels")


def _chunks(data: bytes) -> Mapping[bytes, bytes]:
    found: Dict[bytes, bytes] = {}
    at = len(PNG)
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        found[kind] = found.get(kind, b"") + data[at + 8 : at + 8 + size]
        at += size + 12
    return found


def frames(data: bytes) -> List[bytes]:
    """Returns the frames of an animated PNG, which are whole pictures, as PNG files."""
    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    found: List[bytes] = []
    at, head = len(PNG), b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        content = data[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            head = content
        elif kind == b"fcTL":
            found.append(b"")
        elif kind in (b"IDAT", b"fdAT"):
            found[-1] += content[4:] if kind == b"fdAT" else content
        at += size + 12
    return [PNG + chunk(b"IHDR", head) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"") for pixels in found]


def _unfilter(rows: Any, step: int) -> Any:
    """Undoes the filters of PNG rows: (h, 1 + bytes) u1. step: bytes per pixel."""
    numpy = load_numpy()

    kinds, rows = rows[:, 0], rows[:, 1:].copy()
    above = numpy.zeros(rows.shape[1], "u1")
    for kind, row in zip(kinds, rows):
        if kind == 1:
            pixels = row.reshape(-1, step)
            numpy.cumsum(pixels, axis=0, dtype="u1", out=pixels)
        elif kind == 2:
            row += above
        elif kind > 2:
            _unfilter_slowly(kind, row, above, step)
        above = row
    return rows


def _unfilter_slowly(kind: int, row: Any, above: Any, step: int) -> None:
    line, upper = row.tolist(), above.tolist()
    for i, value in enumerate(line):
        a, b, c = (line[i - step], upper[i], upper[i - step]) if i >= step else (0, upper[i], 0)
        if kind == 3:
            guess = (a + b) // 2
        else:
            p = a + b - c
            guess = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        line[i] = (value + guess) & 255
    row[:] = line


def _decode_png(channel: str, data: bytes) -> Any:
    """Returns (h, w, 1), (h, w, 3) or (h, w, 4) u1 of a grey, RGB, RGBA or palette PNG, which is not interlaced."""
    numpy = load_numpy()

    chunks = _chunks(data)
    width, height, depth, kind = struct.unpack_from(">IIBB", chunks[b"IHDR"])
    if depth > 8:
        raise OptionError(f"{channel} is a PNG of {depth} bits: ask for the encoding npy to get its numbers")
    samples = {0: 1, 2: 3, 3: 1, 6: 4}[kind]
    packed = numpy.frombuffer(zlib.decompress(chunks[b"IDAT"]), "u1").reshape(height, -1)
    rows = _unfilter(packed, max(1, samples * depth // 8))
    if kind != 3:
        return rows.reshape(height, width, samples)
    bits = numpy.unpackbits(rows, axis=1)[:, : width * depth].reshape(height, width, depth)
    indices = (bits << numpy.arange(depth - 1, -1, -1, dtype="u1")).sum(axis=2, dtype="u1")
    palette = numpy.frombuffer(chunks[b"PLTE"], "u1").reshape(-1, 3)
    if b"tRNS" in chunks:
        alpha = numpy.full((len(palette), 1), 255, "u1")
        alpha[: len(chunks[b"tRNS"]), 0] = numpy.frombuffer(chunks[b"tRNS"], "u1")
        palette = numpy.hstack([palette, alpha])
    return palette[indices]


def zip_files(files: Mapping[str, bytes]) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return file.getvalue()
