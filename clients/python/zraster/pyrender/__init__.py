"""The interface of pyrender, drawn by zraster: `import zraster.pyrender as pyrender`. The rest of the code stays as it is.

After `zraster.pyrender.install()`, `import pyrender` and `from pyrender.constants import RenderFlags` load this package.
`python3 -m zraster.pyrender SCRIPT.py` runs a script in this way, unchanged.

Depth maps are exact at the centres of pixels. Surfaces with the alphaMode BLEND have a depth, as in pyrender. Differences:

- alphaMode MASK cuts what is below alphaCutoff, in colours, depth and SEG; pyrender draws it
- wireframes, lines and points are lit at their vertices, without shadows; between vertices, colours are interpolated. Their
  textures are read at the vertices
- faces without normals are lit by computed ones; in pyrender, they face the camera
- occlusionTexture darkens ambient light, in pyrender all light
- SpecularGlossinessMaterial, for which pyrender has no shader, is a plastic of the diffuse colour. specularGlossinessTexture
  has no effect, with a warning
- all lights count, in pyrender four of each type

Left out:

- Viewer, and the captions that it draws; platforms, shader_program and font, which belong to OpenGL
- shadows of point lights, as in pyrender. SHADOWS_POINT raises NotImplementedError if the scene has point lights
- the lines of VERTEX_NORMALS and FACE_NORMALS, with a warning
"""
import sys as _sys

from .. import __version__
from . import constants, trackball, utils, version
from .camera import Camera, IntrinsicsCamera, OrthographicCamera, PerspectiveCamera
from .constants import GLTF, RenderFlags, TextAlign
from .light import DirectionalLight, Light, PointLight, SpotLight
from .material import Material, MetallicRoughnessMaterial, SpecularGlossinessMaterial
from .mesh import Mesh
from .node import Node
from .offscreen import OffscreenRenderer
from .primitive import Primitive
from .renderer import Renderer
from .sampler import Sampler
from .scene import Scene
from .texture import Texture
from .trackball import Trackball
from .viewer import Viewer


def install() -> None:
    """Lets `import pyrender`, and imports of its modules, load this package in the whole process."""
    for name, module in list(_sys.modules.items()):
        if (name + ".").startswith(__name__ + "."):
            _sys.modules["pyrender" + name[len(__name__) :]] = module


__all__ = [
    "Camera", "DirectionalLight", "GLTF", "IntrinsicsCamera", "Light", "Material", "Mesh", "MetallicRoughnessMaterial",
    "Node", "OffscreenRenderer", "OrthographicCamera", "PerspectiveCamera", "PointLight", "Primitive", "RenderFlags",
    "Renderer", "Sampler", "Scene", "SpecularGlossinessMaterial", "SpotLight", "TextAlign", "Texture", "Trackball",
    "Viewer", "__version__", "constants", "install", "trackball", "utils", "version",
]  # fmt: skip
