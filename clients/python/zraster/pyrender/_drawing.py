"""Drawings: scenes of pyrender as scenes of zraster, and their pictures."""
from __future__ import annotations

from typing import Any, Dict, Iterator, List, Optional, Set, Tuple

import numpy as np

from .._picture import Picture
from .._renderer import shared
from .._request import make
from ._lighting import LEAST_ROUGHNESS, lit_colors, srgb
from .constants import RenderFlags
from .light import DirectionalLight, PointLight, SpotLight
from .primitive import Primitive
from .scene import Node, Scene

# Textures of lit faces: attributes of materials, and keys of those of scenes.
_TEXTURES = ("normalTexture", "occlusionTexture", "emissiveTexture", "metallicRoughnessTexture")


class Drawing:
    """A picture of a scene. colors: of nodes, for SEG. undrawn: names of textures that are not drawn."""

    def __init__(self, scene: Scene, flags: int, colors: Dict[Node, Any], size: Tuple[int, int], point_size: float) -> None:
        self.scene, self.flags, self.colors, self.size, self.point_size = scene, flags, colors, size, point_size
        self.is_seg, self.is_flat = bool(flags & RenderFlags.SEG), bool(flags & RenderFlags.FLAT)
        self.is_data = self.is_seg or bool(flags & RenderFlags.DEPTH_ONLY)
        self.parts: Dict[str, bytes] = {}
        self.owners: List[Node] = []  # of the instances
        self.undrawn: Set[str] = set()
        self.lamps = [(node.light, scene.get_pose(node)) for node in scene._parents if node.light is not None]
        self.camera_pose = scene.get_pose(scene.main_camera_node)  # type: ignore[arg-type]
        self.made = self.geometry()
        self.picture = self.draw(self.made, self.channels()) if self.made["nodes"] else None

    def draw(self, made: Dict[str, Any], channels: List[str]) -> Picture:
        scene = {"view": self.view(), **self.style(), **made}
        return make(scene, channels, self.size, self.parts, {}).draw(shared(), None)

    def channels(self) -> List[str]:
        if self.flags & RenderFlags.DEPTH_ONLY:
            return ["depth"]
        return ["depth", "instanceId" if self.is_seg else "color"]

    def view(self) -> Dict[str, Any]:
        camera = self.scene.main_camera_node.camera  # type: ignore[union-attr]
        matrix = camera.get_projection_matrix(*self.size)
        return {"cameraToWorld": self.camera_pose.tolist(), "projectionMatrix": matrix.tolist()}

    def background(self) -> List[float]:
        color: List[float] = np.clip(self.scene.bg_color, 0, 1).astype(np.float64).tolist()
        return color if self.flags & RenderFlags.RGBA else color[:3]

    def ambient(self) -> Any:
        return np.asarray(self.scene.ambient_light, np.float64).clip(0, 1)

    def style(self) -> Dict[str, Any]:
        if self.is_data:
            return {"shading": "unlit"}
        made: Dict[str, Any] = {"background": self.background(), "samples": 4}
        if self.is_flat:
            return {"shading": "unlit", **made}
        lights, ambient = [self.light(*lamp) for lamp in self.lamps], self.ambient().tolist()
        return {"shading": "pbr", "lights": lights, "ambient": ambient, "toneMapping": "none", **made}

    def light(self, light: Any, pose: Any) -> Dict[str, Any]:
        made: Dict[str, Any] = {"color": light.color.tolist(), "intensity": light.intensity / np.pi}
        if isinstance(light, (PointLight, SpotLight)):
            made.update(type="point", position=pose[:3, 3].tolist())
        if isinstance(light, SpotLight):
            outer = min(max(light.outerConeAngle, 1e-3), np.pi / 2)
            inner = min(light.innerConeAngle, 0.999 * outer)
            made.update(type="spot", innerConeAngle=inner, outerConeAngle=outer)
            made["shadows"] = bool(self.flags & RenderFlags.SHADOWS_SPOT)
        if isinstance(light, DirectionalLight):
            made.update(type="directional", shadows=bool(self.flags & RenderFlags.SHADOWS_DIRECTIONAL))
        if not isinstance(light, PointLight):
            made["direction"] = (-pose[:3, 2]).tolist()
        return made

    # ---- geometry ----

    def drawn(self) -> Iterator[Tuple[Node, Primitive]]:
        """Yields nodes and primitives in the order of adding: visible ones; with SEG, those with a colour."""
        for node in self.scene._parents:
            if node.mesh is not None and node.mesh.is_visible and (not self.is_seg or node in self.colors):
                for primitive in node.mesh.primitives:
                    if len(primitive.items()[1]):
                        yield node, primitive

    def geometry(self) -> Dict[str, Any]:
        meshes: Dict[Any, Dict[str, Any]] = {}
        materials: Dict[str, Dict[str, Any]] = {}
        nodes: List[Dict[str, Any]] = []
        for node, primitive in self.drawn():
            pose = self.scene.get_pose(node)
            for instance in [np.eye(4)] if primitive.poses is None else primitive.poses:
                matrix = pose @ instance
                is_lit_line = self.is_lit_line(primitive)
                key = (id(primitive), matrix.tobytes() if is_lit_line else b"")
                if key not in meshes:
                    name = f"{len(meshes)}"
                    colors = self.lit(primitive, matrix) if is_lit_line else None
                    meshes[key] = self.mesh(name, primitive)
                    if self.has_material(primitive):
                        materials[name] = self.material(name, primitive, colors)
                        meshes[key].update(self.vertices(materials[name], primitive, colors))
                nodes.append({"mesh": meshes[key]["name"], "matrix": matrix.tolist()})
                self.owners.append(node)
        return {"meshes": list(meshes.values()), "materials": list(materials.values()), "nodes": nodes}

    def is_wire(self, primitive: Primitive) -> bool:
        """True if faces are drawn as their edges. Depth and ids alone have filled faces, as in pyrender."""
        is_flipped = bool(self.flags & RenderFlags.FLIP_WIREFRAME)
        is_chosen = primitive.material.wireframe != is_flipped or bool(self.flags & RenderFlags.ALL_WIREFRAME)
        return not self.is_data and is_chosen

    def is_lit_line(self, primitive: Primitive) -> bool:
        is_line = primitive.items()[0] != "faces" or self.is_wire(primitive)
        return is_line and not self.is_data and not self.is_flat

    def lit(self, primitive: Primitive, matrix: Any) -> Any:
        return lit_colors(primitive, matrix, self.lamps, self.ambient(), self.camera_pose[:3, 3])

    def has_material(self, primitive: Primitive) -> bool:
        """True for colours, and where MASK may cut."""
        return not self.is_data or primitive.material.alphaMode == "MASK"

    def material(self, name: str, primitive: Primitive, colors: Any) -> Dict[str, Any]:
        """Returns a material of a scene, and puts its textures into the parts. colors: of lit lines."""
        material = primitive.material
        if colors is not None:
            return {"name": name, "alphaMode": material.alphaMode, **self.cutoff(material)}
        color, texture = material.base()
        metallic, roughness = material.surface()
        lit = srgb(color * [*[1 - 0.04 * (1 - metallic)] * 3, 1])  # in pyrender, plastics reflect 4 % less diffuse light
        made: Dict[str, Any] = {"name": name, "alphaMode": self.alpha_mode(primitive), **self.cutoff(material)}
        made["baseColorFactor"] = (color if self.is_flat or self.is_data else lit).tolist()
        self.put_texture(made, primitive, "baseColorTexture", texture)
        if self.is_flat or self.is_data:
            return made
        made["metallicFactor"] = metallic
        made["roughnessFactor"] = max(roughness, LEAST_ROUGHNESS)
        if material.emissiveFactor.any():  # squared, as in pyrender
            made["emissiveFactor"] = np.square(material.emissiveFactor, dtype=np.float64).tolist()
        for key in _TEXTURES:
            self.put_texture(made, primitive, key, getattr(material, key, None))
        if getattr(material, "specularGlossinessTexture", None) is not None:
            self.undrawn.add("specularGlossinessTexture")
        return made

    def alpha_mode(self, primitive: Primitive) -> str:
        is_opaque = primitive.material.alphaMode == "BLEND" and not primitive.is_transparent
        return "OPAQUE" if is_opaque else primitive.material.alphaMode

    @staticmethod
    def cutoff(material: Any) -> Dict[str, float]:
        return {"alphaCutoff": material.alphaCutoff} if material.alphaMode == "MASK" else {}

    def put_texture(self, made: Dict[str, Any], primitive: Primitive, key: str, texture: Any) -> None:
        if texture is None or texture.source is None or primitive.items()[0] != "faces":
            return
        if primitive.texcoord_0 is None:
            raise ValueError("a material with a texture needs texcoord_0")
        name = f"texture{id(texture)}"
        if name not in self.parts:
            self.parts[name] = texture.png()
        sampler = {name: getattr(texture.sampler, name) for name in ("magFilter", "minFilter", "wrapS", "wrapT")}
        made[key] = {"asset": name, "sampler": {name: value for name, value in sampler.items() if value is not None}}

    def mesh(self, name: str, primitive: Primitive) -> Dict[str, Any]:
        kind, items = primitive.items()
        made: Dict[str, Any] = {"name": name, "positions": primitive.positions, kind: items}
        if kind == "points":
            made["pointSize"] = min(max(self.point_size, 1.0), 64.0)
        if kind == "faces":
            if self.is_wire(primitive):
                made.update(fill=False, outline=True)
            is_two_sided = primitive.material.doubleSided or bool(self.flags & RenderFlags.SKIP_CULL_FACES)
            made["doubleSided"] = not self.is_data and is_two_sided  # depth and ids alone have fronts only, as in pyrender
        return made

    def vertices(self, material: Dict[str, Any], primitive: Primitive, colors: Any) -> Dict[str, Any]:
        """Returns the material, colours, normals and texture coordinates of a mesh. colors: of lit lines."""
        made: Dict[str, Any] = {"material": material["name"]}
        is_plain, is_filled = self.is_flat or self.is_data, primitive.items()[0] == "faces"
        if colors is not None:
            return {**made, "colors": colors}
        if primitive.normals is not None and is_filled and not is_plain:
            made["normals"] = primitive.normals
        if primitive.color_0 is not None:
            made["colors"] = primitive.color_0 if is_plain else srgb(primitive.color_0).astype(np.float32)
        if any(key.endswith("Texture") for key in material):
            made["texcoords"] = np.stack([primitive.texcoord_0[:, 0], 1 - primitive.texcoord_0[:, 1]], axis=1)
        return made

    # ---- results ----

    def depth(self) -> Any:
        """Blended surfaces have a depth, as in pyrender."""
        if self.picture is None:
            return np.zeros(self.size[::-1], np.float32)
        materials = self.made["materials"]
        if any(material["alphaMode"] == "BLEND" for material in materials):
            opaque = [{**one, "alphaMode": "OPAQUE"} if one["alphaMode"] == "BLEND" else one for one in materials]
            depth = self.draw({**self.made, "materials": opaque}, ["depth"])["depth"]
        else:
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
        """Returns RGBA if the flags ask for it. Colours are in front of the background's, whatever its alpha, as in pyrender."""
        if color.shape[2] == 4:
            alpha = color[:, :, 3:] / 255.0
            behind = np.array(self.background()[:3]) * 255
            color[:, :, :3] = np.rint(color[:, :, :3] * alpha + behind * (1 - alpha))
        elif self.flags & RenderFlags.RGBA:
            return np.dstack([color, np.full(color.shape[:2], 255, np.uint8)])
        return color
