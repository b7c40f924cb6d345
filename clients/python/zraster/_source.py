"""Sources: files, bytes, scenes and meshes, as bodies of requests."""
from __future__ import annotations

import os
import re
from collections.abc import Mapping as AbstractMapping
from typing import Any, Dict, Optional

from ._arrays import is_array, load_numpy
from ._errors import OptionTypeError
from ._renderer import shared

SPACE = b" \t\r\n"
LOOK_MAX = 64 << 10  # bytes in which formats are detected
_TOKEN = re.compile(rb'"((?:[^"\\]|\\.)*)"(\s*:)?|[{}\[\]]', re.S)
_GLTF_KEYS = (b"asset", b"accessors", b"bufferViews", b"buffers", b"scenes")


class Source:
    """A scene as a dict, or the bytes of a file with its type. One of `scene` and `body` is not None.

    is_mesh: the bytes are a mesh without a scene: parameters apply to it
    is_object: the scene was made of an object with vertices and faces
    """

    def __init__(
        self, scene: Optional[Dict[str, Any]], body: Optional[bytes], type_: Optional[str], is_object: bool = False
    ) -> None:
        self.scene, self.body, self.type, self.is_object = scene, body, type_, is_object
        self.is_mesh = body is not None and not _is_scene(body, type_)

    def without_geometry(self) -> "Source":
        """Returns a source that accepts the same keywords."""
        made = Source(None, None, self.type, self.is_object)
        made.is_mesh = self.is_mesh
        if self.is_object and self.scene:
            made.scene = {"materials": self.scene["materials"]}
        return made


def _is_scene(body: bytes, type_: Optional[str]) -> bool:
    start = body[:4096].lstrip(b"\xef\xbb\xbf" + SPACE)
    for row in shared().tables["formats"]:
        if type_ and (type_ == row["suffix"] or type_ in row["types"].split()):
            return bool(row["isScene"])
    return start[:1] in (b"{", b"[") and not _is_gltf(body)


def _is_gltf(text: bytes) -> bool:
    """True if the root has a key of glTF that is no key of scenes, as the renderer detects it."""
    depth = 0
    for token in _TOKEN.finditer(text, 0, LOOK_MAX):
        if token[0] in (b"{", b"["):
            depth += 1
        elif token[0] in (b"}", b"]"):
            depth -= 1
        elif depth == 1 and token[2] and token[1] in _GLTF_KEYS:
            return True
    return False


def _read_file(path: Any, type_: Optional[str]) -> Source:
    with open(path, "rb") as file:
        body = file.read()
    suffix = os.path.splitext(os.fspath(path))[1].lstrip(".").lower()
    known = [row["suffix"] for row in shared().tables["formats"]]
    return Source(None, body, type_ or (suffix if suffix in known else None))


def _list_of(value: Any) -> Any:
    """Keeps arrays and lists; vectors of others, such as Open3D's, become arrays."""
    if is_array(value) or isinstance(value, (list, tuple)):
        return value
    numpy = load_numpy()

    return numpy.asarray(value)


def _colors_of(mesh: Any) -> Dict[str, Any]:
    visual: Any = getattr(mesh, "visual", None)  # trimesh
    kind = getattr(visual, "kind", None)
    if kind == "vertex":
        return {"colors": visual.vertex_colors}
    if kind == "face":
        return {"faceColors": visual.face_colors}
    colors = getattr(mesh, "vertex_colors", None)  # Open3D
    return {"colors": _list_of(colors)} if colors is not None and len(colors) > 0 else {}


def scene_of_mesh(mesh: Any) -> Dict[str, Any]:
    """Returns the scene of an object with vertices and faces: two-sided and in the look studio, as for files."""
    faces = mesh.faces if hasattr(mesh, "faces") else mesh.triangles
    geometry = {"positions": _list_of(mesh.vertices), "faces": _list_of(faces), **_colors_of(mesh)}
    return {
        "look": "studio",
        "materials": [{"name": "mesh", "doubleSided": True}],
        "meshes": [{"material": "mesh", **geometry}],
    }


def read(source: Any, type_: Optional[str] = None) -> Source:
    """Reads a path, bytes, a dict, or an object with vertices and faces (or triangles)."""
    if isinstance(source, (str, os.PathLike)):
        return _read_file(source, type_)
    if isinstance(source, (bytes, bytearray, memoryview)):
        return Source(None, bytes(source), type_)
    if isinstance(source, AbstractMapping):
        return Source(dict(source), None, None)
    if hasattr(source, "vertices") and (hasattr(source, "faces") or hasattr(source, "triangles")):
        return Source(scene_of_mesh(source), None, None, True)
    raise OptionTypeError(
        f"{type(source).__name__} is no source: give a path, bytes, a dict, or an object with vertices and faces"
    )
