/* mesh_requests.h - requests with model files, in all of the ways that a file is named or sent. */
#ifndef MESH_REQUESTS_H
#define MESH_REQUESTS_H

#include "core.h"
#include "render_request.h"
#include "sheet_files.h"

#define STORED "sha256:aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"

struct part {
    const char *name;
    enum sheet_kind kind;
};

/* Parameters are those of struct zr_request; the window is small. */
struct row {
    const char *name;
    enum zr_format format;
    enum sheet_kind body;
    const char *scene;      /* instead of `body` */
    enum sheet_kind stored; /* the only stored asset, under any hash */
    struct part parts[4];
    const char *look, *azimuth, *channel, *strict, *up, *animation;
    bool fails;
};

#define NODES(x)        "\"nodes\":[{\"mesh\":0,\"translation\":[" #x ",0,0]},{\"mesh\":0,\"translation\":[0,0," #x "]}]"
#define WINDOW          "\"window\":{\"width\":40,\"height\":30}"
#define SCENE(files, x) "{" WINDOW ",\"meshes\":[" files "]," NODES(x) "}"

static const struct row rows[] = {
    {"STL", ZR_FORMAT_STL, .body = STL},
    {"STL, other view", ZR_FORMAT_STL, .body = STL, .azimuth = "70"},
    {"STL, y up, facts", ZR_FORMAT_STL, .body = STL, .up = "y", .channel = "info"},
    {"STL, an asset without use", ZR_FORMAT_STL, .body = STL, .parts = {{"a.bin", BIN}}, .channel = "info"},
    {"STL, that asset with strict", ZR_FORMAT_STL, .body = STL, .parts = {{"a.bin", BIN}}, .strict = "true",
     .fails = true},
    {"STL as OBJ", ZR_FORMAT_OBJ, .body = STL, .fails = true},
    {"PLY", ZR_FORMAT_PLY, .body = PLY, .look = "technical"},
    {"OBJ", ZR_FORMAT_OBJ, .body = OBJ, .look = "textbook"},
    {"OBJ, facts", ZR_FORMAT_OBJ, .body = OBJ, .channel = "info"},
    {"OBJ without its MTL", ZR_FORMAT_OBJ, .body = OBJ_OF_MTL, .channel = "info"},
    {"OBJ with MTL", ZR_FORMAT_OBJ, .body = OBJ_OF_MTL, .parts = {{"sheet.mtl", MTL}}},
    {"OBJ with other MTL", ZR_FORMAT_OBJ, .body = OBJ_OF_MTL, .parts = {{"sheet.mtl", OTHER_MTL}}},
    {"OBJ with MTL of other name", ZR_FORMAT_OBJ, .body = OBJ_OF_MTL, .parts = {{"other.mtl", MTL}}, .channel = "info"},
    {"OBJ with a texture", ZR_FORMAT_OBJ, .body = OBJ_OF_TEXTURE,
     .parts = {{"map.mtl", MTL_OF_MAP}, {"stripes.png", PNG}}},
    {"scene of OBJ with a texture", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"a.obj\"}", 1),
     .parts = {{"a.obj", OBJ_OF_TEXTURE}, {"map.mtl", MTL_OF_MAP}, {"stripes.png", PNG}}},
    {"GLB", ZR_FORMAT_GLB, .body = GLB},
    {"GLB without animation", ZR_FORMAT_GLB, .body = GLB, .animation = "walk", .fails = true},
    {"glTF of a short buffer", ZR_FORMAT_GLTF, .body = GLTF, .fails = true},
    {"glTF without its buffer", ZR_FORMAT_GLTF, .body = GLTF_OF_BIN, .fails = true},
    {"glTF with its buffer", ZR_FORMAT_GLTF, .body = GLTF_OF_BIN, .parts = {{"sheet.bin", BIN}}},
    {"glTF and too much", ZR_FORMAT_GLTF, .body = GLTF_OF_BIN, .parts = {{"sheet.bin", BIN}, {"b", STL}},
     .channel = "info"},
    {"broken glTF", ZR_FORMAT_GLTF, .body = BROKEN, .fails = true},
    {"small OBJ", ZR_FORMAT_OBJ, .body = SMALL},
    {"scene of parts", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"a.stl\"},{\"asset\":\"a.glb\"}", 0),
     .parts = {{"a.stl", STL}, {"a.glb", GLB}}},
    {"scene of parts, moved", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"a.stl\"},{\"asset\":\"a.glb\"}", 0.5),
     .parts = {{"a.stl", STL}, {"a.glb", GLB}}},
    {"scene with another part", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"a.stl\"}", 0.5), .channel = "info",
     .parts = {{"a.stl", STL}, {"b", SMALL}}},
    {"scene of OBJ with MTL", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"x/a.obj\"}", 1), .channel = "info",
     .parts = {{"x/a.obj", OBJ_OF_MTL}, {"x/sheet.mtl", MTL}, {"sheet.mtl", OTHER_MTL}}},
    {"scene of OBJ in another folder", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"y/a.obj\"}", 1),
     .parts = {{"y/a.obj", OBJ_OF_MTL}, {"x/sheet.mtl", MTL}, {"sheet.mtl", OTHER_MTL}}},
    {"scene of glTF", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"a.gltf\"}", 1),
     .parts = {{"a.gltf", GLTF_OF_BIN}, {"sheet.bin", BIN}}},
    {"scene of a file twice", ZR_FORMAT_JSON,
     .scene = SCENE("{\"asset\":\"a\"},{\"asset\":\"a\"},{\"asset\":\"a\"}", 1), .parts = {{"a", PLY}}},
    {"scene of a stored file", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"" STORED "\"}", 1), .stored = GLB},
    {"scene of a stored file, moved", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"" STORED "\"}", 2), .stored = GLB},
    {"scene of a stored file with parts", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"" STORED "\"}", 2),
     .stored = GLB, .parts = {{"b", SMALL}}, .channel = "info"},
    {"scene of a file that is stored no more", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"" STORED "\"}", 1),
     .fails = true},
    {"scene of two names", ZR_FORMAT_JSON,
     .scene = SCENE("{\"asset\":\"" STORED "\",\"uri\":\"data:;base64,AAAA\"}", 1), .stored = GLB, .fails = true},
    {"scene of zeros and a part of many bytes", ZR_FORMAT_JSON,
     .scene = SCENE("{\"asset\":\"a.gltf\"},{\"asset\":\"b.stl\"}", 1), .parts = {{"a.gltf", ZEROS}, {"b.stl", STL}}},
    {"scene of too many zeros", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"a.gltf\"}", 1),
     .parts = {{"a.gltf", ZEROS}}, .fails = true},
    {"scene of a broken file", ZR_FORMAT_JSON, .scene = SCENE("{\"asset\":\"a\"}", 1), .parts = {{"a", BROKEN}},
     .fails = true},
};
enum { ROWS = sizeof rows / sizeof *rows };

#endif
