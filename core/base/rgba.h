/* rgba.h - base: colours as four bytes, as pictures have them.
 *
 * Exact:  0..1 -> 0..255, to the nearest, ties to even, as the reference's rule 9 has it. NaN gives 0. A byte that
 *         becomes a float comes back as it was.
 */
#ifndef ZR_RGBA_H
#define ZR_RGBA_H

#include <stddef.h>
#include <stdint.h>

#include "base/isa.h"
#include "base/vec.h"

uint8_t zr_rgba_byte(float value);

/* Four bytes in memory: red, green, blue, alpha. */
uint32_t zr_rgba_make(zr_vec4 color);

/* The same of an opaque one, whatever its alpha. */
uint32_t zr_rgba_opaque(zr_vec4 color);

zr_vec4 zr_rgba_floats(uint32_t rgba);

/* Opaque ones, many at once. A kernel. */
typedef void zr_rgba_pack_fn(const zr_vec4 *colors, size_t count, uint32_t *out);

zr_rgba_pack_fn zr_rgba_pack_scalar, zr_rgba_pack_sse2, zr_rgba_pack_avx2, zr_rgba_pack_avx512, zr_rgba_pack_neon;

zr_rgba_pack_fn *zr_rgba_pack_of(enum zr_isa isa);

#endif
