/* json_check.h - tests: scenes in JSON, read and refused. */
#ifndef ZR_TESTS_JSON_CHECK_H
#define ZR_TESTS_JSON_CHECK_H

#include "input_check.h"

#define TRIANGLE  "\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]"
#define POSITIONS "\"positions\": [[0,0,0],[1,0,0],[0,1,0],[1,1,0,2]]"
#define POLYGONS  "\"polygons\": [{" TRIANGLE "}]"

/* A scene with a polygon and the members `rest`. */
static inline struct reading *read_rest(const char *rest)
{
    char text[4096];
    snprintf(text, sizeof text, "{" POLYGONS "%s%s}", *rest ? ", " : "", rest);
    return read_text(ZR_FORMAT_JSON, text);
}

static inline void refuses_rest(const char *rest, const char *pointer, const char *detail)
{
    struct reading *reading = read_rest(rest);
    assert_complaint(reading, ZR_BAD_SCENE, pointer, detail);
    reading_free(reading);
}

static inline void refuses_scene(const char *text, const char *pointer, const char *detail)
{
    refuses(ZR_FORMAT_JSON, text, ZR_BAD_SCENE, pointer, detail);
}

static inline struct reading *read_scene(const char *text)
{
    struct reading *reading = read_text(ZR_FORMAT_JSON, text);
    assert_read(reading);
    return reading;
}

#endif
