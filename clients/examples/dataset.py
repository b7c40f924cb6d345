"""Data sets for training, with __len__ and __getitem__ as torch.utils.data.DataLoader expects them. They need numpy and PIL,
and no torch. Both can be pickled, so that workers in other processes load or draw, too:

>>> import zraster.bop
>>> place = zraster.bop.write("cups", scene, orbit={"count": 1000}, objects={"cup": 1})
>>> loader = torch.utils.data.DataLoader(BopFolder(place), batch_size=None, num_workers=4)
"""
import json
import os

import numpy
from PIL import Image

import zraster


class BopFolder:
    """Views of a folder that zraster.bop.write made, such as cups/train_pbr/000000. An item is a dict of arrays:

    image (h, w, 3) uint8; depth (h, w) float32, millimetres, 0 without one; k (3, 3); and for n objects: objects (n,), their
    numbers; rotations (n, 3, 3) and translations (n, 3) from the model to the camera, millimetres; masks and visible
    (n, h, w) bool
    """

    def __init__(self, folder):
        self.folder = folder
        self.cameras, self.poses = self._list("camera"), self._list("gt")
        self.numbers = sorted(self.cameras, key=int)

    def _list(self, name):
        with open(os.path.join(self.folder, f"scene_{name}.json")) as file:
            return json.load(file)

    def _pixels(self, folder, name, mode=None):
        with Image.open(os.path.join(self.folder, folder, name + ".png")) as image:
            return numpy.array(image.convert(mode) if mode else image)

    def _masks(self, folder, name, count, shape):
        masks = [self._pixels(folder, f"{name}_{i:06d}") > 0 for i in range(count)]
        return numpy.array(masks, bool).reshape(count, *shape)

    def __len__(self):
        return len(self.numbers)

    def __getitem__(self, index):
        number = self.numbers[index]
        name, camera, poses = f"{int(number):06d}", self.cameras[number], self.poses[number]
        image = self._pixels("rgb", name, "RGB")
        count, shape = len(poses), image.shape[:2]
        return {
            "image": image,
            "depth": self._pixels("depth", name).astype(numpy.float32) * numpy.float32(camera["depth_scale"]),
            "k": numpy.array(camera["cam_K"]).reshape(3, 3),
            "objects": numpy.array([pose["obj_id"] for pose in poses], int),
            "rotations": numpy.array([pose["cam_R_m2c"] for pose in poses]).reshape(count, 3, 3),
            "translations": numpy.array([pose["cam_t_m2c"] for pose in poses]).reshape(count, 3),
            "masks": self._masks("mask", name, count, shape),
            "visible": self._masks("mask_visib", name, count, shape),
        }


class DrawnViews:
    """Views that are drawn on access, without files: image (h, w, 3) uint8, depth (h, w) float32 in units of the
    scene, instances (h, w) uint32, counted from 1. Each has another direction; the same index gives the same view."""

    def __init__(self, scene, count, **options):
        self.scene, self.count = zraster.Scene(scene, **options), count

    def __len__(self):
        return self.count

    def __getitem__(self, index):
        if not 0 <= index < self.count:
            raise IndexError(index)
        random = numpy.random.default_rng(index)
        view = {"azimuthDegrees": random.uniform(0, 360), "elevationDegrees": random.uniform(-20, 80)}
        view["perspective"] = {"yfovDegrees": random.uniform(25, 45)}
        picture = self.scene.render(["color", "depth", "instanceId"], view=view)
        return {"image": picture["color"][..., :3], "depth": picture["depth"], "instances": picture["instanceId"]}
