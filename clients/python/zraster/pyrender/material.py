"""Materials. Factors are linear light."""
from __future__ import annotations

from typing import Any, Optional, Set

import numpy as np

from ._checks import Checked, Convert, between, or_default, text, truth
from .constants import TexFlags
from .texture import Texture
from .utils import format_color_vector, format_texture_source


def _image(channels: str) -> Convert:
    """Returns a function that makes a Texture of the given channels of an array or an image of PIL."""

    def convert(_: Any, value: Any) -> Optional[Texture]:
        if value is None or isinstance(value, Texture):
            return value
        return Texture(source=format_texture_source(value, channels), source_channels=channels)

    return convert


def _color(length: int, default: float) -> Convert:
    return or_default(np.full(length, default), lambda _, value: format_color_vector(value, length))


def _alpha_mode(_: Any, value: Any) -> str:
    if value not in ("OPAQUE", "MASK", "BLEND"):
        raise ValueError(f"invalid alpha mode {value}")
    return str(value)


class Material:
    """Base of materials. smooth has no effect, as in pyrender."""

    name, emissiveFactor = Checked(text), Checked(_color(3, 0.0))
    normalTexture, occlusionTexture, emissiveTexture = Checked(_image("RGB")), Checked(_image("R")), Checked(_image("RGB"))
    alphaMode, alphaCutoff = Checked(_alpha_mode), Checked(between("alphaCutoff", 0, 1))
    doubleSided, smooth, wireframe = Checked(truth("doubleSided")), Checked(truth("smooth")), Checked(truth("wireframe"))
    _FLAGS = {
        "normalTexture": TexFlags.NORMAL,
        "occlusionTexture": TexFlags.OCCLUSION,
        "emissiveTexture": TexFlags.EMISSIVE,
    }

    def __init__(self, name: Optional[str] = None, normalTexture: Any = None, occlusionTexture: Any = None,
                 emissiveTexture: Any = None, emissiveFactor: Any = None, alphaMode: Optional[str] = None,
                 alphaCutoff: Optional[float] = None, doubleSided: bool = False, smooth: bool = True,
                 wireframe: bool = False):  # fmt: skip
        self.name, self.smooth, self.wireframe = name, smooth, wireframe
        self.normalTexture, self.occlusionTexture = normalTexture, occlusionTexture
        self.emissiveTexture, self.emissiveFactor = emissiveTexture, emissiveFactor
        self.alphaMode = "OPAQUE" if alphaMode is None else alphaMode
        self.alphaCutoff = 0.5 if alphaCutoff is None else alphaCutoff
        self.doubleSided = doubleSided

    @property
    def textures(self) -> Set[Texture]:
        given = (getattr(self, name) for name in self._FLAGS)
        return {texture for texture in given if texture is not None}

    @property
    def tex_flags(self) -> int:
        return sum(flag for name, flag in self._FLAGS.items() if getattr(self, name) is not None)

    @property
    def is_transparent(self) -> bool:
        """True if some alpha is below 1 with BLEND, or below alphaCutoff with MASK."""
        cutoff = {"OPAQUE": 0.0, "MASK": self.alphaCutoff, "BLEND": 1.0}[self.alphaMode]
        return self.smallest_alpha() < cutoff

    def smallest_alpha(self) -> float:
        """Returns the smallest product of the alphas of base colour and texture."""
        color, texture = self.base()
        return float(color[3]) * (1.0 if texture is None else texture.smallest_alpha())

    def base(self) -> Any:
        """Returns the base colour and its texture, which may be None."""
        return np.ones(4, np.float32), None

    def surface(self) -> Any:
        """Returns metallic and roughness factors."""
        return 1.0, 1.0


class MetallicRoughnessMaterial(Material):
    """A metal or plastic, as in glTF."""

    baseColorFactor, baseColorTexture = Checked(_color(4, 1.0)), Checked(_image("RGBA"))
    metallicFactor = Checked(or_default(1.0, between("metallicFactor", 0, 1)))
    roughnessFactor = Checked(or_default(1.0, between("roughnessFactor", 0, 1)))
    metallicRoughnessTexture = Checked(_image("GB"))
    _FLAGS = {
        **Material._FLAGS,
        "baseColorTexture": TexFlags.BASE_COLOR,
        "metallicRoughnessTexture": TexFlags.METALLIC_ROUGHNESS,
    }

    def __init__(self, name: Optional[str] = None, normalTexture: Any = None, occlusionTexture: Any = None,
                 emissiveTexture: Any = None, emissiveFactor: Any = None, alphaMode: Optional[str] = None,
                 alphaCutoff: Optional[float] = None, doubleSided: bool = False, smooth: bool = True,
                 wireframe: bool = False, baseColorFactor: Any = None, baseColorTexture: Any = None,
                 metallicFactor: float = 1.0, roughnessFactor: float = 1.0,
                 metallicRoughnessTexture: Any = None):  # fmt: skip
        super().__init__(name, normalTexture, occlusionTexture, emissiveTexture, emissiveFactor, alphaMode, alphaCutoff,
                         doubleSided, smooth, wireframe)  # fmt: skip
        self.baseColorFactor, self.baseColorTexture = baseColorFactor, baseColorTexture
        self.metallicFactor, self.roughnessFactor = metallicFactor, roughnessFactor
        self.metallicRoughnessTexture = metallicRoughnessTexture

    def base(self) -> Any:
        return self.baseColorFactor, self.baseColorTexture

    def surface(self) -> Any:
        return self.metallicFactor, self.roughnessFactor


class SpecularGlossinessMaterial(Material):
    """A material of KHR_materials_pbrSpecularGlossiness. pyrender has no shader for it. zraster draws a plastic with the
    colour `diffuse` and the roughness 1 - glossiness; `specular` has no effect."""

    diffuseFactor, diffuseTexture = Checked(_color(4, 1.0)), Checked(_image("RGBA"))
    specularFactor = Checked(_color(3, 1.0))
    glossinessFactor, specularGlossinessTexture = Checked(between("glossinessFactor", 0, 1)), Checked(_image("RGBA"))
    _FLAGS = {
        **Material._FLAGS,
        "diffuseTexture": TexFlags.DIFFUSE,
        "specularGlossinessTexture": TexFlags.SPECULAR_GLOSSINESS,
    }

    def __init__(self, name: Optional[str] = None, normalTexture: Any = None, occlusionTexture: Any = None,
                 emissiveTexture: Any = None, emissiveFactor: Any = None, alphaMode: Optional[str] = None,
                 alphaCutoff: Optional[float] = None, doubleSided: bool = False, smooth: bool = True,
                 wireframe: bool = False, diffuseFactor: Any = None, diffuseTexture: Any = None,
                 specularFactor: Any = None, glossinessFactor: float = 1.0,
                 specularGlossinessTexture: Any = None):  # fmt: skip
        super().__init__(name, normalTexture, occlusionTexture, emissiveTexture, emissiveFactor, alphaMode, alphaCutoff,
                         doubleSided, smooth, wireframe)  # fmt: skip
        self.diffuseFactor, self.diffuseTexture = diffuseFactor, diffuseTexture
        self.specularFactor, self.glossinessFactor = specularFactor, glossinessFactor
        self.specularGlossinessTexture = specularGlossinessTexture

    def base(self) -> Any:
        return self.diffuseFactor, self.diffuseTexture

    def surface(self) -> Any:
        return 0.0, 1.0 - self.glossinessFactor
