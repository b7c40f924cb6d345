"""Errors and warnings."""
from __future__ import annotations

import re
from ctypes import c_void_p
from typing import Any, Iterable, NamedTuple, NoReturn, Optional, Sequence, Tuple

from . import _library as c


class Fault(NamedTuple):
    """One fault of a scene."""

    pointer: str  #: JSON Pointer of its place, such as "/meshes/0/faces/17/2"; "" without one
    detail: str


class Error(Exception):
    """Base of all errors. `faults` lists up to 20 faults, in the order of the scene."""

    faults: Tuple[Fault, ...]

    def __init__(self, text: str = "", faults: Iterable[Sequence[str]] = ()) -> None:
        super().__init__(text)
        self.faults = tuple(Fault(*fault) for fault in faults) or (Fault("", text),)

    @property
    def pointer(self) -> str:
        """The JSON Pointer of the first fault."""
        return self.faults[0].pointer

    def __reduce__(self):  # type: ignore[no-untyped-def]
        return type(self), (str(self), [tuple(fault) for fault in self.faults])


class SceneError(Error, ValueError):
    """The scene or mesh cannot be read or drawn."""


class OptionError(Error, ValueError):
    """An option is unknown or has a wrong value."""


class OptionTypeError(OptionError, TypeError):
    """The value of an option has a wrong type, such as a text for a size."""


def expect(is_right: bool, name: str, words: str, value: Any) -> None:
    """Raises OptionTypeError unless the value of an option has the right type. words: "a Renderer"."""
    if not is_right:
        raise OptionTypeError(f"{name}: {words} expected, got {type(value).__name__}")


class MemoryLimitError(Error, MemoryError):
    """The call needs more memory than `memory_max`, or than the system has."""


class Cancelled(Error):
    """A Cancel ended the call."""


class ServerError(Error):
    """The server did not answer, or refused the request for another reason than its scene or options."""


class InternalError(Error):
    """A fault of zraster: please report it."""


class Warning(UserWarning):  # noqa: A001 - named as in the manual
    """A problem that did not stop a render."""


CLASSES = {
    c.BAD_SYNTAX: SceneError,
    c.BAD_TYPE: SceneError,
    c.BAD_REQUEST: OptionError,
    c.BAD_SCENE: SceneError,
    c.NO_MEMORY: MemoryLimitError,
    c.CANCELLED: Cancelled,
}


def snake(name: str) -> str:
    return re.sub("([A-Z])", lambda match: "_" + match.group(1).lower(), name)


_PARTS = "parts= gives it, and a scene by path reads it from its folder"


def words(text: str) -> str:
    """Names keywords in snake_case: "line_width: ..." for "parameter lineWidth: ...". Adds the ways to give a missing part."""
    text = re.sub(r"(no part of the request has the name '.*)", rf"\1; {_PARTS}", text)
    return re.sub(r"\bparameter (\w+)", lambda match: snake(match.group(1)), text)


def _text(value: Optional[bytes]) -> str:
    return words((value or b"").decode("utf-8", "replace"))


def raise_status(status: int, error: c_void_p) -> NoReturn:
    """Raises the error of a failed call and frees the library's."""
    if not error:
        raise CLASSES.get(status, InternalError)("the renderer could not be opened")
    try:
        pairs = [
            (_text(c.library.error_pointer(error, i)), _text(c.library.error_detail(error, i)))
            for i in range(c.library.error_count(error))
        ]
        text = _text(c.library.error_text(error))
    finally:
        c.library.error_free(error)
    raise CLASSES.get(status, InternalError)(text, pairs)
