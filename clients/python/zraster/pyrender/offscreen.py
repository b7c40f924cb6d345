"""OffscreenRenderer: draws a Scene of pyrender.

Depth is in metres along the axis of the camera, at the centres of pixels; 0 for background pixels. Colours follow the
formulas of pyrender, but are encoded as sRGB instead of by a power of 1 / 2.2. They differ by a few steps of 255.
"""
from __future__ import annotations

import warnings
from typing import Any, Dict, Iterator, List, Optional, Set, Tuple

import numpy as np

from .._errors import Warning
from .._renderer import shared
from .._request import make
from .constants import RenderFlags
from .light import DirectionalLight, PointLight, SpotLight
from .material import scene_material, srgb, undrawn
from .mesh import Primitive
from .scene import Node, Scene

_NORMALS = RenderFlags.VERTEX_NORMALS | RenderFlags.FACE_NORMALS


class OffscreenRenderer:
    """Draws pictures of viewport_width x viewport_height pixels. point_size: pixels. Any thread may use it."""

    def __init__(self, viewport_width: int, viewport_height: int, point_size: float = 1.0):
        self.viewport_width, self.viewport_height = int(viewport_width), int(viewport_height)
        self.point_size = float(point_size)

    def render(
        self, scene: Scene, flags: int = RenderFlags.NONE, seg_node_map: Optional[Dict[Node, Any]] = None
    ) -> Any:
        """Draws a scene.

        flags: RenderFlags, combined by |
        seg_node_map: with SEG, colours of nodes, 0..255; other nodes are not drawn
        Returns color, (h, w, 3) uint8 or, with RGBA, (h, w, 4), and depth, (h, w) float32; with DEPTH_ONLY, depth alone.
        Raises NotImplementedError for SHADOWS_POINT if the scene has point lights.
        """
        if scene.main_camera_node is None:
            raise ValueError("Cannot render scene without a camera")
        if (
            flags & RenderFlags.SHADOWS_POINT
            and scene.point_lights
            and not flags & (RenderFlags.DEPTH_ONLY | RenderFlags.SEG)
        ):
            raise NotImplementedError("point lights have no shadows, here as in pyrender: leave out SHADOWS_POINT")
        if flags & _NORMALS:
            warnings.warn("VERTEX_NORMALS and FACE_NORMALS draw nothing", Warning, stacklevel=2)
        drawing = _Drawing(scene, flags, seg_node_map or {}, self)
        if drawing.undrawn:
            text = f"{', '.join(sorted(drawing.undrawn))}: not drawn; baseColorTexture is the only texture that is"
            warnings.warn(text, Warning, stacklevel=2)
        return drawing.depth() if flags & RenderFlags.DEPTH_ONLY else (drawing.color(), drawing.depth())

    def delete(self) -> None:
        """Does nothing: there is no context to free."""


class _Drawing:
    def __init__(self, scene: Scene, flags: int, colors: Dict[Node, Any], renderer: OffscreenRenderer) -> None:
        self.scene, self.flags, self.colors, self.renderer = scene, flags, colors, renderer
        self.is_seg, self.is_flat = bool(flags & RenderFlags.SEG), bool(flags & RenderFlags.FLAT)
        self.size = (renderer.viewport_width, renderer.viewport_height)
        self.parts: Dict[str, bytes] = {}
        self.owners: List[Node] = []  # of the instances
        self.undrawn: Set[str] = set()  # names of textures
        made = self.geometry()
        self.picture = None
        if made["nodes"]:
            made = {"view": self.view(), **self.style(), **made}
            self.picture = make(made, self.channels(), self.size, self.parts, {}).draw(shared(), None)

    def channels(self) -> List[str]:
        if self.flags & RenderFlags.DEPTH_ONLY:
            return ["depth"]
        return ["depth", "instanceId" if self.is_seg else "color"]

    def view(self) -> Dict[str, Any]:
        node = self.scene.main_camera_node
        matrix = node.camera.get_projection_matrix(*self.size)  # type: ignore[union-attr]
        return {"cameraToWorld": self.scene.get_pose(node).tolist(), "projectionMatrix": matrix.tolist()}  # type: ignore[arg-type]

    def background(self) -> List[float]:
        color: List[float] = np.clip(self.scene.bg_color, 0, 1).astype(np.float64).tolist()
        return color if self.flags & RenderFlags.RGBA else color[:3]

    def style(self) -> Dict[str, Any]:
        if self.is_seg or self.flags & RenderFlags.DEPTH_ONLY:
            return {"shading": "unlit"}
        made: Dict[str, Any] = {"background": self.background(), "samples": 4}
        if self.is_flat:
            return {"shading": "unlit", **made}
        ambient = np.asarray(self.scene.ambient_light, np.float64).clip(0, 1).tolist()
        return {"shading": "pbr", "lights": list(self.lights()), "ambient": ambient, "toneMapping": "none", **made}

    def lights(self) -> Iterator[Dict[str, Any]]:
        for node in self.scene._parents:
            light = node.light
            if light is None:
                continue
            pose = self.scene.get_pose(node)
            made: Dict[str, Any] = {"color": light.color.tolist(), "intensity": light.intensity / np.pi}
            if isinstance(light, (PointLight, SpotLight)):
                made.update(type="point", position=pose[:3, 3].tolist())
            if isinstance(light, SpotLight):
                made.update(
                    type="spot",
                    innerConeAngle=light.innerConeAngle,
                    outerConeAngle=min(light.outerConeAngle, np.pi / 2),
                )
                made["shadows"] = bool(self.flags & RenderFlags.SHADOWS_SPOT)
            if isinstance(light, DirectionalLight):
                made.update(type="directional", shadows=bool(self.flags & RenderFlags.SHADOWS_DIRECTIONAL))
            if not isinstance(light, PointLight):
                made["direction"] = (-pose[:3, 2]).tolist()
            yield made

    # ---- geometry ----

    def drawn(self) -> Iterator[Tuple[Node, Primitive]]:
        """Yields nodes and primitives in the order of adding: visible ones; with SEG, those with a colour."""
        for node in self.scene._parents:
            if node.mesh is not None and node.mesh.is_visible and (not self.is_seg or node in self.colors):
                for primitive in node.mesh.primitives:
                    if len(primitive.items()[1]):
                        yield node, primitive

    def geometry(self) -> Dict[str, Any]:
        meshes: Dict[int, Dict[str, Any]] = {}
        materials: List[Dict[str, Any]] = []
        nodes: List[Dict[str, Any]] = []
        for node, primitive in self.drawn():
            if id(primitive) not in meshes:
                name = f"{len(meshes)}"
                color = primitive.color_0
                alpha = 1.0 if color is None else float(color[:, 3].min())
                if not self.flags & RenderFlags.DEPTH_ONLY and not self.is_seg:
                    materials.append(scene_material(name, primitive.material, alpha, self.is_flat, self.parts))
                    if not self.is_flat:
                        self.undrawn.update(undrawn(primitive.material))
                meshes[id(primitive)] = self.mesh(name, primitive)
            pose = self.scene.get_pose(node)
            instances: Any = (None,) if primitive.poses is None else primitive.poses
            for instance in instances:
                matrix = pose if instance is None else pose @ instance
                nodes.append({"mesh": meshes[id(primitive)]["name"], "matrix": matrix.tolist()})
                self.owners.append(node)
        return {"meshes": list(meshes.values()), "materials": materials, "nodes": nodes}

    def mesh(self, name: str, primitive: Primitive) -> Dict[str, Any]:
        kind, items = primitive.items()
        material = primitive.material
        is_data = self.is_seg or bool(self.flags & RenderFlags.DEPTH_ONLY)
        made: Dict[str, Any] = {"name": name, "positions": primitive.positions, kind: items}
        if kind == "points":
            made["pointSize"] = min(max(self.renderer.point_size, 1.0), 64.0)
        if kind == "faces":  # depth and ids have filled faces and front sides only, as in pyrender
            is_wire = (material.wireframe != bool(self.flags & RenderFlags.FLIP_WIREFRAME)) or bool(
                self.flags & RenderFlags.ALL_WIREFRAME)  # fmt: skip
            if is_wire and not is_data:
                made.update(fill=False, outline=True)
            made["doubleSided"] = not is_data and bool(material.doubleSided or self.flags & RenderFlags.SKIP_CULL_FACES)
        if is_data:
            return made
        made["material"] = name
        if primitive.normals is not None and kind == "faces" and not self.is_flat:
            made["normals"] = primitive.normals
        if primitive.color_0 is not None:
            made["colors"] = primitive.color_0 if self.is_flat else srgb(primitive.color_0).astype(np.float32)
        if "texcoords" not in made and name in self.parts:
            if primitive.texcoord_0 is None:
                raise ValueError("a material with a texture needs texcoord_0")
            made["texcoords"] = np.stack([primitive.texcoord_0[:, 0], 1 - primitive.texcoord_0[:, 1]], axis=1)
        return made

    # ---- results ----

    def depth(self) -> Any:
        if self.picture is None:
            return np.zeros(self.size[::-1], np.float32)
        depth = self.picture["depth"]
        depth[np.isinf(depth)] = 0.0
        return depth

    def color(self) -> Any:
        if self.is_seg:
            table = np.array([[0, 0, 0], *(np.broadcast_to(self.colors[node], 3) for node in self.owners)])
            table = table.clip(0, 255).astype(np.uint8)
            ids = np.zeros(self.size[::-1], np.uint32) if self.picture is None else self.picture.view("instanceId")
            return self.with_alpha(table[ids])
        if self.picture is None:
            return np.tile(np.rint(np.array(self.background()) * 255).astype(np.uint8), (*self.size[::-1], 1))
        return self.with_alpha(self.picture["color"])

    def with_alpha(self, color: Any) -> Any:
        if self.flags & RenderFlags.RGBA and color.shape[2] == 3:
            return np.dstack([color, np.full(color.shape[:2], 255, np.uint8)])
        return color
