/* isa.h - base: instruction sets of kernels, and their availability on this machine.
 *
 * A kernel is one source file, *_kernel.c, written with base/simd/simd.h. The Makefile compiles it once for each instruction
 * set of the target; all of them give the same bytes. A team (base/team.h) selects one when it is created.
 */
#ifndef ZR_ISA_H
#define ZR_ISA_H

#include <stdbool.h>
#include <stddef.h>

/* Instruction sets of the target: identifier and word of each. */
#if defined __x86_64__
#define ZR_EACH_ISA(entry, name)                                                                                       \
    entry(SCALAR, scalar, name) entry(SSE2, sse2, name) entry(AVX2, avx2, name) entry(AVX512, avx512, name)
#elif defined __aarch64__
#define ZR_EACH_ISA(entry, name) entry(SCALAR, scalar, name) entry(NEON, neon, name)
#elif defined __wasm_simd128__ /* which loads nowhere else: plain C is another module */
#define ZR_EACH_ISA(entry, name) entry(WASM, wasm, name)
#else
#define ZR_EACH_ISA(entry, name) entry(SCALAR, scalar, name)
#endif

enum zr_isa {
    ZR_ISA_SCALAR, /* plain C, for any machine */
    ZR_ISA_SSE2,
    ZR_ISA_AVX2,   /* and BMI2 */
    ZR_ISA_AVX512, /* F, BW, DQ and VL, and BMI2 */
    ZR_ISA_NEON,
    ZR_ISA_WASM, /* SIMD128 */
    ZR_ISA_COUNT
};

/* ZR_KERNEL_TABLE(type, name), in the header of a kernel, on one line, declares the kernel for each instruction set, as
 * name_avx2 and so on. It also defines their lookup, `type *name_of(enum zr_isa isa)`; isa must be available. `type` is
 * the type of a function, or `const struct x` of functions. The kernel's source file defines ZR_KERNEL(name)
 * (base/simd/simd.h). The Makefile defines zr_isa_built for each instruction set. If it does not build one, it defines the
 * kernels of that one as zero bytes. */
#define ZR_KERNEL_TABLE(type, name)                                                                                    \
    typedef type name##_kernel;                                                                                        \
    ZR_EACH_ISA(ZR_KERNEL_DECLARATION, name)                                                                           \
    static inline name##_kernel *name##_of(enum zr_isa isa)                                                            \
    {                                                                                                                  \
        static name##_kernel *const table[ZR_ISA_COUNT] = {ZR_EACH_ISA(ZR_KERNEL_ENTRY, name)};                        \
        return table[isa];                                                                                             \
    }
#define ZR_KERNEL_DECLARATION(upper, lower, name) extern name##_kernel name##_##lower;
#define ZR_KERNEL_ENTRY(upper, lower, name)       [ZR_ISA_##upper] = &name##_##lower,

/* Returns "scalar", "sse2", "avx2", "avx512", "neon" or "wasm". */
const char *zr_isa_name(enum zr_isa isa);

/* Finds an instruction set by name. False if none has that name. */
bool zr_isa_find(const char *name, enum zr_isa *isa);

/* True if kernels are compiled for it, and the processor and the system support it. */
bool zr_isa_is_available(enum zr_isa isa);

/* Returns the available instruction set with the widest vectors. */
enum zr_isa zr_isa_best(void);

/* Finds an available instruction set by name; "auto" is the best one. False if there is none; *isa is then undefined. */
bool zr_isa_choose(const char *name, enum zr_isa *isa);

/* Sets the upper halves of the vector registers to 0. libisal leaves other values there. Until they are 0 again, SSE
 * instructions wait for one another and take up to three times as long. This affects kernels for SSE2 and all code
 * outside of kernels. Does nothing on processors without AVX. */
void zr_isa_clear_upper_halves(void);

/* Writes the names that zr_isa_choose accepts, such as "auto, scalar, sse2", cut at `size`. */
void zr_isa_list(char *out, size_t size);

#endif
