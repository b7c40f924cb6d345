/* look_kernel.h - support: sRGB and tone mapping (core/look/..._simd.h) on arrays, for each instruction set. */
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

extern const struct look_parts look_parts_scalar, look_parts_sse2, look_parts_avx2, look_parts_avx512, look_parts_neon;

static inline const struct look_parts *look_parts_of(enum zr_isa isa)
{
    static const struct look_parts *const table[ZR_ISA_COUNT] = ZR_KERNELS(&look_parts);
    return table[isa];
}

#endif
