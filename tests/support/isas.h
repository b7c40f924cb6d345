/* isas.h - support: runs a test once for each instruction set of the target, under separate names.
 *
 *     TEST_EACH_ISA(name) { ... isa_under_test(state) ... }
 *
 * If the machine or the build lacks an instruction set, the test is reported as skipped, not as passed.
 */
#ifndef ZR_TEST_ISAS_H
#define ZR_TEST_ISAS_H

#include <stdio.h>

#include "base/isa.h"
#include "support/tests.h"

static enum zr_isa isas_of_tests[] = {ZR_ISA_SCALAR, ZR_ISA_SSE2, ZR_ISA_AVX2, ZR_ISA_AVX512, ZR_ISA_NEON};

#define TEST_WITH_ISA(f, isa, name)                                                                                    \
    {                                                                                                                  \
#f "_" name, f, NULL, NULL, &isas_of_tests[isa]                                                                \
    }

#if defined __x86_64__
#define TESTS_OF_ISAS(f)                                                                                               \
    TEST_WITH_ISA(f, ZR_ISA_SCALAR, "scalar"), TEST_WITH_ISA(f, ZR_ISA_SSE2, "sse2"),                                  \
        TEST_WITH_ISA(f, ZR_ISA_AVX2, "avx2"), TEST_WITH_ISA(f, ZR_ISA_AVX512, "avx512")
#elif defined __aarch64__
#define TESTS_OF_ISAS(f) TEST_WITH_ISA(f, ZR_ISA_SCALAR, "scalar"), TEST_WITH_ISA(f, ZR_ISA_NEON, "neon")
#else
#define TESTS_OF_ISAS(f) TEST_WITH_ISA(f, ZR_ISA_SCALAR, "scalar")
#endif

#define TEST_EACH_ISA(f)                                                                                               \
    TEST_LISTED(f, const struct CMUnitTest tests[] = {TESTS_OF_ISAS(f)};                                               \
                for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) list_test(__LINE__, tests[i]))

static inline enum zr_isa isa_under_test(void **state)
{
    enum zr_isa isa = *(enum zr_isa *)*state;
    if (!zr_isa_is_available(isa)) {
        fprintf(stderr, "LEFT OUT: machine or build has no %s: whether it gives the same bytes is not known%s\n",
                zr_isa_name(isa), isa == ZR_ISA_AVX512 ? "; `make emulated` can tell" : "");
        skip();
    }
    return isa;
}

#endif
