/* json_strict.h - tests: any JSON, gone through by the one strict parser without a look at what it says. */
#ifndef ZR_TESTS_JSON_STRICT_H
#define ZR_TESTS_JSON_STRICT_H

#include "input/json/json.h"

static inline enum zr_status read_strictly(struct zr_arena *arena, const char *bytes, size_t size,
                                           const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_json json = {.arena = arena, .limits = limits, .error = error};
    zr_json_open(&json, bytes, size);
    if (zr_json_skip(&json)) zr_json_end(&json);
    return zr_json_close(&json);
}

#endif
