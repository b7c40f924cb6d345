/* meshopt.h - input: decodes the compressed buffer views of EXT_meshopt_compression (Khronos, ratified 2022).
 *
 * Bounds: decoded bytes are at most 64 times the compressed bytes. The size is checked before memory is allocated.
 */
#ifndef ZR_MESHOPT_H
#define ZR_MESHOPT_H

#include "base/cancel.h"
#include "input/codecs/meshopt_filter.h"
#include "input/text/text.h"

/* Checks the layout against the number of compressed bytes. False with the reason. */
bool zr_meshopt_check(const struct zr_meshopt *of, size_t size, struct zr_reason *reason);

/* Decodes a checked layout to count * stride bytes, and applies its filter. False with the reason, or if cancelled. */
bool zr_meshopt_decode(const struct zr_meshopt *of, const void *bytes, size_t size, unsigned char *out,
                       const struct zr_cancel *cancel, struct zr_reason *reason);

#endif
