/* The operations that kernels are written in: for each instruction set the same as plain C. */
#include <stdio.h>
#include <string.h>

#include "raster/halfspace.h"
#include "support/isas.h"
#include "support/simd_check.h"
#include "support/tests.h"

TEST_EACH_ISA(operations_are_those_of_plain_c_lane_by_lane)
{
    char message[400];
    enum zr_isa isa = isa_under_test(state);
    for (uint64_t seed = 1; seed <= 50; seed++)
        if (!simd_check(isa, seed, message, sizeof message)) fail_msg("%s", message);
}

TEST(best_is_available_and_names_are_found)
{
    enum zr_isa found;
    assert_true(zr_isa_is_available(ZR_ISA_SCALAR));
    assert_true(zr_isa_is_available(zr_isa_best()));
    for (int i = 0; i < ZR_ISA_COUNT; i++) {
        assert_true(zr_isa_find(zr_isa_name((enum zr_isa)i), &found));
        assert_int_equal(found, i);
        if (zr_isa_is_available((enum zr_isa)i)) assert_non_null(zr_halfspace_of((enum zr_isa)i));
    }
    assert_false(zr_isa_find("auto", &found));
    assert_false(zr_isa_find("", &found));
}

/* And no others are listed. */
TEST(those_that_are_available_can_be_chosen)
{
    enum zr_isa chosen;
    char list[128], few[8], want[128] = "auto";
    for (int i = 0; i < ZR_ISA_COUNT; i++) {
        const char *name = zr_isa_name((enum zr_isa)i);
        const bool available = zr_isa_is_available((enum zr_isa)i);
        assert_int_equal(zr_isa_choose(name, &chosen), available);
        if (!available) continue;
        assert_int_equal(chosen, i);
        strcat(strcat(want, ", "), name);
    }
    assert_true(zr_isa_choose("auto", &chosen));
    assert_int_equal(chosen, zr_isa_best());
    assert_false(zr_isa_choose("", &chosen));
    assert_false(zr_isa_choose("scalar ", &chosen));
    zr_isa_list(list, sizeof list);
    assert_string_equal(list, want);
    zr_isa_list(few, sizeof few);
    assert_string_equal(few, "auto, s");
}

RUN_TESTS(NULL, NULL)
