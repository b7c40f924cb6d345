"""Files that a file refers to, such as the textures of glTF, read from its folder.

Only regular files below the root folder are read, after all links are resolved. The renderer reports
missing files.
"""
from __future__ import annotations

import os
from ctypes import create_string_buffer
from typing import Any, Dict, Iterable, List, Optional, Tuple
from urllib.parse import unquote

from . import _library as c

LOOKUPS_MAX, COUNT_MAX, BYTES_MAX = 4096, 255, 2 << 30


def _references(body: bytes, type_: Optional[str]) -> List[str]:
    kind = type_.encode() if type_ else None
    names = create_string_buffer(4096)
    room = c.library.references(body, len(body), kind, names, len(names))
    if room > len(names):
        names = create_string_buffer(room)
        c.library.references(body, len(body), kind, names, room)
    found = names.raw[:room].decode("utf-8", "surrogateescape").split("\0")[:-1]
    return list(dict.fromkeys(found))


def _is_absolute(path: str) -> bool:
    return path.startswith("/") or path[1:2] == ":"


def _walk(folder: str, path: str) -> Optional[str]:
    """Returns the path of a file. Looks up missing parts without regard to case."""
    at = folder
    for part in path.split("/"):
        if part in ("", "."):
            continue
        step = os.path.join(at, part)
        if not os.path.exists(step):
            try:
                near = [name for name in os.listdir(at) if name.lower() == part.lower()]
            except OSError:
                return None
            if len(near) != 1:
                return None
            step = os.path.join(at, near[0])
        at = step
    return at if os.path.isfile(at) else None


class _Search:
    def __init__(self, folder: str, root: str, names: Iterable[str]) -> None:
        self.folder, self.root = os.path.realpath(folder), os.path.realpath(root)
        self.names = set(names)
        self.files: Dict[str, bytes] = {}
        self.outside: List[str] = []
        self.excess: List[str] = []
        self.lookups = self.bytes = 0

    def _add(self, path: str, name: str) -> None:
        real = os.path.realpath(path)
        part = os.path.relpath(path, self.folder).replace(os.sep, "/")
        if os.path.commonpath([self.root, real]) != self.root:
            self.outside.append(name)
            return
        if part in self.names or part in self.files:
            return
        if len(self.files) == COUNT_MAX or self.bytes + os.path.getsize(real) > BYTES_MAX:
            self.excess.append(name)
            return
        with open(real, "rb") as file:
            self.files[part] = file.read()
        self.bytes += len(self.files[part])

    def _find(self, beside: str, name: str) -> None:
        plain = unquote(name).replace("\\", "/")
        base = plain.rsplit("/", 1)[-1]
        for path in (name, plain, base):
            found = None if _is_absolute(path) or not base else _walk(self.folder, f"{beside}/{path}")
            if found:
                return self._add(found, name)
        found = _walk(self.folder, base) if base else None
        if found:
            self._add(found, name)
        elif _is_absolute(plain):
            self.outside.append(name)

    def find_all(self, beside: str, body: bytes, type_: Optional[str]) -> None:
        for name in _references(body, type_):
            self.lookups += 1
            if name in self.names or "\0" in unquote(name):
                continue
            if self.lookups > LOOKUPS_MAX:
                self.excess.append(name)
                continue
            try:
                self._find(beside, name)
            except OSError:
                pass  # like a missing file


def _line(names: List[str], why: str) -> List[str]:
    if not names:
        return []
    many = f"{len(names)} referenced files are not read ({why}); the first is {names[0]}"
    return [f"a referenced file is not read ({why}): {names[0]}" if len(names) == 1 else many]


def read(
    path: str, body: bytes, type_: Optional[str], root: Optional[str], names: Iterable[str]
) -> Tuple[Dict[str, bytes], List[str]]:
    """Returns the files that a file needs, by their paths from its folder, and warnings.

    names: of parts that are given; these files are not read
    """
    folder = os.path.dirname(path) or "."
    search = _Search(folder, folder if root is None else root, names)
    search.find_all("", body, type_)
    done = 0
    while done < len(search.files):
        part = list(search.files)[done]
        done += 1
        ending = os.path.splitext(part)[1].lstrip(".")
        if ending:
            search.find_all(os.path.dirname(part), search.files[part], ending)
    lines = _line(search.outside, "outside of the folder of the file or root")
    return search.files, lines + _line(search.excess, "beyond the limits of number or size")
