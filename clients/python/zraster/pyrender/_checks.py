"""Attributes that are converted and checked when they are set, with the exceptions of pyrender."""
from __future__ import annotations

from typing import Any, Callable, Optional

Convert = Callable[[Any, Any], Any]  # of the object and the given value to the value that is kept


class Checked:
    """An attribute with a function that converts each value, or raises TypeError or ValueError."""

    def __init__(self, convert: Convert) -> None:
        self._convert = convert

    def __set_name__(self, owner: Any, name: str) -> None:
        self._slot = "_" + name

    def __get__(self, one: Any, owner: Any = None) -> Any:
        return self if one is None else one.__dict__[self._slot]

    def __set__(self, one: Any, value: Any) -> None:
        one.__dict__[self._slot] = self._convert(one, value)


def text(_: Any, value: Any) -> Optional[str]:
    return None if value is None else str(value)


def number(_: Any, value: Any) -> float:
    return float(value)


def optional(convert: Convert) -> Convert:
    """Returns a function that keeps None."""
    return lambda one, value: None if value is None else convert(one, value)


def or_default(default: Any, convert: Convert) -> Convert:
    """Returns a function that replaces None."""
    return lambda one, value: convert(one, default if value is None else value)


def positive(name: str) -> Convert:
    def convert(_: Any, value: Any) -> float:
        made = float(value)
        if not made > 0:
            raise ValueError(f"{name} must be > 0, not {made}")
        return made

    return convert


def between(name: str, low: float, high: float) -> Convert:
    def convert(_: Any, value: Any) -> float:
        if not low <= value <= high:
            raise ValueError(f"{name} must be from {low} to {high}, not {value}")
        return float(value)

    return convert


def truth(name: str) -> Convert:
    return instance(name, bool, "True or False")


def instance(name: str, kind: Any, wanted: str) -> Convert:
    def convert(_: Any, value: Any) -> Any:
        if not isinstance(value, kind):
            raise TypeError(f"{name}: {wanted} expected, not {type(value).__name__}")
        return value

    return convert
