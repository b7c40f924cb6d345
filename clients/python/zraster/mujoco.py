"""The interface of mujoco.Renderer, drawn by zraster: `renderer = zraster.mujoco.Renderer(model)`.

Depth is exact at the centres of pixels, in metres along the axis of the camera. Background pixels have the depth of the
far plane. Each light shines along its direction from afar, with Phong's shading. Planes of size 0 reach 20 times the
extent of the model. Left out: skies, textures, reflections, haze, skins, and decorations such as arrows and labels.
"""
from __future__ import annotations

import importlib
from typing import Any, Dict, List, Tuple, Union

import numpy as np

from ._renderer import shared
from ._request import make

PLANE, HFIELD, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH = range(8)  # mjtGeom
SIDES = 32


def _lathe(radii: Any, heights: Any, normals: Any) -> Dict[str, Any]:
    """Turns a profile around z. normals: (radial, vertical), one per point of the profile, from top to bottom."""
    angles = np.arange(SIDES) * (2 * np.pi / SIDES)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    rows = len(radii)
    positions, directions = np.empty((rows, SIDES, 3), np.float32), np.empty((rows, SIDES, 3), np.float32)
    positions[..., :2], positions[..., 2] = np.multiply.outer(radii, circle), np.asarray(heights)[:, None]
    directions[..., :2], directions[..., 2] = np.multiply.outer(normals[:, 0], circle), normals[:, 1, None]
    at = np.arange(rows * SIDES, dtype=np.uint32).reshape(rows, SIDES)
    after = np.roll(at, -1, axis=1)
    faces = np.stack([at[:-1], at[1:], after[1:], after[:-1]], axis=-1).reshape(-1, 4)
    return {"positions": positions.reshape(-1, 3), "normals": directions.reshape(-1, 3), "faces": faces}


def _ball(radius: float, half: float) -> Dict[str, Any]:
    """Returns a sphere, or a capsule whose cylinder has the half length `half`."""
    angles = np.concatenate([np.linspace(0, np.pi / 2, SIDES // 4 + 1), np.linspace(np.pi / 2, np.pi, SIDES // 4 + 1)])
    normals = np.stack([np.sin(angles), np.cos(angles)], axis=1)
    shifts = np.where(np.arange(len(angles)) <= SIDES // 4, half, -half)
    return _lathe(radius * normals[:, 0], radius * normals[:, 1] + shifts, normals)


def _cylinder(radius: float, half: float) -> Dict[str, Any]:
    normals = np.array([[0, 1], [0, 1], [1, 0], [1, 0], [0, -1], [0, -1]], np.float32)
    return _lathe(np.array([0, radius, radius, radius, radius, 0]), [half, half, half, -half, -half, -half], normals)


def _box(size: Any) -> Dict[str, Any]:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * size
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return {"positions": corners, "faces": np.array(faces), "shading": "flat"}


class Renderer:
    """Renders the scenes of a model: height x width pixels. max_geom: largest number of geoms in a scene."""

    def __init__(self, model: Any, height: int = 240, width: int = 320, max_geom: int = 10000, **_: Any) -> None:
        self._mujoco: Any = importlib.import_module("mujoco")
        self._model, self._size = model, (int(width), int(height))
        self._scene = self._mujoco.MjvScene(model=model, maxgeom=max_geom)
        self._option = self._mujoco.MjvOption()
        self._mode = "color"

    model = property(lambda self: self._model)
    scene = property(lambda self: self._scene)
    width = property(lambda self: self._size[0])
    height = property(lambda self: self._size[1])

    def enable_depth_rendering(self) -> None:
        self._mode = "depth"

    def disable_depth_rendering(self) -> None:
        self._mode = "color" if self._mode == "depth" else self._mode

    def enable_segmentation_rendering(self) -> None:
        self._mode = "instanceId"

    def disable_segmentation_rendering(self) -> None:
        self._mode = "color" if self._mode == "instanceId" else self._mode

    def close(self) -> None:
        """Does nothing: there is no context to free."""

    def __enter__(self) -> "Renderer":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def update_scene(self, data: Any, camera: Union[int, str, Any] = -1, scene_option: Any = None) -> None:
        """Sets the scene to the state in `data`. camera: a number, a name or an MjvCamera; -1: the free camera."""
        mujoco = self._mujoco
        if isinstance(camera, (int, str)):
            number = camera
            if isinstance(camera, str):
                number = mujoco.mj_name2id(self._model, int(mujoco.mjtObj.mjOBJ_CAMERA), camera)
                if number == -1:
                    raise ValueError(f'The camera "{camera}" does not exist.')
            if not -1 <= int(number) < self._model.ncam:
                raise ValueError(f"The camera id {number} is out of range [-1, {self._model.ncam}).")
            camera = mujoco.MjvCamera()
            camera.fixedcamid = number
            kinds = mujoco.mjtCamera
            camera.type = kinds.mjCAMERA_FREE if number == -1 else kinds.mjCAMERA_FIXED
            if number == -1:
                mujoco.mjv_defaultFreeCamera(self._model, camera)
        every = int(mujoco.mjtCatBit.mjCAT_ALL)
        mujoco.mjv_updateScene(self._model, data, scene_option or self._option, None, camera, every, self._scene)

    def render(self, *, out: Any = None) -> Any:
        """Returns (h, w, 3) uint8; with depth (h, w) float32 metres; with segmentation (h, w, 2) int32, pairs of objid and
        objtype, -1 for background pixels. `out` is filled and returned."""
        made = self._result(self._drawn())
        if out is None:
            return made
        if out.shape != made.shape:
            raise ValueError(f"Expected `out.shape == {made.shape}`. Got `out.shape={out.shape}` instead.")
        out[...] = made
        return out

    def _result(self, geoms: List[Any]) -> Any:
        view, far = self._view()
        shape = self._size[::-1]
        picture: Any = None
        if geoms:
            scene = {"view": view, "up": "z", **self._style(), **self._geometry(geoms)}
            picture = make(scene, [self._mode], self._size, None, {}).draw(shared(), None)
        if self._mode == "depth":
            depth = np.full(shape, np.inf, np.float32) if picture is None else picture["depth"]
            depth[np.isinf(depth)] = far
            return depth
        if self._mode == "instanceId":
            pairs = np.array([[-1, -1], *([geom.objid, geom.objtype] for geom in geoms)], np.int32)
            return pairs[np.zeros(shape, int) if picture is None else picture.view("instanceId")]
        return np.zeros((*shape, 3), np.uint8) if picture is None else picture["color"]

    # ---- the scene ----

    def _drawn(self) -> List[Any]:
        geoms = [self._scene.geoms[i] for i in range(self._scene.ngeom)]
        is_seen = self._mode == "color"
        return [geom for geom in geoms if int(geom.type) <= MESH and (is_seen or geom.segid != -1)]

    def _view(self) -> Tuple[Dict[str, Any], float]:
        """Returns the view in the middle between the two eyes, and the far plane."""
        eyes = self._scene.camera

        def mean(name: str) -> Any:
            return (np.asarray(getattr(eyes[0], name), np.float64) + np.asarray(getattr(eyes[1], name), np.float64)) / 2

        near, far, bottom, top = (float(mean("frustum_" + name)) for name in ("near", "far", "bottom", "top"))
        width, centre = float(getattr(eyes[0], "frustum_width", 0.0)), float(mean("frustum_center"))
        half = width if width > 0 else (top - bottom) / 2 * self._size[0] / self._size[1]
        pose = np.eye(4)
        forward, up = mean("forward"), mean("up")
        pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = np.cross(forward, up), up, -forward, mean("pos")
        matrix = np.zeros((4, 4))
        if getattr(eyes[0], "orthographic", False):
            matrix[0, 0], matrix[1, 1], matrix[2, 2], matrix[3, 3] = 1 / half, 2 / (top - bottom), 2 / (near - far), 1
            matrix[:3, 3] = -centre / half, (top + bottom) / (bottom - top), (far + near) / (near - far)
        else:
            matrix[0, 0], matrix[1, 1], matrix[2, 2] = (
                near / half,
                2 * near / (top - bottom),
                (far + near) / (near - far),
            )
            matrix[:3, 2] = centre / half, (top + bottom) / (top - bottom), matrix[2, 2]
            matrix[2, 3], matrix[3, 2] = 2 * far * near / (near - far), -1
        return {"cameraToWorld": pose.tolist(), "projectionMatrix": matrix.tolist()}, far

    def _style(self) -> Dict[str, Any]:
        if self._mode != "color":
            return {"shading": "unlit"}
        given = [self._scene.lights[i] for i in range(self._scene.nlight)]
        ambient = sum((np.asarray(light.ambient, np.float64) for light in given), np.zeros(3)).clip(0, 1)
        lights = [{"type": "directional", "direction": np.asarray(light.dir, np.float64).tolist(),
                   "color": np.asarray(light.diffuse, np.float64).clip(0, 1).tolist()} for light in given]  # fmt: skip
        return {
            "shading": "phong",
            "background": [0, 0, 0],
            "samples": 4,
            "lights": lights,
            "ambient": ambient.tolist(),
        }

    def _geometry(self, geoms: List[Any]) -> Dict[str, Any]:
        meshes: Dict[Any, Dict[str, Any]] = {}
        materials, nodes = [], []
        for geom in geoms:
            rgba = np.asarray(geom.rgba, np.float64).clip(0, 1)
            key = (
                int(geom.type),
                int(geom.dataid),
                *np.asarray(geom.size).tolist(),
                *rgba.tolist(),
                float(geom.specular),
                float(geom.shininess),
            )
            if key not in meshes:
                name = str(len(meshes))
                material: Dict[str, Any] = {"name": name, "baseColorFactor": rgba.tolist()}
                if self._mode == "color":
                    shine = {"specular": [min(float(geom.specular), 1.0)] * 3, "shininess": 128 * float(geom.shininess)}
                    material.update(shine, alphaMode="BLEND" if rgba[3] < 1 else "OPAQUE")
                materials.append(material)
                meshes[key] = {"name": name, "material": name, "doubleSided": False, **self._mesh(geom)}
                if self._mode != "color":
                    meshes[key].pop("shading", None)
            matrix = np.eye(4)
            matrix[:3, :3], matrix[:3, 3] = np.reshape(geom.mat, (3, 3)), geom.pos
            if int(geom.type) == ELLIPSOID:
                matrix[:3, :3] *= np.asarray(geom.size, np.float64)
            nodes.append({"mesh": meshes[key]["name"], "matrix": matrix.tolist()})
        return {"meshes": list(meshes.values()), "materials": materials, "nodes": nodes}

    def _mesh(self, geom: Any) -> Dict[str, Any]:
        size, model, kind = np.asarray(geom.size, np.float64), self._model, int(geom.type)
        if kind in (SPHERE, CAPSULE):
            return _ball(size[0], size[2] if kind == CAPSULE else 0.0)
        if kind == ELLIPSOID:
            return _ball(1.0, 0.0)
        if kind == CYLINDER:
            return _cylinder(size[0], size[2])
        if kind == BOX:
            return _box(size)
        if kind == PLANE:
            x, y = (side if side > 0 else 20 * float(model.stat.extent) for side in size[:2])
            return {
                "positions": [[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]],
                "faces": [[0, 1, 2, 3]],
                "shading": "flat",
            }
        if kind == HFIELD:
            i = int(geom.dataid)
            rows, columns, start = int(model.hfield_nrow[i]), int(model.hfield_ncol[i]), int(model.hfield_adr[i])
            x, y, top = np.asarray(model.hfield_size[i], np.float64)[:3].tolist()
            values = np.asarray(model.hfield_data[start : start + rows * columns]).reshape(rows, columns) * top
            return {"heights": {"values": values, "x": [-x, x], "y": [-y, y]}}
        i = int(geom.dataid) // 2  # 2 i + 1 is the convex hull
        first, count = int(model.mesh_vertadr[i]), int(model.mesh_vertnum[i])
        face, faces = int(model.mesh_faceadr[i]), int(model.mesh_facenum[i])
        return {"positions": model.mesh_vert[first : first + count], "faces": model.mesh_face[face : face + faces]}
