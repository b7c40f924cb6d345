"""Textures and materials. Factors are linear light."""
from __future__ import annotations

import struct
import zlib
from typing import Any, Dict, List, Optional

import numpy as np

from .light import format_color_vector


class Sampler:
    """Filters and wraps, as numbers of GLTF."""

    def __init__(self, name: Optional[str] = None, magFilter: Any = None, minFilter: Any = None, wrapS: Any = 10497,
                 wrapT: Any = 10497):  # fmt: skip
        self.name, self.magFilter, self.minFilter, self.wrapS, self.wrapT = name, magFilter, minFilter, wrapS, wrapT


class Texture:
    """An image: (h, w, c) uint8 or float 0..1, or a value that numpy converts to such an array. Row 0 is the top."""

    def __init__(self, name: Optional[str] = None, sampler: Optional[Sampler] = None, source: Any = None,
                 source_channels: Any = None, width: Any = None, height: Any = None, tex_type: Any = None,
                 data_format: Any = None):  # fmt: skip
        self.name, self.sampler, self.source_channels = name, sampler or Sampler(), source_channels or "RGB"
        self.width, self.height, self.tex_type, self.data_format = width, height, tex_type, data_format
        if source is not None and getattr(source, "mode", None) in ("P", "1", "CMYK"):  # of PIL
            source = source.convert("RGBA" if self.source_channels == "RGBA" else "RGB")
        array = None if source is None else np.asarray(source)
        if array is not None and np.issubdtype(array.dtype, np.floating):
            array = array * 255.0
        self.source: Any = None if array is None else array.astype(np.uint8)

    def png(self) -> bytes:
        """Returns the image as a PNG of RGB or RGBA."""
        image = self.source if self.source.ndim == 3 else self.source[:, :, None]
        if image.shape[2] < 3:
            image = np.repeat(image[:, :, :1], 3, axis=2)
        height, width, channels = image.shape
        rows = np.zeros((height, 1 + width * channels), np.uint8)
        rows[:, 1:] = image.reshape(height, -1)

        def chunk(kind: bytes, data: bytes) -> bytes:
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        header = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)
        body = zlib.compress(rows.tobytes(), 1)
        return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def _texture(value: Any) -> Optional[Texture]:
    return value if value is None or isinstance(value, Texture) else Texture(source=value)


class Material:
    """Base of materials. smooth has no effect, as in pyrender."""

    def __init__(self, name: Optional[str] = None, normalTexture: Any = None, occlusionTexture: Any = None,
                 emissiveTexture: Any = None, emissiveFactor: Any = None, alphaMode: Optional[str] = None,
                 alphaCutoff: Optional[float] = None, doubleSided: bool = False, smooth: bool = True,
                 wireframe: bool = False):  # fmt: skip
        self.name, self.smooth, self.wireframe = name, smooth, wireframe
        self.normalTexture, self.occlusionTexture = _texture(normalTexture), _texture(occlusionTexture)
        self.emissiveTexture = _texture(emissiveTexture)
        self.emissiveFactor = format_color_vector(np.zeros(3) if emissiveFactor is None else emissiveFactor, 3)
        self.alphaMode = "OPAQUE" if alphaMode is None else alphaMode
        if self.alphaMode not in ("OPAQUE", "MASK", "BLEND"):
            raise ValueError(f"invalid alpha mode {alphaMode}")
        self.alphaCutoff = 0.5 if alphaCutoff is None else float(alphaCutoff)
        self.doubleSided = bool(doubleSided)


class MetallicRoughnessMaterial(Material):
    """A metal or plastic, as in glTF."""

    def __init__(self, name: Optional[str] = None, normalTexture: Any = None, occlusionTexture: Any = None,
                 emissiveTexture: Any = None, emissiveFactor: Any = None, alphaMode: Optional[str] = None,
                 alphaCutoff: Optional[float] = None, doubleSided: bool = False, smooth: bool = True,
                 wireframe: bool = False, baseColorFactor: Any = None, baseColorTexture: Any = None,
                 metallicFactor: float = 1.0, roughnessFactor: float = 1.0,
                 metallicRoughnessTexture: Any = None):  # fmt: skip
        super().__init__(name, normalTexture, occlusionTexture, emissiveTexture, emissiveFactor, alphaMode, alphaCutoff,
                         doubleSided, smooth, wireframe)  # fmt: skip
        self.baseColorFactor = np.ones(4) if baseColorFactor is None else baseColorFactor
        self.baseColorTexture = _texture(baseColorTexture)
        self.metallicFactor = 1.0 if metallicFactor is None else float(metallicFactor)
        self.roughnessFactor = 1.0 if roughnessFactor is None else float(roughnessFactor)
        self.metallicRoughnessTexture = _texture(metallicRoughnessTexture)

    @property
    def baseColorFactor(self) -> Any:
        return self._base_color

    @baseColorFactor.setter
    def baseColorFactor(self, value: Any) -> None:
        self._base_color = format_color_vector(value, 4)


_UNDRAWN = ("normalTexture", "occlusionTexture", "emissiveTexture", "metallicRoughnessTexture")


def undrawn(material: Any) -> List[str]:
    """Returns the names of a material's textures that are not drawn."""
    return [name for name in _UNDRAWN if getattr(material, name, None) is not None]


def srgb(linear: Any) -> Any:
    """Encodes linear light; alpha, the fourth number, passes."""
    linear = np.clip(np.asarray(linear, np.float64), 0.0, 1.0)
    encoded = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.power(linear, 1 / 2.4) - 0.055)
    if linear.shape[-1] == 4:
        encoded[..., 3] = linear[..., 3]
    return encoded


def scene_material(name: str, material: Any, alpha: float, is_flat: bool, parts: Dict[str, bytes]) -> Dict[str, Any]:
    """Returns a material of a scene. alpha: the smallest of the vertex colours. Puts PNGs into `parts`."""
    color = material.baseColorFactor
    metallic = min(max(material.metallicFactor, 0.0), 1.0)
    lit = srgb(color * [*[1 - 0.04 * (1 - metallic)] * 3, 1])  # in pyrender, plastics reflect 4 % less diffuse light
    made: Dict[str, Any] = {"name": name, "baseColorFactor": (color if is_flat else lit).tolist()}
    texture = material.baseColorTexture
    if texture is not None and texture.source is not None:
        parts[name] = texture.png()
        sampler = {key: getattr(texture.sampler, key) for key in ("magFilter", "minFilter", "wrapS", "wrapT")}
        made["baseColorTexture"] = {"asset": name, "sampler": {k: v for k, v in sampler.items() if v is not None}}
        if texture.source.ndim == 3 and texture.source.shape[2] == 4:
            alpha = min(alpha, float(texture.source[:, :, 3].min()) / 255)
    made["alphaMode"] = "BLEND" if material.alphaMode == "BLEND" and alpha * color[3] < 1 else "OPAQUE"
    if not is_flat:
        made["metallicFactor"] = metallic
        made["roughnessFactor"] = min(max(material.roughnessFactor, 0.04), 1.0)
        if material.emissiveFactor.any():  # squared, as in pyrender
            made["emissiveFactor"] = np.square(material.emissiveFactor, dtype=np.float64).tolist()
    return made
