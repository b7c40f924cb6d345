/* mesh.h - fuzz: the target of a format of bare meshes. Its size chooses how a mesh is drawn. */
#ifndef ZR_FUZZ_MESH_H
#define ZR_FUZZ_MESH_H

#include <string.h>

#include "fuzz/fuzz.h"
#include "render_request.h"

/* `when`: the parameter time, or NULL; with it, the lights of the file are used, and its
 * animations draw frames. */
#define FUZZ_MESH_AT(ID, when)                                                                                         \
    int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)                                                       \
    {                                                                                                                  \
        static const char *const presets[] = {"isometric", "front", "top"}, *const shadings[] = {"gouraud", "flat",    \
                                                                                                 "unlit"};             \
        fuzz_request(&(struct zr_request){.format = ZR_FORMAT_##ID,                                                    \
                                          .bytes = (const char *)data,                                                 \
                                          .size = size,                                                                \
                                          .width = "48",                                                               \
                                          .height = "32",                                                              \
                                          .time = (when),                                                              \
                                          .fileLights = (when) ? "1" : NULL,                                           \
                                          .frames = (when) && memmem(data, size, "animations", 10) ? "2" : NULL,       \
                                          .preset = presets[size % 3],                                                 \
                                          .shading = shadings[size / 3 % 3]});                                         \
        return 0;                                                                                                      \
    }

#define FUZZ_MESH(ID) FUZZ_MESH_AT(ID, NULL)

#endif
