/* isa.h - base: instruction sets that kernels are compiled for, and which of them this machine has.
 *
 * A kernel is one source file, *_kernel.c, in terms of base/simd.h; the Makefile compiles it once
 * for each instruction set of the target, and each of these gives the same bytes. Which one runs is
 * chosen when a team is made (base/team.h).
 */
#ifndef ZR_ISA_H
#define ZR_ISA_H

#include <stdbool.h>

enum zr_isa {
    ZR_ISA_SCALAR, /* plain C, for any machine */
    ZR_ISA_SSE2,
    ZR_ISA_AVX2,
    ZR_ISA_AVX512, /* F, BW, DQ and VL */
    ZR_ISA_NEON,
    ZR_ISA_COUNT
};

/* Kernel `name` for each instruction set, indexed by enum zr_isa; NULL where the target has no such. */
#if defined __x86_64__
#define ZR_KERNELS(name)                                                                                               \
    {                                                                                                                  \
        [ZR_ISA_SCALAR] = name##_scalar, [ZR_ISA_SSE2] = name##_sse2, [ZR_ISA_AVX2] = name##_avx2,                     \
        [ZR_ISA_AVX512] = name##_avx512, [ZR_ISA_NEON] = NULL                                                          \
    }
#elif defined __aarch64__
#define ZR_KERNELS(name)                                                                                               \
    {                                                                                                                  \
        [ZR_ISA_SCALAR] = name##_scalar, [ZR_ISA_NEON] = name##_neon                                                   \
    }
#else
#define ZR_KERNELS(name)                                                                                               \
    {                                                                                                                  \
        [ZR_ISA_SCALAR] = name##_scalar, [ZR_ISA_NEON] = NULL                                                          \
    }
#endif

/* "scalar", "sse2", "avx2", "avx512", "neon". */
const char *zr_isa_name(enum zr_isa isa);

/* False where no instruction set has that name. */
bool zr_isa_find(const char *name, enum zr_isa *isa);

/* Compiled in, and the processor and its system have it. */
bool zr_isa_is_available(enum zr_isa isa);

/* The widest that is available. */
enum zr_isa zr_isa_best(void);

#endif
