/* look_kernel.h - support: sRGB (base/simd/srgb_simd.h) and tone mapping (shade/lights/tone_simd.h) on arrays, for each instruction
 * set. */
#ifndef ZR_TEST_LOOK_KERNEL_H
#define ZR_TEST_LOOK_KERNEL_H

#include <stddef.h>

#include "base/isa.h"
#include "shade/lights/lighting.h"

/* `count` is a multiple of 16. */
struct look_parts {
    void (*decode)(const float *encoded, size_t count, float *linear);
    void (*encode)(const float *linear, size_t count, float *encoded);
    void (*tone)(enum zr_tone tone, const float *const in[3], size_t count, float *const out[3]);
};

ZR_KERNEL_TABLE(const struct look_parts, look_parts)

#endif
