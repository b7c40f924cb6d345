"""Writes data sets in the format of COCO: pictures, and a file of their instances.

>>> zraster.coco.write("cups", scene, orbit={"count": 1000}, categories={"cup": 1})

makes cups/images/000000.png, ... and cups/annotations.json, with a box, an area and the visible mask of each instance.
"""
from __future__ import annotations

import itertools
import json
import os
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple

from . import _stream
from ._arrays import load_numpy
from ._errors import OptionError

__all__ = ["decode", "write"]


def write(
    folder: Any,
    scene: Any,
    *,
    categories: Optional[Mapping[str, int]] = None,
    segmentation: str = "rle",
    **options: Any,
) -> str:
    """Draws views and writes their pictures and annotations, each as soon as it is drawn. Returns the path of the file.
    Pictures of an earlier data set there are removed, once the first view is drawn; its file is replaced at the end.

    scene: a scene as a dict, a Scene, the path of a scene or a model, or an object with vertices and faces
    categories: numbers by the names of nodes or meshes; others are drawn and not listed. Default: meshes, from 1 on
    segmentation: "rle", the exact mask as compressed run lengths; or "polygons", its outlines along the edges of pixels,
        without holes
    options: one of views, orbit, turntable and animate, and others as for `render`, such as size=(640, 480)

    Instances without a visible pixel are left out. bbox is x, y, width, height; area is the number of visible pixels.
    """
    if segmentation not in ("rle", "polygons"):
        raise OptionError(f"segmentation: {segmentation!r}: rle or polygons")
    place = os.fspath(folder)
    path = os.path.join(place, "annotations.json")
    numbers = _stream.Numbers("categories", categories)
    views = _stream.draw(scene, [{"channel": "color", "encoding": "png"}], options, needs_pinhole=False)
    first = next(views)  # a refused request has written nothing
    _stream.empty(os.path.join(place, "images"))
    with _stream.Replacing(path) as file:
        _put_views(place, file, itertools.chain([first], views), numbers, segmentation)
    numbers.warn_of_unused()
    return path


def _put_views(
    place: str, file: _stream.Replacing, views: Iterator[_stream.View], numbers: _stream.Numbers, segmentation: str
) -> None:
    images: List[Dict[str, Any]] = []
    count = 0
    file.write('{"annotations": [')
    for view in views:
        images.append(_put_image(place, view))
        for instance in view.instances:
            number = numbers.of(instance) if instance["visiblePixels"] else None
            if number is None:
                continue
            count += 1
            annotation = _annotation(view, instance, number, count, segmentation)
            file.write(f"{',' if count > 1 else ''}\n{json.dumps(annotation)}")
    listed = [{"id": number, "name": name, "supercategory": ""} for name, number in numbers.found.items()]
    file.write(f'\n], "images": {json.dumps(images)}, "categories": {json.dumps(listed)}, "info": {{}}, "licenses": []}}\n')


def _put_image(place: str, view: _stream.View) -> Dict[str, Any]:
    name = f"{view.number:06d}.png"
    data = view.files["color.png"]
    with open(os.path.join(place, "images", name), "wb") as file:
        file.write(data)
    width, height = (int.from_bytes(data[at : at + 4], "big") for at in (16, 20))
    return {"id": view.number, "file_name": name, "width": width, "height": height}


def _annotation(
    view: _stream.View, instance: Mapping[str, Any], category: int, number: int, segmentation: str
) -> Dict[str, Any]:
    visible = instance["visible"]
    return {
        "id": number,
        "image_id": view.number,
        "category_id": category,
        "iscrowd": 0,
        "area": instance["visiblePixels"],
        "bbox": _stream.size_of(instance["visibleBox"]),
        "segmentation": visible if segmentation == "rle" else _polygons(visible),
    }


# ---- run lengths ----


def _runs(text: str) -> List[int]:
    """Returns the lengths of runs of 0 and 1 in turn."""
    runs: List[int] = []
    value = shift = 0
    for character in text:
        group = ord(character) - 48
        value |= (group & 31) << shift
        shift += 5
        if group & 32:
            continue
        if group & 16:
            value -= 1 << shift
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
        value = shift = 0
    return runs


def _size(mask: Any) -> Tuple[int, int]:
    size = mask.get("size") if isinstance(mask, Mapping) else None
    if not isinstance(size, (list, tuple)) or len(size) != 2 or not all(type(n) is int and n >= 0 for n in size):
        raise ValueError('a mask has "size": [height, width] and "counts": a string of run lengths')
    return size[0], size[1]


def _checked_runs(counts: Any, height: int, width: int) -> List[int]:
    text = counts.decode("latin-1") if isinstance(counts, bytes) else counts
    if not isinstance(text, str):
        raise ValueError(f'"counts" of a mask is a string of run lengths, not {type(counts).__name__}')
    if any(not 48 <= ord(character) < 112 for character in text) or (text and (ord(text[-1]) - 48) & 32):
        raise ValueError('"counts" of a mask is no string of run lengths, or is cut short')
    runs = _runs(text)
    if min(runs, default=0) < 0:
        raise ValueError('"counts" of a mask has a run of less than 0 pixels')
    if sum(runs) != height * width:
        raise ValueError(f"the runs of a mask have {sum(runs)} pixels, not {height} x {width}")
    return runs


def decode(mask: Mapping[str, Any]) -> Any:
    """Returns the mask {"size", "counts"} as an array of booleans (h, w).

    Raises ValueError if it is none, such as one whose runs do not fill its size.
    """
    numpy = load_numpy()

    height, width = _size(mask)
    runs = _checked_runs(mask.get("counts"), height, width)
    return numpy.repeat(numpy.arange(len(runs)) % 2 == 1, runs).reshape(width, height).T


# ---- polygons ----

Point = Tuple[int, int]


def _columns(mask: Mapping[str, Any]) -> Dict[int, List[Point]]:
    """Returns the runs of 1 of each column: first and last row, the latter exclusive."""
    height = mask["size"][0]
    columns: Dict[int, List[Point]] = {}
    at = 0
    for number, run in enumerate(_runs(mask["counts"])):
        begin, at = at, at + run
        while number % 2 and begin < at:
            column, row = divmod(begin, height)
            end = min(at, (column + 1) * height)
            columns.setdefault(column, []).append((row, row + end - begin))
            begin = end
    return columns


def _rows_of(runs: List[Point]) -> List[int]:
    return [row for begin, end in runs for row in range(begin, end)]


def _edges(mask: Mapping[str, Any]) -> Dict[Point, List[Point]]:
    """Returns the edges between pixels of 1 and 0, from corner to corner, with 1 at their right (y points down)."""
    columns = _columns(mask)
    edges: Dict[Point, List[Point]] = {}
    for x, runs in columns.items():
        for begin, end in runs:
            edges.setdefault((x, begin), []).append((x + 1, begin))
            edges.setdefault((x + 1, end), []).append((x, end))
        rows = set(_rows_of(runs))
        for y in rows.difference(_rows_of(columns.get(x - 1, []))):
            edges.setdefault((x, y + 1), []).append((x, y))
        for y in rows.difference(_rows_of(columns.get(x + 1, []))):
            edges.setdefault((x + 1, y), []).append((x + 1, y + 1))
    return edges


def _next(edges: Dict[Point, List[Point]], before: Point, at: Point) -> Point:
    """Takes an edge that begins at a corner: of two, the one to the right, so that pixels that meet at corners stay
    apart."""
    found = edges[at]
    dx, dy = at[0] - before[0], at[1] - before[1]
    right = (at[0] - dy, at[1] + dx)
    return found.pop(found.index(right) if right in found else 0)


def _polygons(mask: Mapping[str, Any]) -> List[List[int]]:
    edges = _edges(mask)
    polygons: List[List[int]] = []
    for start in sorted(edges):
        while edges[start]:
            points = [start, edges[start].pop()]
            while points[-1] != start:
                points.append(_next(edges, points[-2], points[-1]))
            corners = _corners(points[:-1])
            pairs = zip(corners, corners[1:] + corners[:1])
            if sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs) > 0:  # others are holes
                polygons.append([value for point in corners for value in point])
    return polygons


def _corners(points: List[Point]) -> List[Point]:
    """Leaves out points on straight lines."""
    around = zip(points[-1:] + points[:-1], points, points[1:] + points[:1])
    return [b for a, b, c in around if (b[0] - a[0]) * (c[1] - b[1]) != (b[1] - a[1]) * (c[0] - b[0])]
