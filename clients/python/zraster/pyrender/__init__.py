"""The interface of pyrender, drawn by zraster: `import zraster.pyrender as pyrender`. The rest of the code stays as it is.

Depth maps are exact at the centres of pixels. Left out:

- Viewer, and the captions that it draws
- shadows of point lights, as in pyrender. SHADOWS_POINT raises NotImplementedError if the scene has point lights
- textures other than baseColorTexture, with a warning
- the lines of VERTEX_NORMALS and FACE_NORMALS, with a warning
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
