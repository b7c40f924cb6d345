"""Flags and numbers of pyrender."""

DEFAULT_Z_NEAR = 0.05  # metres
DEFAULT_Z_FAR = 100.0
DEFAULT_SCENE_SCALE = 2.0
MAX_N_LIGHTS = 4  # lights of a type, of pyrender; zraster draws all
TARGET_OPEN_GL_MAJOR, TARGET_OPEN_GL_MINOR = 4, 1
MIN_OPEN_GL_MAJOR, MIN_OPEN_GL_MINOR = 3, 3
OPEN_GL_MAJOR, OPEN_GL_MINOR = 4, 1  # of earlier versions
FLOAT_SZ = UINT_SZ = 4
SHADOW_TEX_SZ = 2048
TEXT_PADDING = 20


class RenderFlags:
    """Flags of OffscreenRenderer.render, combined by |."""

    NONE = 0
    DEPTH_ONLY = 1
    OFFSCREEN = 2
    FLIP_WIREFRAME = 4
    ALL_WIREFRAME = 8
    ALL_SOLID = 16
    SHADOWS_DIRECTIONAL = 32
    SHADOWS_POINT = 64
    SHADOWS_SPOT = 128
    SHADOWS_ALL = 32 | 64 | 128
    VERTEX_NORMALS = 256
    FACE_NORMALS = 512
    SKIP_CULL_FACES = 1024
    RGBA = 2048
    FLAT = 4096
    SEG = 8192


class TextAlign:
    """Alignments of captions, which only a Viewer draws."""

    (
        CENTER,
        CENTER_LEFT,
        CENTER_RIGHT,
        BOTTOM_LEFT,
        BOTTOM_RIGHT,
        BOTTOM_CENTER,
        TOP_LEFT,
        TOP_RIGHT,
        TOP_CENTER,
    ) = range(9)


class GLTF:
    """Modes of primitives, and filters and wraps of samplers."""

    POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN = range(7)
    NEAREST, LINEAR = 9728, 9729
    NEAREST_MIPMAP_NEAREST, LINEAR_MIPMAP_NEAREST, NEAREST_MIPMAP_LINEAR, LINEAR_MIPMAP_LINEAR = range(9984, 9988)
    CLAMP_TO_EDGE, MIRRORED_REPEAT, REPEAT = 33071, 33648, 10497


class BufFlags:
    """Attributes of a primitive."""

    POSITION = 0
    NORMAL, TANGENT, TEXCOORD_0, TEXCOORD_1, COLOR_0, JOINTS_0, WEIGHTS_0 = (1 << i for i in range(7))


class TexFlags:
    """Textures of a material."""

    NONE = 0
    NORMAL, OCCLUSION, EMISSIVE, BASE_COLOR, METALLIC_ROUGHNESS, DIFFUSE, SPECULAR_GLOSSINESS = (1 << i for i in range(7))


class ProgramFlags:
    """Kinds of shaders."""

    NONE, USE_MATERIAL, VERTEX_NORMALS, FACE_NORMALS = 0, 1, 2, 4
