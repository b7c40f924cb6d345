/* Colours as four bytes. */
#include <math.h>
#include <string.h>

#include "base/rgba.h"
#include "guarded.h"
#include "support/isas.h"
#include "support/random.h"

static void color_byte_rounds_to_nearest_even_and_clamps(void **state)
{
    (void)state;
    for (int i = 0; i < 256; i++)
        assert_int_equal(zr_rgba_byte((float)i * (1.0f / 255.0f)), i);
    assert_int_equal(zr_rgba_byte(0.5f), 128); /* 127.5 */
    assert_int_equal(zr_rgba_byte(2.0f), 255);
    assert_int_equal(zr_rgba_byte(-1.0f), 0);
    assert_int_equal(zr_rgba_byte(NAN), 0);
    assert_int_equal(zr_rgba_byte(INFINITY), 255);
}

static void bytes_come_back_from_floats(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 256; i++) {
        const uint8_t bytes[4] = {(uint8_t)i, (uint8_t)(255 - i), (uint8_t)(i ^ 77), 255};
        uint32_t rgba;
        memcpy(&rgba, bytes, sizeof rgba);
        assert_int_equal(zr_rgba_make(zr_rgba_floats(rgba)), rgba);
    }
}

static void colors_are_packed_as_one_by_one(void **state)
{
    enum { COLORS = 67 };
    static const float odd[] = {NAN, -NAN, INFINITY, -INFINITY, -1, 0, 1, 2, 0.5f, 1e-40f};
    const enum zr_isa isa = isa_under_test(state);
    struct random random = random_seeded(5);
    zr_vec4 colors[COLORS];
    for (uint32_t count = 0; count <= COLORS; count++) {
        uint32_t got[COLORS];
        for (uint32_t i = 0; i < count; i++) {
            colors[i] = (zr_vec4){(float)random_range(&random, -0.1, 1.1), (float)random_below(&random, 256) / 255.0f,
                                  odd[random_below(&random, sizeof odd / sizeof *odd)], 0.25f};
            got[i] = 0;
        }
        struct guarded in = guarded_copy(colors, count * sizeof *colors);
        zr_rgba_pack_of(isa)((const zr_vec4 *)(const void *)in.bytes, count, got);
        for (uint32_t i = 0; i < count; i++) {
            const zr_vec4 c = colors[i];
            const uint8_t want[4] = {zr_rgba_byte(c.x), zr_rgba_byte(c.y), zr_rgba_byte(c.z), 255};
            assert_memory_equal(&got[i], want, sizeof want);
        }
        guarded_free(&in);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(color_byte_rounds_to_nearest_even_and_clamps),
        cmocka_unit_test(bytes_come_back_from_floats),
        TEST_EACH_ISA(colors_are_packed_as_one_by_one),
    };
    return cmocka_run_group_tests_name("rgba", tests, NULL, NULL);
}
