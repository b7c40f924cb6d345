/* isa.h - base: instruction sets that kernels are compiled for, and which of them this machine has.
 *
 * A kernel is one source file, *_kernel.c, in terms of base/simd.h; the Makefile compiles it once
 * for each instruction set of the target, and each of these gives the same bytes. Which one runs is
 * chosen when a team is made (base/team.h).
 */
#ifndef ZR_ISA_H
#define ZR_ISA_H

#include <stdbool.h>
#include <stddef.h>

enum zr_isa {
    ZR_ISA_SCALAR, /* plain C, for any machine */
    ZR_ISA_SSE2,
    ZR_ISA_AVX2,   /* and BMI2 */
    ZR_ISA_AVX512, /* F, BW, DQ and VL, and BMI2 */
    ZR_ISA_NEON,
    ZR_ISA_COUNT
};

/* Kernel `name` for each instruction set that the Makefile compiles kernels for, indexed by enum zr_isa; else NULL.
 * ZR_EACH_ISA(entry, name), which comes from there, is entry(AVX2, avx2, name) of each. */
#define ZR_KERNEL_ENTRY(upper, lower, name) [ZR_ISA_##upper] = name##_##lower,
#define ZR_KERNELS(name)                                                                                               \
    {                                                                                                                  \
        ZR_EACH_ISA(ZR_KERNEL_ENTRY, name)                                                                             \
    }

/* "scalar", "sse2", "avx2", "avx512", "neon". */
const char *zr_isa_name(enum zr_isa isa);

/* False where no instruction set has that name. */
bool zr_isa_find(const char *name, enum zr_isa *isa);

/* Compiled in, and the processor and its system have it. */
bool zr_isa_is_available(enum zr_isa isa);

/* The widest that is available. */
enum zr_isa zr_isa_best(void);

/* By its name, or the best by "auto". False, and *isa means nothing, where none that is available has that name. */
bool zr_isa_choose(const char *name, enum zr_isa *isa);

/* "auto, scalar, sse2": what zr_isa_choose takes, as far as there is room. */
void zr_isa_list(char *out, size_t size);

#endif
