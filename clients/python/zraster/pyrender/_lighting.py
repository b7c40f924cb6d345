"""Light on the vertices of wireframes, lines and points, which the renderer draws in the colours of their vertices.

The formulas are those of pyrender's faces: a Cook-Torrance BRDF with Schlick's Fresnel term (Schlick 1994), the distribution of
Trowbridge and Reitz (GGX, Walter et al. 2007) and Smith's shadowing with k = (roughness + 1)^2 / 8 (Karis 2013).
"""
from __future__ import annotations

from typing import Any, Iterable, Tuple

import numpy as np

from .light import DirectionalLight, SpotLight
from .primitive import Primitive

LEAST_ROUGHNESS = DIELECTRIC = 0.04  # of pyrender
LEAST_COSINE = 0.001


def srgb(linear: Any) -> Any:
    """Encodes linear light; alpha, the fourth number, passes."""
    linear = np.clip(np.asarray(linear, np.float64), 0.0, 1.0)
    encoded = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.power(linear, 1 / 2.4) - 0.055)
    if linear.shape[-1] == 4:
        encoded[..., 3] = linear[..., 3]
    return encoded


def _decoded(encoded: Any) -> Any:
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def _unit(vectors: Any) -> Any:
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(lengths > 0, lengths, 1)


def _dot(a: Any, b: Any) -> Any:
    return (a * b).sum(axis=-1, keepdims=True)


def _texels(texture: Any, texcoords: Any) -> Any:
    """Returns the nearest texels, (n, 3) or (n, 4) in 0..1, of a repeated image."""
    image = texture.rgb()
    height, width = image.shape[:2]
    columns = np.floor(texcoords[:, 0] % 1 * width).astype(int) % width
    rows = np.floor((1 - texcoords[:, 1]) % 1 * height).astype(int) % height
    return image[rows, columns] / 255.0


def _base_colors(primitive: Primitive) -> Any:
    """Returns (n, 4) base colours in linear light, without the colours of vertices."""
    factor, texture = primitive.material.base()
    colors = np.tile(factor.astype(np.float64), (len(primitive.positions), 1))
    if texture is not None and texture.source is not None and primitive.texcoord_0 is not None:
        texels = _texels(texture, primitive.texcoord_0)
        colors[:, :3] *= _decoded(texels[:, :3])
        colors[:, 3:] *= texels[:, 3:] if texels.shape[1] == 4 else 1
    return colors


def _incoming(light: Any, pose: Any, points: Any) -> Tuple[Any, Any]:
    """Returns unit vectors to the light, and its radiance at the points."""
    power = light.intensity * light.color.astype(np.float64)
    if isinstance(light, DirectionalLight):
        return np.broadcast_to(_unit(pose[:3, 2]), points.shape), np.broadcast_to(power, points.shape)
    away = pose[:3, 3] - points
    to_light = _unit(away)
    share = 1 / np.maximum(_dot(away, away), 1e-12)
    if isinstance(light, SpotLight):
        inner, outer = np.cos(light.innerConeAngle), np.cos(light.outerConeAngle)
        cosine = np.clip(_dot(to_light, _unit(pose[:3, 2])), 0, 1)
        share = share * np.clip((cosine - outer) / max(0.001, inner - outer), 0, 1) ** 2
    return to_light, share * power


def _reflected(base: Any, surface: Tuple[float, float], normals: Any, to_eye: Any, to_light: Any) -> Any:
    """Returns the BRDF times the cosine, (n, 3)."""
    metallic, roughness = surface[0], max(surface[1], LEAST_ROUGHNESS)
    middle = _unit(to_light + to_eye)
    nl = np.clip(_dot(normals, to_light), LEAST_COSINE, 1)
    nv = np.clip(np.abs(_dot(normals, to_eye)), LEAST_COSINE, 1)
    nh, vh = np.clip(_dot(normals, middle), 0, 1), np.clip(_dot(to_eye, middle), 0, 1)
    grazing = (1 - vh) ** 5
    f0 = DIELECTRIC * (1 - metallic) + base * metallic
    fresnel = f0 + (1 - f0) * grazing
    k, a2 = (roughness + 1) ** 2 / 8, roughness**4
    shadowing = nv / (nv * (1 - k) + k) * nl / (nl * (1 - k) + k)
    spread = a2 / (np.pi * (nh * nh * (a2 - 1) + 1) ** 2)
    plastic = DIELECTRIC + (1 - DIELECTRIC) * grazing  # faces are mixes of a plastic and a metal
    diffuse = (1 - plastic) * base * (1 - DIELECTRIC) * (1 - metallic) / np.pi
    return nl * (diffuse + fresnel * shadowing * spread / (4 * nl * nv + 0.001))


def lit_colors(primitive: Primitive, pose: Any, lights: Iterable[Any], ambient: Any, eye: Any) -> Any:
    """Returns (n, 4) colours of the vertices, encoded as sRGB. Vertices without normals face the eye, as in pyrender.

    lights: pairs of a Light and its pose
    """
    base = _base_colors(primitive)
    points = primitive.positions.astype(np.float64) @ pose[:3, :3].T + pose[:3, 3]
    to_eye = _unit(eye - points)
    normals = to_eye if primitive.normals is None else _unit(primitive.normals @ np.linalg.pinv(pose[:3, :3]))
    color = base[:, :3] * ambient + np.square(primitive.material.emissiveFactor, dtype=np.float64)
    for light, place in lights:
        to_light, radiance = _incoming(light, place, points)
        color += radiance * _reflected(base[:, :3], primitive.material.surface(), normals, to_eye, to_light)
    color = np.hstack([color, base[:, 3:]])
    return srgb(color if primitive.color_0 is None else color * primitive.color_0).astype(np.float32)
