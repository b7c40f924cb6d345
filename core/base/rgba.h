/* rgba.h - base: colours as four bytes.
 *
 * Exact:  0..1 -> 0..255, rounded to the nearest, ties to even (tests/reference/RULES.md, rule 9). Values outside are
 *         clamped; NaN gives 0. Converting bytes to floats and back keeps them.
 */
#ifndef ZR_RGBA_H
#define ZR_RGBA_H

#include <stddef.h>
#include <stdint.h>

#include "base/isa.h"
#include "base/vec.h"

uint8_t zr_rgba_byte(float value);

/* A word whose bytes in memory are red, green, blue, alpha. */
uint32_t zr_rgba_make(zr_vec4 color);

/* The same with alpha 255. */
uint32_t zr_rgba_opaque(zr_vec4 color);

/* The inverse of zr_rgba_make. */
zr_vec4 zr_rgba_floats(uint32_t rgba);

/* zr_rgba_opaque of `count` colours. A kernel. */
typedef void zr_rgba_pack_fn(const zr_vec4 *colors, size_t count, uint32_t *out);

ZR_KERNEL_TABLE(zr_rgba_pack_fn, zr_rgba_pack)

#endif
