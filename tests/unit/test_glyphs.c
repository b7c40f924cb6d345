/* overlay/glyphs.c and overlay/canvas.c: text of dots, and boxes. */
#include "overlay/glyphs.h"

#include <string.h>

#include "support/cmocka_all.h"

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

static void assert_box(struct zr_box got, int32_t x, int32_t y, int32_t width, int32_t height)
{
    if (got.x != x || got.y != y || got.width != width || got.height != height)
        fail_msg("%d %d, %d x %d; not %d %d, %d x %d", got.x, got.y, got.width, got.height, x, y, width, height);
}

static void texts_are_as_wide_and_as_high_as_is_told(void **state)
{
    (void)state;
    for (int scale = 1; scale <= 5; scale++) {
        clear();
        zr_glyphs_draw(&canvas, "H0H", 3, 4, scale, 0, ink);
        assert_int_equal(zr_glyphs_width("H0H"), 17);
        assert_box(drawn(), 3, 4, 17 * scale, ZR_GLYPH_CAPITAL_ROWS * scale);
        zr_glyphs_draw(&canvas, "H0H", 3, 4, scale, 1, ink);
        assert_box(drawn(), 2, 3, 17 * scale + 2, ZR_GLYPH_CAPITAL_ROWS * scale + 2);
    }
    assert_int_equal(zr_glyphs_width(""), 0);
    assert_int_equal(zr_glyphs_width("."), 1);
    assert_int_equal(zr_glyphs_width("0.5"), 5 + 1 + 1 + 1 + 5);
    assert_int_equal(zr_glyphs_width("11"), zr_glyphs_width("00")); /* digits stand in columns */
}

static void each_character_has_a_glyph_of_its_own(void **state)
{
    (void)state;
    enum { CHARACTERS = 95, DOTS = 9 * 5 };
    static uint32_t seen[CHARACTERS][DOTS];
    for (int i = 0; i < CHARACTERS; i++) {
        const char text[] = {(char)(' ' + i), '\0'};
        clear();
        zr_glyphs_draw(&canvas, text, 0, 0, 1, 0, ink);
        const struct zr_box box = drawn();
        assert_true(zr_glyphs_has_all(text));
        assert_true(box.x + box.width <= zr_glyphs_width(text) && zr_glyphs_width(text) <= 5);
        assert_true(box.y + box.height <= ZR_GLYPH_ROWS);
        assert_true((box.width == 0) == (i == 0));
        for (int k = 0; k < DOTS; k++)
            seen[i][k] = pixels[k / 5 * SIDE + k % 5];
        for (int other = 0; other < i; other++) /* the same by intention: capital o, and the dots of ' ` , */
            if (memcmp(seen[i], seen[other], sizeof seen[i]) == 0 && strchr("O|lI", ' ' + i) == NULL)
                fail_msg("'%c' looks like '%c'", ' ' + i, ' ' + other);
    }
}

static void units_can_be_written_and_what_has_no_glyph_is_a_box(void **state)
{
    (void)state;
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

/* A step of dots becomes a slope, and what it adds stays between the dots. */
static void steps_are_rounded_where_dots_are_large(void **state)
{
    (void)state;
    for (int scale = 2; scale <= 6; scale++) {
        clear();
        zr_glyphs_draw(&canvas, "/", 0, 0, scale, 0, ink);
        assert_box(drawn(), 0, 0, 5 * scale, 7 * scale);
        int count = 0;
        for (int i = 0; i < SIDE * SIDE; i++)
            count += pixels[i] != 0;
        const int legs = (scale + 1) / 2; /* four steps of two corners each */
        assert_int_equal(count, 7 * scale * scale + 4 * 2 * legs * (legs + 1) / 2);
        clear();
        zr_glyphs_draw(&canvas, "L", 0, 0, scale, 0, ink);
        count = 0;
        for (int i = 0; i < SIDE * SIDE; i++)
            count += pixels[i] != 0;
        assert_int_equal(count, 11 * scale * scale); /* a right angle stays one */
    }
}

/* Wherever the text is, pixels outside of the canvas stay as they are. */
static void what_is_outside_of_the_canvas_is_left_out(void **state)
{
    (void)state;
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

static void median_is_the_background_where_that_has_half(void **state)
{
    (void)state;
    const uint32_t grey = 0xFF808080, dark = 0xFF101010;
    const struct zr_box all = {-5, -5, SIDE + 10, SIDE + 10};
    clear();
    assert_int_equal(zr_canvas_median(&canvas, all), 0xFFFFFFFF); /* transparent: as on paper */
    zr_canvas_fill(&canvas, all, grey);
    zr_canvas_fill(&canvas, (struct zr_box){0, 0, SIDE, SIDE / 2 - 1}, dark);
    assert_int_equal(zr_canvas_median(&canvas, all), grey);
    assert_int_equal(zr_canvas_median(&canvas, (struct zr_box){0, 0, SIDE, 20}), dark);
    assert_int_equal(zr_canvas_median(&canvas, (struct zr_box){SIDE, 0, 5, 5}), 0xFFFFFFFF);
}

static double light(int value)
{
    const double c = value / 255.0;
    return c <= 0.04045 ? c / 12.92 : __builtin_pow((c + 0.055) / 1.055, 2.4);
}

static void ink_differs_from_any_grey_enough_to_be_read(void **state)
{
    (void)state;
    for (uint32_t grey = 0; grey < 256; grey++) {
        const uint32_t got = zr_canvas_ink(0xFF000000 | grey << 16 | grey << 8 | grey);
        assert_true(got == 0xFF000000 || got == 0xFFFFFFFF);
        const double paper = light((int)grey) + 0.05, mark = (got == 0xFFFFFFFF) + 0.05;
        assert_true((paper > mark ? paper / mark : mark / paper) > 4.5); /* WCAG 2, level AA */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_are_as_wide_and_as_high_as_is_told),
        cmocka_unit_test(each_character_has_a_glyph_of_its_own),
        cmocka_unit_test(units_can_be_written_and_what_has_no_glyph_is_a_box),
        cmocka_unit_test(steps_are_rounded_where_dots_are_large),
        cmocka_unit_test(what_is_outside_of_the_canvas_is_left_out),
        cmocka_unit_test(median_is_the_background_where_that_has_half),
        cmocka_unit_test(ink_differs_from_any_grey_enough_to_be_read),
    };
    return cmocka_run_group_tests_name("glyphs", tests, NULL, NULL);
}
