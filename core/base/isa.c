#include "base/isa.h"

#include <stdio.h>
#include <string.h>

static const char *const NAMES[ZR_ISA_COUNT] = {
    [ZR_ISA_SCALAR] = "scalar", [ZR_ISA_SSE2] = "sse2", [ZR_ISA_AVX2] = "avx2",
    [ZR_ISA_AVX512] = "avx512", [ZR_ISA_NEON] = "neon", [ZR_ISA_WASM] = "wasm"};

const char *zr_isa_name(enum zr_isa isa)
{
    return NAMES[isa];
}

bool zr_isa_find(const char *name, enum zr_isa *isa)
{
    for (int i = 0; i < ZR_ISA_COUNT; i++)
        if (strcmp(name, NAMES[i]) == 0) {
            *isa = (enum zr_isa)i;
            return true;
        }
    return false;
}

ZR_KERNEL_TABLE(const bool, zr_isa_built)

static bool is_built(enum zr_isa isa)
{
    const bool *built = zr_isa_built_of(isa);
    return built && *built;
}

bool zr_isa_is_available(enum zr_isa isa)
{
    if (!is_built(isa)) return false;
    if (isa == ZR_ISA_SCALAR) return true;
#if defined __x86_64__
    if (isa == ZR_ISA_SSE2) return true;
    if (isa == ZR_ISA_AVX2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2");
    if (isa == ZR_ISA_AVX512)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("bmi2");
#elif defined __aarch64__
    if (isa == ZR_ISA_NEON) return true;
#elif defined __wasm_simd128__
    if (isa == ZR_ISA_WASM) return true; /* a module with SIMD128 does not load without it */
#endif
    return false;
}

enum zr_isa zr_isa_best(void)
{
    static const enum zr_isa by_width[] = {ZR_ISA_AVX512, ZR_ISA_AVX2, ZR_ISA_NEON, ZR_ISA_WASM, ZR_ISA_SSE2};
    for (unsigned i = 0; i < sizeof by_width / sizeof *by_width; i++)
        if (zr_isa_is_available(by_width[i])) return by_width[i];
    return ZR_ISA_SCALAR;
}

bool zr_isa_choose(const char *name, enum zr_isa *isa)
{
    if (strcmp(name, "auto") != 0) return zr_isa_find(name, isa) && zr_isa_is_available(*isa);
    *isa = zr_isa_best();
    return zr_isa_is_available(*isa);
}

#if defined __x86_64__
__attribute__((target("avx"))) static void clear_upper_halves(void)
{
    __builtin_ia32_vzeroupper();
}

void zr_isa_clear_upper_halves(void)
{
    if (__builtin_cpu_supports("avx")) clear_upper_halves();
}
#else
void zr_isa_clear_upper_halves(void) {}
#endif

void zr_isa_list(char *out, size_t size)
{
    int used = snprintf(out, size, "auto");
    for (int i = 0; i < ZR_ISA_COUNT && (size_t)used < size; i++)
        if (zr_isa_is_available((enum zr_isa)i)) used += snprintf(out + used, size - (size_t)used, ", %s", NAMES[i]);
}
