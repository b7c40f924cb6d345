/* threemf_texts.h - tests: texts of 3MF models, read as packages. */
#ifndef ZR_TESTS_THREEMF_TEXTS_H
#define ZR_TESTS_THREEMF_TEXTS_H

#include <stdlib.h>
#include <string.h>

#include "input_check.h"
#include "support/input/zip_file.h"

#define CORE "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
#define VERTICES                                                                                                       \
    "<vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\" 1.5 \" y=\"0\" z=\"0\"/>"                                 \
    "<vertex x='0' y='+1e0' z='.5'></vertex></vertices>"
#define TRIANGLE "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>"
#define MESH     "<mesh>" VERTICES "<triangles>" TRIANGLE "</triangles></mesh>"

static inline struct reading *read_parts(const struct zip_entry *parts, size_t count, const char *query_up)
{
    size_t size;
    unsigned char *file = zip_3mf(parts, count, &size);
    struct reading *reading =
        read_request((struct zr_request){.format = ZR_FORMAT_UNKNOWN, .look = "textbook", .up = query_up}, file, size,
                     zr_limits_default(), (size_t)1 << 26);
    free(file);
    return reading;
}

static inline struct reading *read_model(const char *model)
{
    const struct zip_entry part = {"3D/3dmodel.model", model, strlen(model), true};
    return read_parts(&part, 1, "y");
}

static inline bool warns(const struct reading *reading, const char *text)
{
    for (uint32_t i = 0; i < reading->scene->warning_count; i++)
        if (strstr(reading->scene->warnings[i], text)) return true;
    return false;
}

#endif
