"""Writes data sets in the layout of BOP (Benchmark for 6D Object Pose Estimation).

>>> zraster.bop.write("cups", scene, orbit={"count": 1000}, objects={"cup": 1}, unit=1000)

makes cups/train_pbr/000000 with rgb/, depth/, mask/ and mask_visib/, and the files scene_camera.json, scene_gt.json and
scene_gt_info.json. Lengths are in millimetres, matrices by rows, the camera's axes those of OpenCV.
"""
from __future__ import annotations

import itertools
import json
import os
from typing import Any, Dict, List, Mapping, Optional

from . import _stream
from ._errors import OptionError

__all__ = ["write"]

FOLDERS = ("rgb", "depth", "mask", "mask_visib")


def write(
    folder: Any,
    scene: Any,
    *,
    objects: Optional[Mapping[str, int]] = None,
    unit: float = 1000.0,
    depth_scale: float = 0.1,
    split: str = "train_pbr",
    scene_id: int = 0,
    **options: Any,
) -> str:
    """Draws views and writes their pictures, masks, poses and cameras, each as soon as it is drawn. Returns the folder of
    the scene. Pictures of an earlier data set there are removed, once the first view is drawn; its three lists are
    replaced at the end.

    scene: a scene as a dict, a Scene, the path of a scene or a model, or an object with vertices and faces
    objects: obj_id by the names of nodes or meshes; others are drawn and not listed. Default: meshes, from 1 on
    unit: millimetres per unit of the scene; 1000: the scene is in metres
    depth_scale: millimetres per step of the depth pictures, which end at 65535 steps
    options: one of views, orbit, turntable and animate, and others as for `render`, such as size=(640, 480). Cameras have
        a perspective or intrinsics. Scenes without a projection and a look get a perspective of 45 degrees

    px_count_valid counts pixels of the silhouette that have a depth: all of them, since pictures have no noise. A scale of
    a node is part of its object: the model is the mesh with that scale.
    """
    if not unit > 0 or not depth_scale > 0:
        raise OptionError("unit and depth_scale: numbers greater than 0")
    place = os.path.join(os.fspath(folder), split, f"{scene_id:06d}")
    numbers = _stream.Numbers("objects", objects)
    outputs: List[Dict[str, Any]] = [
        {"channel": "color", "encoding": "png"},
        {"channel": "depth", "encoding": "png16", "scale": depth_scale / unit},
        {"channel": "masks", "encoding": "zip"},
    ]
    views = _stream.draw(scene, outputs, options)
    first = next(views)  # a refused request has written nothing
    for name in FOLDERS:
        _stream.empty(os.path.join(place, name))
    with _Lists(place) as lists:
        for view in itertools.chain([first], views):
            _put_view(place, lists, view, numbers, unit, depth_scale)
    numbers.warn_of_unused()
    return place


class _Lists:
    """The three files with an object per picture, written picture by picture."""

    def __init__(self, place: str) -> None:
        names = ("camera", "gt", "gt_info")
        self._files = [_stream.Replacing(os.path.join(place, f"scene_{name}.json")) for name in names]

    def add(self, number: int, *values: Any) -> None:
        for file, value in zip(self._files, values):
            file.write(f"{'{' if number == 0 else ','}\n{json.dumps(str(number))}: {json.dumps(value)}")

    def __enter__(self) -> "_Lists":
        return self

    def __exit__(self, *error: Any) -> None:
        for file in self._files:
            file.write("\n}\n")
            file.__exit__(*error)


def _flat(rows: Any) -> List[float]:
    return [value for row in rows for value in row]


def _put_file(place: str, folder: str, name: str, data: bytes) -> None:
    file = os.open(f"{place}/{folder}/{name}.png", os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
    try:
        while data:
            data = data[os.write(file, data) :]
    finally:
        os.close(file)


def _pose(camera: _stream.Camera, instance: Mapping[str, Any], number: int, unit: float) -> Dict[str, Any]:
    rotation, translation = _stream.pose_of(camera, instance)
    return {"obj_id": number, "cam_R_m2c": _flat(rotation), "cam_t_m2c": [unit * value for value in translation]}


def _info(instance: Mapping[str, Any]) -> Dict[str, Any]:
    return {
        "bbox_obj": _stream.size_of(instance["box"]),
        "bbox_visib": _stream.size_of(instance.get("visibleBox")),
        "px_count_all": instance["pixels"],
        "px_count_valid": instance["pixels"],
        "px_count_visib": instance["visiblePixels"],
        "visib_fract": instance["visibleFraction"],
    }


def _put_view(
    place: str, lists: _Lists, view: _stream.View, numbers: _stream.Numbers, unit: float, depth_scale: float
) -> None:
    camera, name = view.camera, f"{view.number:06d}"
    listed = [(instance, number) for instance in view.instances for number in [numbers.of(instance)] if number is not None]
    _put_file(place, "rgb", name, view.files["color.png"])
    _put_file(place, "depth", name, view.files["depth.png"])
    for place_in_list, (instance, _) in enumerate(listed):
        for folder, kind in (("mask", "amodal"), ("mask_visib", "visible")):
            data = view.files[f"masks/{instance['instanceId']:06d}.{kind}.png"]
            _put_file(place, folder, f"{name}_{place_in_list:06d}", data)
    to_camera = camera.world_to_camera
    lists.add(
        view.number,
        {
            "cam_K": _flat(camera.k),
            "cam_R_w2c": _flat(row[:3] for row in to_camera),
            "cam_t_w2c": [unit * row[3] for row in to_camera],
            "depth_scale": depth_scale,
        },
        [_pose(camera, instance, number, unit) for instance, number in listed],
        [_info(instance) for instance, _ in listed],
    )
