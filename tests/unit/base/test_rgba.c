/* Colours as four bytes. */
#include <math.h>
#include <string.h>

#include "base/rgba.h"
#include "support/random.h"
#include "support/tests.h"
#include "unit/common/guarded.h"

TEST(color_byte_rounds_to_nearest_even_and_clamps)
{
    for (int i = 0; i < 256; i++)
        assert_int_equal(zr_rgba_byte((float)i * (1.0f / 255.0f)), i);
    assert_int_equal(zr_rgba_byte(0.5f), 128); /* 127.5 */
    assert_int_equal(zr_rgba_byte(2.0f), 255);
    assert_int_equal(zr_rgba_byte(-1.0f), 0);
    assert_int_equal(zr_rgba_byte(NAN), 0);
    assert_int_equal(zr_rgba_byte(INFINITY), 255);
}

TEST(bytes_come_back_from_floats)
{
    for (uint32_t i = 0; i < 256; i++) {
        const uint8_t bytes[4] = {(uint8_t)i, (uint8_t)(255 - i), (uint8_t)(i ^ 77), 255};
        uint32_t rgba;
        memcpy(&rgba, bytes, sizeof rgba);
        assert_int_equal(zr_rgba_make(zr_rgba_floats(rgba)), rgba);
    }
}

RUN_TESTS(NULL, NULL)
