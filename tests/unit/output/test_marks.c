/* overlay/marks.c, fill.c and output/svg_marks.c: lines, dashes, arrow heads, circles and texts, drawn and as SVG. */
#include "overlay/marks.h"

#include <math.h>
#include <string.h>

#include "output/svg_marks.h"
#include "overlay/fill.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 24)

enum { SIDE = 120 };
static uint32_t pixels[SIDE * SIDE];
static const struct zr_canvas canvas = {pixels, SIDE, SIDE};
static const struct zr_ink ink = {.color = 0xFF0000FF, .width = 2};

static void clear(uint32_t color)
{
    for (int i = 0; i < SIDE * SIDE; i++)
        pixels[i] = color;
}

static double alpha_sum(void)
{
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        sum += (pixels[i] >> 24) / 255.0;
    return sum;
}

static void assert_near(double a, double b, double most)
{
    if (fabs(a - b) > most) fail_msg("%.9g for %.9g", a, b);
}

static void draw(const struct zr_marks *marks, uint32_t paper)
{
    clear(paper);
    assert_int_equal(zr_marks_draw(marks, NULL, &canvas), ZR_OK);
}

/* ---- areas ---- */

TEST(pixels_of_polygons_are_covered_by_their_area)
{
    static const struct zr_point box[] = {{10.25, 20.5}, {14, 20.5}, {14, 23}, {10.25, 23}};
    struct zr_point turned[4];
    for (int i = 0; i < 4; i++)
        turned[i] = box[3 - i];
    for (int k = 0; k < 2; k++) {
        clear(0);
        zr_fill_draw(&canvas, k ? turned : box, 4, ink.color);
        assert_int_equal(pixels[20 * SIDE + 10] >> 24, 96); /* 0.75 * 0.5 */
        assert_int_equal(pixels[21 * SIDE + 10] >> 24, 191);
        assert_int_equal(pixels[20 * SIDE + 12] >> 24, 128);
        assert_int_equal(pixels[22 * SIDE + 13] >> 24, 255);
        assert_int_equal(pixels[22 * SIDE + 14], 0);
        assert_near(alpha_sum(), 3.75 * 2.5, 0.03);
    }
    static const struct zr_point notched[] = {{5.3, 7.1}, {99.9, 30.2}, {60.1, 44.4}, {70.7, 100.3}};
    double area = 0;
    for (int i = 0; i < 4; i++)
        area += notched[i].x * notched[(i + 1) % 4].y - notched[(i + 1) % 4].x * notched[i].y;
    clear(0);
    zr_fill_draw(&canvas, notched, 4, ink.color);
    assert_near(alpha_sum(), area / 2, 0.2);
    clear(0);
    zr_fill_draw(&canvas, notched, 0, ink.color);
    zr_fill_draw(&canvas, notched, 2, ink.color);
    assert_near(alpha_sum(), 0, 0);
}

TEST(polygons_outside_of_the_canvas_are_left_out)
{
    static const struct zr_point all[] = {{-1e6, -1e6}, {1e6, -1e6}, {1e6, 1e6}, {-1e6, 1e6}};
    static const struct zr_point none[] = {{-50, 20}, {-10, 30}, {-20, 60}};
    clear(0);
    zr_fill_draw(&canvas, none, 3, ink.color);
    assert_near(alpha_sum(), 0, 0);
    zr_fill_draw(&canvas, all, 4, ink.color);
    assert_near(alpha_sum(), SIDE * SIDE, 0);
}

/* ---- marks ---- */

TEST_AROUND(shapes_have_their_area, open_arena, close_arena)
{
    struct zr_marks marks = {.arena = &arena};
    zr_marks_add_arrow(&marks, (struct zr_point){90, 60}, 0.6, 0.8, 30, 6, ink);
    draw(&marks, 0);
    assert_near(alpha_sum(), 180, 0.2);
    assert_int_equal(pixels[50 * SIDE + 82], ink.color); /* behind its point */
    assert_int_equal(pixels[66 * SIDE + 95], 0);
    marks.count = 0;
    zr_marks_add_disc(&marks, (struct zr_point){60, 60}, 20.3, ink);
    draw(&marks, 0);
    assert_near(alpha_sum(), 3.14159265 * 20.3 * 20.3, 2);
    marks.count = 0;
    zr_marks_add_ring(&marks, (struct zr_point){60, 60}, 40, ink);
    draw(&marks, 0);
    assert_near(alpha_sum(), 2 * 3.14159265 * 40 * 2, 2);
    assert_int_equal(pixels[60 * SIDE + 60], 0);
    assert_int_equal(pixels[60 * SIDE + 99], ink.color);
    assert_false(marks.has_failed);
}

TEST_AROUND(dashes_follow_their_pattern, open_arena, close_arena)
{
    static const struct zr_point bent[] = {{10, 10}, {50, 10}, {50, 40}};
    static const double pattern[] = {12, 4, 2, 4};
    static const struct zr_point wanted[] = {{10, 10}, {22, 10}, {26, 10}, {28, 10}, {32, 10}, {44, 10}, {48, 10},
                                             {50, 10}, {50, 14}, {50, 26}, {50, 30}, {50, 32}, {50, 36}, {50, 40}};
    static const uint32_t ends[] = {2, 4, 6, 8, 10, 12, 14};
    struct zr_marks marks = {.arena = &arena};
    zr_marks_add_dashes(&marks, bent, 3, pattern, 4, ink);
    const struct zr_path *path = &marks.at[0].path;
    assert_int_equal(path->count, 7);
    assert_memory_equal(path->ends, ends, sizeof ends);
    for (int i = 0; i < 14; i++) {
        assert_near(path->points[i].x, wanted[i].x, 1e-9);
        assert_near(path->points[i].y, wanted[i].y, 1e-9);
    }
    static const double fine[] = {0.001, 0.001}; /* too many: a line */
    zr_marks_add_dashes(&marks, bent, 3, fine, 2, ink);
    assert_int_equal(marks.at[1].path.count, 1);
    assert_int_equal(marks.at[1].path.ends[0], 3);
    for (double length = 0.1; length < 40; length += 0.37) { /* none is empty, and none is lost */
        const struct zr_point line[] = {{0, 0}, {length, 0}};
        zr_marks_add_dashes(&marks, line, 2, pattern, 4, ink);
        const struct zr_path *at = &marks.at[marks.count - 1].path;
        assert_true(at->count > 0);
        for (uint32_t i = 0; i < at->count; i++)
            assert_int_equal(at->ends[i], 2 * (i + 1));
    }
    assert_false(marks.has_failed);
}

TEST_AROUND(halos_are_below_all_ink, open_arena, close_arena)
{
    const uint32_t paper = 0xFF00FF00;
    const struct zr_ink first = {.color = 0xFF0000FF, .width = 2},
                        second = {.color = 0xFF00FFFF, .paper = paper, .width = 2, .halo = 6};
    struct zr_marks marks = {.arena = &arena};
    zr_marks_add_line(&marks, (struct zr_point[]){{10, 60}, {110, 60}}, 2, first);
    zr_marks_add_line(&marks, (struct zr_point[]){{60, 10}, {60, 110}}, 2, second);
    zr_marks_add_area(&marks, (struct zr_point[]){{20, 20}, {30, 20}, {30, 30}, {20, 30}}, 4, second);
    draw(&marks, 0xFFFFFFFF);
    assert_int_equal(pixels[60 * SIDE + 55], first.color); /* over the halo of the second one */
    assert_int_equal(pixels[60 * SIDE + 60], second.color);
    assert_int_equal(pixels[50 * SIDE + 55], paper);
    assert_int_equal(pixels[25 * SIDE + 25], second.color);
    assert_int_equal(pixels[25 * SIDE + 15], paper);
    assert_int_equal(pixels[25 * SIDE + 12], 0xFFFFFFFF);
}

TEST_AROUND(lists_are_cancelled_and_their_arena_may_fail, open_arena, close_arena)
{
    struct zr_marks marks = {.arena = &arena};
    struct zr_cancel cancel = {.raised = true};
    for (int i = 0; i < 1000; i++)
        zr_marks_add_text(&marks, "12.5", (struct zr_type_place){10, 50, 11, 1, 0}, ink);
    assert_int_equal(marks.count, 1000);
    clear(0);
    assert_int_equal(zr_marks_draw(&marks, &cancel, &canvas), ZR_CANCELLED);
    assert_near(alpha_sum(), 0, 0);
    struct zr_arena small;
    zr_arena_init(&small, 1 << 14);
    marks = (struct zr_marks){.arena = &small};
    for (int i = 0; i < 4000; i++)
        zr_marks_add_ring(&marks, (struct zr_point){50, 50}, 10, ink);
    assert_true(marks.has_failed);
    assert_int_equal(zr_marks_draw(&marks, NULL, &canvas), ZR_OK);
    zr_arena_free(&small);
}

/* ---- SVG ---- */

TEST_AROUND(marks_become_paths_with_labels, open_arena, close_arena)
{
    const struct zr_ink thin = {.color = 0x80FF8000, .paper = 0xFFFFFFFF, .width = 0.5, .halo = 1};
    struct zr_marks marks = {.arena = &arena};
    struct zr_buffer out = {.arena = &arena};
    zr_marks_add_line(&marks, (struct zr_point[]){{1, 2}, {3, 4.125}}, 2, thin);
    zr_marks_add_disc(&marks, (struct zr_point){5, 6}, 2, ink);
    zr_marks_add_area(&marks, (struct zr_point[]){{0, 0}, {1, 0}, {0, 1}}, 3, ink);
    zr_marks_add_text(&marks, "1<I", (struct zr_type_place){10, 20, 10, 1, 0}, (struct zr_ink){.color = 0xFF332211});
    zr_svg_print_marks(&out, &marks, 2);
    zr_buffer_add(&out, "", 1);
    assert_string_equal(
        (const char *)out.bytes,
        "<g class=\"halos\" aria-hidden=\"true\">\n"
        "<path d=\"M2.00 4.00L6.00 8.25\" stroke=\"#ffffff\" stroke-width=\"5\"/>\n</g>\n"
        "<g class=\"marks\">\n"
        "<path d=\"M2.00 4.00L6.00 8.25\" stroke=\"#0080ff\" stroke-opacity=\"0.502\" stroke-width=\"1\"/>\n"
        "<path d=\"M10.00 12.00h0\" stroke=\"#ff0000\" stroke-width=\"8\"/>\n"
        "<path d=\"M0.00 0.00L2.00 0.00L0.00 2.00Z\" fill=\"#ff0000\" stroke=\"none\"/>\n"
        "<g role=\"img\" aria-label=\"1&lt;I\">\n"
        "<path d=\"M22.40 24.40L27.20 20.00L27.20 40.00M48.00 24.00L36.80 30.40L48.00 36.80M53.80 40.00L53.80 20.00\" "
        "stroke=\"#112233\" stroke-width=\"2.4\"/>\n</g>\n</g>\n");
}

RUN_TESTS(NULL, NULL)
