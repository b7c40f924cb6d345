/* overlay/glyphs.c and overlay/canvas.c: text of dots, and boxes. */
#include "overlay/glyphs.h"

#include <string.h>

#include "support/tests.h"

enum { SIDE = 160 };
static uint32_t pixels[SIDE * SIDE];
static const struct zr_canvas canvas = {pixels, SIDE, SIDE};
static const uint32_t ink = 0xFF0000FF;

static void clear(void)
{
    memset(pixels, 0, sizeof pixels);
}

/* The smallest box of what is drawn; nothing is 0 by 0. */
static struct zr_box drawn(void)
{
    struct zr_box box = {0, 0, 0, 0};
    for (int32_t y = 0; y < SIDE; y++)
        for (int32_t x = 0; x < SIDE; x++) {
            if (pixels[y * SIDE + x] == 0) continue;
            const struct zr_box pixel = {x, y, 1, 1};
            box = box.width == 0 ? pixel : zr_box_join(box, pixel);
        }
    return box;
}

TEST(units_can_be_written_and_what_has_no_glyph_is_a_box)
{
    assert_true(zr_glyphs_has_all("T, °C ± 2 µm·s⁻¹ × m² m³ −1 ΔΩÅλρσ"));
    static const char *const without[] = {"∂", "日本", "😀", "\x80", "\xC3", "\xF0\x9F", "a\tb"};
    for (size_t i = 0; i < sizeof without / sizeof without[0]; i++) {
        assert_false(zr_glyphs_has_all(without[i]));
        clear();
        zr_glyphs_draw(&canvas, without[i], 0, 0, 1, 0, ink);
        assert_true(drawn().width > 0 && drawn().width <= zr_glyphs_width(without[i]));
    }
    assert_int_equal(zr_glyphs_width("∂"), 5);
    assert_int_equal(zr_glyphs_width("日本"), 11);
}

/* Wherever the text is, pixels outside of the canvas stay as they are. */
TEST(what_is_outside_of_the_canvas_is_left_out)
{
    enum { INSIDE = 10, GUARD = 12 };
    for (int32_t y = -30; y <= 30; y++)
        for (int32_t x = -30; x <= 30; x++) {
            clear();
            const struct zr_canvas small = {pixels + GUARD, INSIDE, INSIDE};
            zr_glyphs_draw(&small, "8g", x, y, 2, 1, ink);
            for (int i = 0; i < GUARD; i++)
                assert_true(pixels[i] == 0 && pixels[GUARD + INSIDE * INSIDE + i] == 0);
        }
}

RUN_TESTS(NULL, NULL)
