"""Reads and writes 3MF files by the C interface of lib3mf, version 1 (the package lib3mf1).

    mf3.py FOLDER     writes cases: components, transforms, base materials, colours of corners, a texture
"""
import ctypes
import os
import struct
import sys
import zlib

Pointer, Word = ctypes.c_void_p, ctypes.c_uint32
Transform = ctypes.c_float * 12  # 3 rows: linear part and translation
NONE, BASE_MATERIALS, COLOR, TEXTURE = range(4)  # eModelPropertyType


class Lib3mf:
    def __init__(self):
        self.library = ctypes.CDLL("lib3MF.so.1")

    def call(self, name, *arguments):
        if getattr(self.library, "lib3mf_" + name)(*arguments):
            code, text = Word(), ctypes.c_char_p()
            self.library.lib3mf_getlasterror(arguments[0], ctypes.byref(code), ctypes.byref(text))
            raise OSError("%s: %d %s" % (name, code.value, (text.value or b"").decode(errors="replace")))

    def get(self, kind, name, *arguments):
        """Returns the value that a call writes to its last argument."""
        value = kind()
        self.call(name, *arguments, ctypes.byref(value))
        return value if kind is Pointer or issubclass(kind, ctypes.Array) else value.value

    def array(self, kind, width, count, name, *arguments):
        """Returns the rows of an array that a call fills."""
        values = (kind * (width * count))()
        self.call(name, *arguments[:1], values, *arguments[1:])
        return [values[i:i + width] for i in range(0, width * count, width)]


def times(a, b):
    """Returns the transform that applies b, then a."""
    rows = []
    for row in range(3):
        rows += [sum(a[4 * row + k] * b[4 * k + column] for k in range(3)) + (a[4 * row + 3] if column == 3 else 0)
                 for column in range(4)]
    return rows


def placed(transform, point):
    return [sum(transform[4 * row + k] * point[k] for k in range(3)) + transform[4 * row + 3] for row in range(3)]


def colors_of(lib, model, mesh, count):
    """Returns the mean colour of each triangle as r, g, b of 0..255, or None."""
    handler = lib.get(Pointer, "meshobject_createpropertyhandler", mesh)
    default = lib.get(Pointer, "object_createdefaultpropertyhandler", mesh)
    groups, colors, known = (Word * count)(), (ctypes.c_uint8 * (12 * count))(), {}
    indices = (Word * count)()
    lib.call("propertyhandler_getbasematerialarray", handler, groups, indices)
    lib.call("propertyhandler_getcolorarray", handler, colors)

    def base(group, index):
        if (group, index) not in known:
            material = lib.get(Pointer, "model_getbasematerialbyid", model, Word(group))
            rgba = [ctypes.c_uint8() for _ in range(4)]
            lib.call("basematerial_getdisplaycolor", material, Word(index), *map(ctypes.byref, rgba))
            known[group, index] = [value.value for value in rgba[:3]]
        return known[group, index]

    fallback, kind = None, lib.get(Word, "defaultpropertyhandler_getpropertytype", default)
    if kind == BASE_MATERIALS:
        group, index = Word(), Word()
        lib.call("defaultpropertyhandler_getbasematerial", default, ctypes.byref(group), ctypes.byref(index))
        fallback = base(group.value, index.value)
    elif kind == COLOR:
        fallback = lib.get(ctypes.c_uint8 * 4, "defaultpropertyhandler_getcolor", default, Word(0))[:3]
    made = []
    for i in range(count):
        kind = lib.get(Word, "propertyhandler_getpropertytype", handler, Word(i))
        if kind == COLOR:
            made.append([sum(colors[12 * i + k::4][:3]) / 3 for k in range(3)])
        else:
            made.append({BASE_MATERIALS: lambda: base(groups[i], indices[i]), TEXTURE: lambda: [255, 255, 255]}.get(
                kind, lambda: fallback)())
    return made


def meshes_of(lib, model, thing, transform):
    """Yields (vertices in the space of the build, triangles, colours) of an object and its components."""
    number = Word(lib.get(Word, "resource_getresourceid", thing))
    if lib.get(Word, "object_ismeshobject", thing) & 255:
        mesh = lib.get(Pointer, "model_getmeshobjectbyid", model, number)
        vertices, count = (lib.get(Word, "meshobject_get%scount" % what, mesh) for what in ("vertex", "triangle"))
        points = lib.array(ctypes.c_float, 3, vertices, "meshobject_getvertices", mesh, Word(vertices), None)
        corners = lib.array(Word, 3, count, "meshobject_gettriangleindices", mesh, Word(count), None)
        yield [placed(transform, point) for point in points], corners, colors_of(lib, model, mesh, count)
        return
    group = lib.get(Pointer, "model_getcomponentsobjectbyid", model, number)
    for i in range(lib.get(Word, "componentsobject_getcomponentcount", group)):
        component = lib.get(Pointer, "componentsobject_getcomponent", group, Word(i))
        own = lib.get(Transform, "component_gettransform", component)
        part = lib.get(Pointer, "component_getobjectresource", component)
        yield from meshes_of(lib, model, part, times(transform, own))


def area(a, b, c):
    u, v = [x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)]
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return sum(x * x for x in cross) ** 0.5 / 2


def part_of(points, corners, colors):
    """Returns [number of triangles, mean colour by area or None]."""
    if None in colors or not corners:
        return [len(corners), None]
    areas = [area(*(points[i] for i in triangle)) for triangle in corners]
    whole = sum(areas)
    if not whole:
        return [len(corners), None]
    return [len(corners), [sum(a * color[k] for a, color in zip(areas, colors)) / whole for k in range(3)]]


def facts(path):
    """Returns the facts of a file, in the form of three.mjs, and "parts": part_of() for each placed mesh in order."""
    lib = Lib3mf()
    model = lib.get(Pointer, "createmodel")
    try:
        lib.call("reader_readfromfileutf8", lib.get(Pointer, "model_queryreader", model, b"3mf"), path.encode())
        items, parts, used = lib.get(Pointer, "model_getbuilditems", model), [], []
        while lib.get(Word, "builditemiterator_movenext", items) & 255:
            item = lib.get(Pointer, "builditemiterator_getcurrent", items)
            thing = lib.get(Pointer, "builditem_getobjectresource", item)
            for mesh in meshes_of(lib, model, thing, lib.get(Transform, "builditem_getobjecttransform", item)):
                parts.append(part_of(*mesh))
                used += [mesh[0][i] for triangle in mesh[1] for i in triangle]
    finally:
        lib.call("release", model)
    if not used:
        return {"error": "nothing to draw"}
    return {"triangles": sum(part[0] for part in parts), "parts": parts, "colors": 0,
            "min": [min(p[k] for p in used) for k in range(3)], "max": [max(p[k] for p in used) for k in range(3)]}


# ---- cases ----

def add_box(lib, model):
    """Adds a box of 10 x 20 x 30 with outward triangles."""
    mesh = lib.get(Pointer, "model_addmeshobject", model)
    points = [(x, y, z) for z in (0, 30) for y in (0, 20) for x in (0, 10)]
    corners = (0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5)
    vertices = (ctypes.c_float * 24)(*[x for point in points for x in point])
    lib.call("meshobject_setgeometry", mesh, vertices, Word(8), (Word * 36)(*corners), Word(12))
    return [mesh] + [lib.get(Pointer, name, mesh) for name in ("meshobject_createpropertyhandler",
                                                               "object_createdefaultpropertyhandler")]


def transform_of(number):
    """Returns a rotation about z by 90 degrees, an unequal scale and a translation; a mirror image if number is odd."""
    return Transform(0, -1, 0, 40 * number, 2, 0, 0, -7, 0, 0, -0.5 if number & 1 else 0.5, 3)


def write_components(lib, model):
    mesh, _, _ = add_box(lib, model)
    inner, outer = (lib.get(Pointer, "model_addcomponentsobject", model) for _ in range(2))
    for number in range(3):
        lib.get(Pointer, "componentsobject_addcomponent", inner, mesh, transform_of(number))
    lib.get(Pointer, "componentsobject_addcomponent", outer, inner, transform_of(1))
    lib.get(Pointer, "componentsobject_addcomponent", outer, mesh, None)
    lib.get(Pointer, "model_addbuilditem", model, outer, transform_of(2))
    lib.get(Pointer, "model_addbuilditem", model, mesh, None)


def write_base_materials(lib, model):
    group = lib.get(Pointer, "model_addbasematerialgroup", model)
    mesh, handler, default = add_box(lib, model)
    number = lib.get(Word, "basematerial_getresourceid", group)
    for name, rgb in ((b"red", (200, 10, 20)), (b"green", (0, 160, 60)), (b"blue", (30, 40, 255))):
        index = lib.get(Word, "basematerial_addmaterialutf8", group, name, *map(ctypes.c_uint8, rgb))  # alpha: 0
        lib.call("basematerial_setdisplaycolorrgba", group, Word(index), *map(ctypes.c_uint8, rgb + (255,)))
    lib.call("defaultpropertyhandler_setbasematerial", default, Word(number), Word(0))
    for i in range(12):
        lib.call("propertyhandler_setbasematerial", handler, Word(i), Word(number), Word(i // 2 % 3))
    lib.get(Pointer, "model_addbuilditem", model, mesh, None)


def write_colors(lib, model):
    mesh, handler, default = add_box(lib, model)
    colors = (ctypes.c_uint8 * 144)(*[255 if i % 4 == 3 else i * 37 % 256 for i in range(144)])
    lib.call("defaultpropertyhandler_setcolor", default, colors)
    lib.call("propertyhandler_setgradientcolorarray", handler, colors)
    lib.get(Pointer, "model_addbuilditem", model, mesh, transform_of(0))


def png_of(width, height):
    """Returns a PNG with a different colour at each pixel."""
    rows = b"".join(b"\0" + b"".join(bytes((x * 60, y * 60, 200)) for x in range(width)) for y in range(height))
    made = b"\x89PNG\r\n\x1a\n"
    for kind, body in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(rows)),
                       (b"IEND", b"")):
        made += struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    return made


class Texture2d(ctypes.Structure):
    _pack_ = 1
    _fields_ = [("texture", Word), ("u", ctypes.c_float * 3), ("v", ctypes.c_float * 3)]


def write_texture(lib, model):
    kind = b"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dtexture"
    part = lib.get(Pointer, "model_addattachmentutf8", model, b"/3D/Textures/pattern.png", kind)
    png = png_of(4, 4)
    lib.call("attachment_readfrombuffer", part, png, ctypes.c_uint64(len(png)))
    texture = lib.get(Pointer, "model_addtexture2dfromattachment", model, part)
    lib.call("texture2d_setcontenttype", texture, 1)
    number = lib.get(Word, "resource_getresourceid", texture)
    mesh, handler, default = add_box(lib, model)
    lib.call("defaultpropertyhandler_settexture", default, Word(number), *map(ctypes.c_float, (0, 0)))
    for i in range(12):
        lib.call("propertyhandler_settexture", handler, Word(i), ctypes.byref(
            Texture2d(number, (0, 1, 1) if i & 1 else (0, 1, 0), (0, 0, 1) if i & 1 else (0, 1, 1))))
    lib.get(Pointer, "model_addbuilditem", model, mesh, None)


def main(folder):
    os.makedirs(folder, exist_ok=True)
    for write in (write_components, write_base_materials, write_colors, write_texture):
        lib = Lib3mf()
        model = lib.get(Pointer, "createmodel")
        write(lib, model)
        path = os.path.join(folder, write.__name__[len("write_"):] + ".3mf")
        lib.call("writer_writetofileutf8", lib.get(Pointer, "model_querywriter", model, b"3mf"), path.encode())
        lib.call("release", model)


if __name__ == "__main__":
    main(sys.argv[1])
