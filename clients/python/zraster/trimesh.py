"""Scenes and meshes of trimesh, which is not imported: scenes are read by their attributes.

>>> png = zraster.trimesh.save_image(scene, (640, 480))
>>> picture = zraster.render(zraster.trimesh.scene_of(scene), ["color", "depth"], look="clay")
"""
from __future__ import annotations

from typing import Any, Dict, List, Optional, Tuple

from . import render
from ._source import scene_of_mesh

# Options of trimesh's window, which have no effect on a picture of zraster.
_WINDOW = {"smooth", "flags", "visible", "fullscreen", "resizable", "start_loop", "callback", "callback_period", "caption",
           "fixed", "offset_lines", "line_settings", "window_conf", "profile", "record"}  # fmt: skip


def _texture_of(visual: Any, name: str, parts: Dict[str, bytes]) -> Tuple[Dict[str, Any], Dict[str, Any]]:
    """Returns keys of a material and of a mesh."""
    import numpy

    from .pyrender.material import Texture

    given = visual.material
    image = getattr(given, "image", None)
    if image is None:
        image = getattr(given, "baseColorTexture", None)
    if image is None or visual.uv is None:
        color = getattr(given, "main_color", None)
        return ({} if color is None else {"baseColorFactor": (numpy.asarray(color) / 255).tolist()}), {}
    parts[name] = Texture(source=image).png()
    uv = numpy.asarray(visual.uv, "f4")
    return {"baseColorTexture": {"asset": name}}, {"texcoords": numpy.stack([uv[:, 0], 1 - uv[:, 1]], axis=1)}


def _mesh_of(geometry: Any, name: str, parts: Dict[str, bytes]) -> Tuple[Dict[str, Any], Dict[str, Any]]:
    """Returns a material and a mesh; a cloud of points has no faces."""
    if not hasattr(geometry, "faces"):
        import numpy

        count = len(geometry.vertices)
        mesh: Dict[str, Any] = {
            "positions": geometry.vertices,
            "points": numpy.arange(count, dtype="u4"),
            "pointSize": 3,
        }
        colors = getattr(geometry, "colors", None)
        if colors is not None and len(colors) == count:
            mesh["colors"] = colors
        return {"name": name}, {"name": name, "material": name, **mesh}
    made = scene_of_mesh(geometry)
    material, mesh = {**made["materials"][0], "name": name}, {**made["meshes"][0], "name": name, "material": name}
    visual = getattr(geometry, "visual", None)
    if getattr(visual, "kind", None) == "texture":
        keys, coordinates = _texture_of(visual, name, parts)
        material.update(keys)
        mesh.update(coordinates)
    return material, mesh


def _is_drawn(geometry: Any) -> bool:
    return hasattr(geometry, "vertices") and (hasattr(geometry, "faces") or not hasattr(geometry, "entities"))


def scene_of(scene: Any, parts: Optional[Dict[str, bytes]] = None) -> Dict[str, Any]:
    """Converts a trimesh.Scene, or a Trimesh, to a scene with the look studio: meshes, clouds of points, and the camera if
    the scene has one. Paths are left out. parts: a dict that receives the textures; pass it to `render`, too. None: no
    textures."""
    geometries = {"mesh": scene} if hasattr(scene, "vertices") else dict(scene.geometry)
    textures: Dict[str, bytes] = {} if parts is None else parts
    made = {name: _mesh_of(one, name, textures) for name, one in geometries.items() if _is_drawn(one)}
    if parts is None:
        for material, mesh in made.values():
            material.pop("baseColorTexture", None)
            mesh.pop("texcoords", None)
    nodes: List[Dict[str, Any]] = [{"mesh": "mesh"}]
    if not hasattr(scene, "vertices"):
        placed = [scene.graph[node] for node in scene.graph.nodes_geometry]
        nodes = [{"mesh": name, "matrix": matrix.tolist()} for matrix, name in placed if name in made]
    found: Dict[str, Any] = {
        "look": "studio",
        "materials": [material for material, _ in made.values()],
        "meshes": [mesh for _, mesh in made.values()],
        "nodes": nodes,
    }
    if getattr(scene, "has_camera", False):
        camera = scene.camera
        found["view"] = {
            "cameraToWorld": scene.camera_transform.tolist(),
            "perspective": {"yfovDegrees": float(camera.fov[1])},
            "znear": float(camera.z_near),
            "zfar": float(camera.z_far),
        }
    return found


def save_image(scene: Any, resolution: Any = None, **options: Any) -> bytes:
    """Returns a PNG of a trimesh.Scene, as its own save_image does, in the look studio.

    resolution: (width, height); default: that of the scene's camera, else (640, 480)
    options: keywords of `zraster.render`; the numbers of `background` may be 0..255. Options of trimesh's window have
        no effect
    """
    if resolution is None and getattr(scene, "has_camera", False):
        resolution = scene.camera.resolution
    options = {name: value for name, value in options.items() if name not in _WINDOW}
    background = options.get("background")
    if background is not None and not isinstance(background, (str, dict)):
        import numpy

        color = numpy.asarray(background)
        options["background"] = (color / 255 if color.dtype.kind in "iu" else color).tolist()
    size = None if resolution is None else tuple(int(side) for side in resolution)
    parts: Dict[str, bytes] = {}
    return render(scene_of(scene, parts), size=size, parts=parts, **options).png
