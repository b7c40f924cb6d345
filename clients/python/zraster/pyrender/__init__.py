"""The interface of pyrender, drawn by zraster: `import zraster.pyrender as pyrender`, and nothing else changes.

Depth maps are exact at the centres of pixels. There is no Viewer and no text. Textures but baseColorTexture are not drawn,
with a warning.
"""
from typing import Any

from .. import __version__
from .camera import Camera, IntrinsicsCamera, OrthographicCamera, PerspectiveCamera
from .constants import GLTF, RenderFlags, TextAlign
from .light import DirectionalLight, Light, PointLight, SpotLight
from .material import Material, MetallicRoughnessMaterial, Sampler, Texture
from .mesh import Mesh, Primitive
from .offscreen import OffscreenRenderer
from .scene import Node, Scene


class Viewer:
    """Raises NotImplementedError."""

    def __init__(self, *_: Any, **__: Any):
        raise NotImplementedError("zraster opens no window: save a picture of OffscreenRenderer instead")


__all__ = [
    "Camera", "DirectionalLight", "GLTF", "IntrinsicsCamera", "Light", "Material", "Mesh", "MetallicRoughnessMaterial",
    "Node", "OffscreenRenderer", "OrthographicCamera", "PerspectiveCamera", "PointLight", "Primitive", "RenderFlags",
    "Sampler", "Scene", "SpotLight", "TextAlign", "Texture", "Viewer", "__version__",
]  # fmt: skip
