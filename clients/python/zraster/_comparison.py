"""Comparisons of two models, in numbers and pictures."""
from __future__ import annotations

import json
import warnings
from ctypes import byref, c_void_p
from typing import Any, Dict, List, Optional
from urllib.parse import urlencode

from . import _interrupt
from . import _library as c
from ._errors import OptionError, Warning, expect, raise_status
from ._options import split
from ._picture import Picture
from ._renderer import Cancel, Renderer, given_or_shared
from ._request import draw_change, make, view_of
from ._scene import Scene


def _read(name: str, source: Any, renderer: Renderer) -> c.Handle:
    """Reads a model, or takes a Scene that was read."""
    if isinstance(source, Scene):
        if source._handle is None:
            raise OptionError(f"{name}: the scene is closed, or a server's")
        return source._handle
    request = make(source, None, None, None, {})
    for line in request.warnings:
        warnings.warn(line, Warning, stacklevel=4)
    return request.read_scene(renderer)


class Comparison:
    """Numbers of two models. `numbers` has all of them by the keys of clients/docs/measure.md; comparison["volume"] is the same.

    same: no place of either surface is farther from the other than the tolerance
    summary: one line of numbers
    """

    def __init__(self, scenes: List[c.Handle], query: Dict[str, str], cancel: Optional[Cancel]) -> None:
        self._scenes, self._query = scenes, query
        self._handle = self._run({}, cancel)
        self.numbers: Dict[str, Any] = json.loads(c.library.comparison_json(self._handle.pointer))
        self.same: bool = self.numbers["same"]
        self.summary: str = self.numbers["summary"]

    def _run(self, more: Dict[str, str], cancel: Optional[Cancel]) -> c.Handle:
        expect(cancel is None or isinstance(cancel, Cancel), "cancel", "a Cancel", cancel)
        flag = cancel or Cancel()  # Ctrl-C needs one
        query = urlencode({**self._query, **more}).encode()
        first, second = self._scenes

        def run() -> c.Handle:
            made, error = c_void_p(), c_void_p()
            status = c.library.compare(first.pointer, second.pointer, query, flag._handle.pointer, byref(made), byref(error))
            if status != c.OK or not made.value:
                raise_status(status, error)
            return c.Handle(made.value, c.library.comparison_free)

        result: c.Handle = _interrupt.run(run, flag)
        return result

    @property
    def iou(self) -> Optional[float]:
        """Common volume by the volume of both together; None for open models."""
        return self.numbers.get("volume", {}).get("iou")

    @property
    def hausdorff(self) -> Optional[float]:
        """Largest distance between the surfaces."""
        return self.numbers.get("deviation", {}).get("hausdorff")

    @property
    def chamfer(self) -> Optional[float]:
        """Sum of both mean distances between the surfaces."""
        return self.numbers.get("deviation", {}).get("chamfer")

    @property
    def holes(self) -> Dict[str, List[Dict[str, Any]]]:
        """Holes that were removed, added, moved or changed, by these words; empty if there was too much work."""
        found: Dict[str, List[Dict[str, Any]]] = self.numbers.get("features", {}).get("holes", {})
        return found

    @property
    def regions(self) -> List[Dict[str, Any]]:
        """Regions that only one model has, the largest first."""
        found: List[Dict[str, Any]] = self.numbers.get("regions", [])
        return found

    @property
    def warnings(self) -> List[str]:
        found: List[str] = self.numbers["warnings"]
        return found

    def __getitem__(self, key: str) -> Any:
        return self.numbers[key]

    def __repr__(self) -> str:
        return f"<zraster.Comparison: {self.summary}>"

    def render(
        self,
        show: str = "difference",
        channels: Any = None,
        *,
        size: Any = None,
        view: Any = None,
        cancel: Optional[Cancel] = None,
        **options: Any,
    ) -> Picture:
        """Draws the differences. show: "difference", "deviation" or "side". Other keywords are those of Scene.render.

        >>> zraster.compare("a.stl", "b.stl").render("deviation", look="clay").save("deviation.png")
        """
        made = self._run({"show": show, "precision": "quick", "deviation": "off", "features": "off"}, cancel)
        scene = c.library.comparison_scene(made.pointer)
        if not scene:
            raise OptionError("show: one of: difference, deviation, side")
        source = make({}, None, None, None, {}).source
        query, keys = split({**options, "view": view_of(view)}, channels, size, source)
        handle = c.Handle(scene, lambda _: made)  # the scene is the comparison's
        return draw_change(handle, keys, query, cancel)

    def _repr_png_(self) -> Any:
        return self.render()._repr_png_()


def compare(
    a: Any,
    b: Any,
    *,
    align: Optional[str] = None,
    rescale: bool = False,
    tolerance: Optional[float] = None,
    precision: Optional[str] = None,
    deviation: Optional[str] = None,
    features: Optional[str] = None,
    renderer: Optional[Renderer] = None,
    cancel: Optional[Cancel] = None,
) -> Comparison:
    """Compares two models: volumes that both share, distances between their surfaces, regions and parts that differ.

    a, b: sources as for `render`, or Scenes
    align: motion of b before: "none" (default), "bounds", "principal" or "icp"
    rescale: the alignment may scale b
    tolerance: largest distance of surfaces that are the same; default: a millionth of the size of a
    precision: "full" (default), or "quick": fewer rays and points
    deviation: "on" (default), or "off": without distances between the surfaces, which takes a third of the time
    features: "on" (default), or "off": without holes that differ
    renderer, cancel: as for `render`

    >>> comparison = zraster.compare("a.stl", "b.stl", align="principal")
    >>> comparison.iou, comparison.hausdorff, comparison["deviation"]["f1"]["value"]
    """
    used = given_or_shared(renderer)
    given = {"align": align, "rescale": "on" if rescale else None, "tolerance": tolerance, "precision": precision, "deviation": deviation, "features": features}
    query = {name: str(value) for name, value in given.items() if value is not None}
    return Comparison([_read("a", a, used), _read("b", b, used)], query, cancel)
