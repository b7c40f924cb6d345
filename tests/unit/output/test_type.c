/* overlay/letters.c, type.c, pen.c and canvas.c: letters of strokes, texts of letters, and their pixels. */
#include "overlay/type.h"

#include <math.h>
#include <string.h>

#include "overlay/pen.h"
#include "support/tests.h"

enum { SIDE = 160 };
static uint32_t pixels[SIDE * SIDE];
static const struct zr_canvas canvas = {pixels, SIDE, SIDE};
static const uint32_t ink = 0xFF0000FF, paper = 0xFF00FF00;

static void clear(void)
{
    memset(pixels, 0, sizeof pixels);
}

static void draw(const char *text, double x, double y, double height, double pen, uint32_t color)
{
    zr_type_draw(&canvas, text, (struct zr_type_place){x, y, height, 1, 0}, pen, color);
}

/* ---- letters ---- */

enum { ALL = ZR_LETTER_NONE + ZR_ACCENT_ROWS };

/* Characters that have a row. */
static uint32_t character(int i)
{
    return i < ZR_LETTER_NONE ? zr_letter_rows[i].character : zr_accent_rows[i - ZR_LETTER_NONE].character;
}

TEST(rows_are_sorted)
{
    for (int i = 1; i < ZR_LETTER_ROWS; i++)
        assert_true(zr_letter_rows[i - 1].character < zr_letter_rows[i].character);
}

TEST(letters_are_inside_of_their_boxes)
{
    const double least = 1e-9;
    for (int i = 0; i <= ALL; i++) {
        const struct zr_letter letter = zr_letter_find(i < ALL ? character(i) : 0x2202);
        const double width = zr_letter_width(letter);
        struct zr_letter_path path;
        zr_letter_trace(letter, &path);
        assert_true(i == ALL || zr_letter_is_known(letter));
        assert_true(path.count < ZR_LETTER_LINES);
        for (uint32_t k = 0; k < path.count; k++)
            assert_true(path.ends[k] >= (k ? path.ends[k - 1] : 0) + 2);
        for (uint32_t k = 0; path.count > 0 && k < path.ends[path.count - 1]; k++) {
            const struct zr_point p = path.points[k];
            if (p.x < -least || p.x > width + least || p.y < ZR_LETTER_BOTTOM - least || p.y > ZR_LETTER_TOP + least)
                fail_msg("U+%04X: %g %g", character(i), p.x, p.y);
        }
        if (path.count > 0) assert_true(path.ends[path.count - 1] < ZR_LETTER_POINTS);
    }
}

TEST(no_two_characters_share_their_strokes)
{
    static struct zr_letter_path paths[ALL + 1];
    for (int i = 0; i <= ALL; i++)
        zr_letter_trace(zr_letter_find(i < ALL ? character(i) : 0x2202), &paths[i]);
    for (int i = 0; i <= ALL; i++)
        for (int k = 0; k < i; k++) {
            const uint32_t count = paths[i].count;
            if (count == 0 || count != paths[k].count || memcmp(paths[i].ends, paths[k].ends, count * sizeof(uint32_t)))
                continue;
            if (memcmp(paths[i].points, paths[k].points, paths[i].ends[count - 1] * sizeof *paths[i].points) == 0)
                fail_msg("U+%04X and U+%04X", character(i), character(k));
        }
}

TEST(ascii_and_latin_1_and_units_have_letters)
{
    for (uint32_t c = 0x20; c < 0x100; c++)
        if ((c < 0x7F || c >= 0xA0) && c != 0xAD) assert_true(zr_letter_is_known(zr_letter_find(c)));
    assert_true(zr_type_has_all("T, °C ± 2 µm·s⁻¹ × m² m³ −1 ΔΩÅλρσ ⌀3 ≤ 4 ≥ 2"));
    static const char *const without[] = {"∂", "日本", "😀", "\x80", "\xC3", "\xF0\x9F", "a\tb"};
    for (size_t i = 0; i < sizeof without / sizeof without[0]; i++)
        assert_false(zr_type_has_all(without[i]));
}

/* ---- texts ---- */

static void assert_near(double a, double b)
{
    if (fabs(a - b) > 1e-9) fail_msg("%g %g", a, b);
}

TEST(texts_are_as_wide_as_their_letters)
{
    assert_near(zr_type_width("", 10), 0);
    for (char digit[2] = "0"; *digit <= '9'; ++*digit)
        assert_near(zr_type_width(digit, 10), 6);
    assert_near(zr_type_width("12.5", 10), 3 * 6 + 2 + 3 * 2.4);
    assert_near(zr_type_width("12.5", 15), 1.5 * zr_type_width("12.5", 10));
    assert_near(zr_type_width("∂", 10), 5);
    assert_near(zr_type_width("日本", 10), 5 + 2.4 + 5);
    assert_near(zr_type_width("\xF0\x9F", 10), 5 + 2.4 + 5); /* a box per invalid byte */
    static char long_text[1 << 20];
    memset(long_text, 'm', sizeof long_text - 1);
    assert_true(zr_type_width(long_text, 7) > 1 << 16);
}

TEST(heights_grow_with_the_picture)
{
    static const struct {
        int32_t side;
        double height;
    } known[] = {{1, 7}, {64, 7}, {256, 7}, {480, 11}, {1200, 22}, {1800, 30}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        assert_near(zr_type_height(known[i].side, 5000), known[i].height);
        assert_near(zr_type_height(5000, known[i].side), known[i].height);
    }
    assert_near(zr_type_pen(7), 1);
    assert_near(zr_type_pen(20), 2.4);
}

/* ---- pixels ---- */

static uint32_t digest(void)
{
    uint32_t hash = 2166136261u; /* FNV-1a */
    const uint8_t *bytes = (const uint8_t *)pixels;
    for (size_t i = 0; i < sizeof pixels; i++)
        hash = (hash ^ bytes[i]) * 16777619u;
    return hash;
}

/* The same everywhere. If letters change on purpose, look at them and write the number anew. */
TEST(pixels_are_known)
{
    clear();
    draw("Rø3.2 ±0°", 4.5, 20.5, 7, 1, ink);
    draw("gÅ@8&½", 4.5, 50.5, 11, zr_type_pen(11), 0x80FF8000);
    draw("45 ∂ß", 4.25, 100.75, 30, zr_type_pen(30), ink);
    assert_int_equal(digest(), 0x0ac7df19);
}

/* Text that runs upwards is text that runs to the right, turned. */
TEST(text_can_be_turned)
{
    static uint32_t level[SIDE * SIDE];
    clear();
    draw("R12", 20.5, 60.5, 16, 2, ink);
    memcpy(level, pixels, sizeof level);
    clear();
    zr_type_draw(&canvas, "R12", (struct zr_type_place){60.5, SIDE - 20.5, 16, 0, -1}, 2, ink);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            assert_int_equal(pixels[(SIDE - 1 - x) * SIDE + y], level[y * SIDE + x]);
}

/* A halo has the paper's colour around ink, and nothing else changes. */
TEST(a_halo_is_around_the_ink)
{
    const double height = 20, pen = 2, halo = 3;
    uint32_t inked = 0, papered = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        pixels[i] = 0xFF123456;
    draw("I", 50, 90, height, pen + 2 * halo, paper);
    draw("I", 50, 90, height, pen, ink); /* middle line: x = 51, y = 70 to 90 */
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const uint32_t p = pixels[y * SIDE + x];
            if (p == ink) inked++;
            if (p == paper) papered++;
            if (x < 46 || x > 55 || y < 65 || y > 94) assert_int_equal(p, 0xFF123456);
            if (y >= 70 && y < 90)
                assert_true(p == (x == 50 || x == 51 ? ink : x >= 47 && x < 55 ? paper : 0xFF123456));
        }
    assert_true(inked >= 40 && papered >= 120);
}

/* ---- pens ---- */

static double alpha_sum(void)
{
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        sum += (pixels[i] >> 24) / 255.0;
    return sum;
}

static void stroke(double x0, double y0, double x1, double y1, double width, uint32_t color)
{
    const struct zr_point points[] = {{x0, y0}, {x1, y1}};
    const uint32_t end = 2;
    zr_pen_draw(&canvas, &(struct zr_path){1, &end, points}, width, color);
}

TEST(strokes_cover_their_area)
{
    static const double widths[] = {0.3, 1, 1.15, 2, 4.7}, slopes[] = {0, 0.2, 0.5, 1};
    for (int w = 0; w < 5; w++)
        for (int s = 0; s < 4; s++) {
            const double height = 100 * slopes[s], length = sqrt(1e4 + height * height), width = widths[w];
            clear();
            stroke(30.3, 20.2, 130.3, 20.2 + height, width, ink);
            const double area = length * width + 0.7854 * width * width, sum = alpha_sum();
            if (fabs(sum - area) > 0.01 * area + 0.5) fail_msg("%g %g: %g for %g", width, slopes[s], sum, area);
        }
    clear();
    stroke(30, 40.25, 60, 40.25, 1, ink); /* rows 39 and 40, a quarter and three of them */
    assert_int_equal(pixels[39 * SIDE + 45] >> 24, 64);
    assert_int_equal(pixels[40 * SIDE + 45] >> 24, 191);
    assert_int_equal(pixels[41 * SIDE + 45], 0);
}

TEST(colors_are_blended_by_alpha)
{
    for (int i = 0; i < SIDE * SIDE; i++)
        pixels[i] = 0xFF640000; /* blue 100 */
    stroke(10, 20, 60, 20, 1, 0xFF00C8C8);
    assert_int_equal(pixels[20 * SIDE + 30], 0xFF326464); /* half of both */
    clear();
    stroke(10, 20, 60, 20, 1, 0xFF00C8C8);
    assert_int_equal(pixels[20 * SIDE + 30], 0x8000C8C8); /* over nothing: the colour, half transparent */
    stroke(10, 20.5, 60, 20.5, 3, 0xFF112233);
    assert_int_equal(pixels[20 * SIDE + 30], 0xFF112233);
    stroke(10, 20.5, 60, 20.5, 3, 0x00FFFFFF);
    assert_int_equal(pixels[20 * SIDE + 30], 0xFF112233);
}

/* Wherever a text is, pixels outside of the canvas stay as they are. */
TEST(what_is_outside_of_the_canvas_is_left_out)
{
    enum { INSIDE = 10, GUARD = 12 };
    const struct zr_canvas small = {pixels + GUARD, INSIDE, INSIDE};
    for (int32_t y = -30; y <= 30; y++)
        for (int32_t x = -30; x <= 30; x++) {
            clear();
            zr_type_draw(&small, "8g", (struct zr_type_place){x, y, 14, 1, 0}, 3, ink);
            for (int i = 0; i < GUARD; i++)
                assert_true(pixels[i] == 0 && pixels[GUARD + INSIDE * INSIDE + i] == 0);
        }
    clear();
    stroke(-1e9, 5e8, 1e12, -3e8, 2, ink);
    stroke(-1e300, -1e300, -1e299, 1e300, 2, ink);
    stroke(80, -1e9, 80, 1e9, 2, ink);
    assert_int_equal(pixels[50 * SIDE + 80], ink);
}

RUN_TESTS(NULL, NULL)
