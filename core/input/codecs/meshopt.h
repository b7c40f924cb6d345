/* meshopt.h - input: decodes the compressed buffer views of EXT_meshopt_compression (Khronos, ratified 2022) and of
 * KHR_meshopt_compression, which adds version 1 of the attributes and the filter COLOR.
 *
 * Bounds: decoded bytes are at most 64 times the compressed bytes, 1024 times in version 1. The size is checked before memory is allocated.
 */
#ifndef ZR_MESHOPT_H
#define ZR_MESHOPT_H

#include <stdint.h>

#include "base/cancel.h"
#include "input/text/text.h"

enum zr_meshopt_mode { ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_TRIANGLES, ZR_MESHOPT_INDICES };
enum zr_meshopt_filter {
    ZR_MESHOPT_NONE,
    ZR_MESHOPT_OCTAHEDRAL,
    ZR_MESHOPT_QUATERNION,
    ZR_MESHOPT_EXPONENTIAL,
    ZR_MESHOPT_COLOR
};

/* `count` elements of `stride` bytes. */
struct zr_meshopt {
    int mode, filter;
    uint32_t count, stride;
};

/* Checks the layout against the number and the first of the compressed bytes. False with the reason. */
bool zr_meshopt_check(const struct zr_meshopt *of, const void *bytes, size_t size, struct zr_reason *reason);

/* Decodes a checked layout to count * stride bytes, and applies its filter. False with the reason, or if cancelled. */
bool zr_meshopt_decode(const struct zr_meshopt *of, const void *bytes, size_t size, unsigned char *out,
                       const struct zr_cancel *cancel, struct zr_reason *reason);

/* Applies the filter to decoded elements, in place. */
void zr_meshopt_filter(const struct zr_meshopt *of, unsigned char *elements, uint32_t count);

#endif
