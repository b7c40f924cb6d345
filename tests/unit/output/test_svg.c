/* Polylines as SVG: groups, numbers, names, widths. */
#include "output/svg.h"
#include "support/test_arena.h"
#include "unit/common/drawn_models.h"

TEST_ARENA(1 << 24)

static double points[][2] = {{0, 10}, {20.125, 0}, {-0.001, 10}, {4, 5},   {8, 5},
                             {8, 9},  {4, 5},      {1, 1},       {2, 2.5}, {3, 3}};
static struct zr_polyline lines[] = {{.first = 0, .count = 3, .class = ZR_STROKE_OUTLINE},
                                     {.first = 3, .count = 4, .class = ZR_STROKE_INNER},
                                     {.first = 7, .count = 2, .class = ZR_STROKE_HIDDEN},
                                     {.first = 8, .count = 2, .class = ZR_STROKE_OUTLINE}};
static struct zr_polylines polylines = {.count = 4, .point_count = 10, .at = lines, .points = points};
static const uint32_t parts[] = {1, 1, 1, 0};
static const char *const names[] = {"", "a<b>\"&\x01\xc3\xa4\xef\xbf\xbf"};

static struct zr_svg_desc usual(void)
{
    return (struct zr_svg_desc){.lines = &polylines,
                                .parts = parts,
                                .part_count = 2,
                                .part_names = names,
                                .width = 20,
                                .height = 10,
                                .pixel = 1,
                                .unit = "",
                                .widths = {1.5, 1.05, 0.75},
                                .color = {0, 0.5f, 1}};
}

static const char *encode(const struct zr_svg_desc *desc)
{
    struct zr_buffer out = {.arena = &arena};
    assert_true(zr_svg_encode(desc, &out));
    assert_true(zr_buffer_add(&out, "", 1));
    return (const char *)out.bytes;
}

TEST(lines_are_grouped_by_part_and_class)
{
    const struct zr_svg_desc desc = usual();
    assert_string_equal(encode(&desc),
                        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20\" height=\"10\" viewBox=\"0 0 20 "
                        "10\" fill=\"none\" stroke=\"#0080ff\" stroke-linecap=\"round\" "
                        "stroke-linejoin=\"round\">\n"
                        "<g id=\"part-0\">\n<g class=\"outline\" stroke-width=\"1.5\">\n"
                        "<path d=\"M2.00 7.50L3.00 7.00\"/>\n</g>\n</g>\n"
                        "<g id=\"part-1\" data-name=\"a&lt;b>&quot;&amp;?\xc3\xa4?\">\n"
                        "<g class=\"hidden\" stroke-width=\"0.75\" stroke-opacity=\"0.5\" "
                        "stroke-dasharray=\"6 3.75\">\n<path d=\"M1.00 9.00L2.00 7.50\"/>\n</g>\n"
                        "<g class=\"inner\" stroke-width=\"1.05\">\n"
                        "<path d=\"M4.00 5.00L8.00 5.00L8.00 1.00Z\"/>\n</g>\n"
                        "<g class=\"outline\" stroke-width=\"1.5\">\n"
                        "<path d=\"M0.00 0.00L20.12 10.00L0.00 0.00\"/>\n</g>\n</g>\n</svg>\n");
}

TEST(marks_are_above_the_lines)
{
    struct zr_marks marks = {.arena = &arena};
    struct zr_svg_desc desc = usual();
    const char *without = encode(&desc);
    desc.marks = &marks;
    zr_marks_add_text(&marks, "I", (struct zr_type_place){2, 8, 5, 1, 0}, (struct zr_ink){.color = 0xFF000000});
    const char *with = encode(&desc);
    const size_t same = strlen(without) - strlen("</svg>\n");
    assert_memory_equal(with, without, same);
    assert_string_equal(with + same, "<g class=\"halos\" aria-hidden=\"true\">\n</g>\n<g class=\"marks\">\n"
                                     "<g role=\"img\" aria-label=\"I\">\n<path d=\"M2.25 8.00L2.25 3.00\" "
                                     "stroke=\"#000000\" stroke-width=\"1\"/>\n</g>\n</g>\n</svg>\n");
}

TEST(units_decide_about_size_and_decimals)
{
    struct zr_svg_desc desc = usual();
    desc.pixel = 0.25;
    desc.unit = "mm";
    const char *fine = encode(&desc);
    assert_non_null(strstr(fine, "width=\"5mm\" height=\"2.5mm\" viewBox=\"0 0 5 2.5\""));
    assert_non_null(strstr(fine, "M1.000 1.250L2.000 1.250"));
    desc.pixel = 100;
    desc.unit = "";
    assert_non_null(strstr(encode(&desc), "width=\"20\" height=\"10\" viewBox=\"0 0 2000 1000\""));
    assert_non_null(strstr(encode(&desc), "M400 500L800 500"));
}

TEST(pixels_of_any_size_have_their_hundredths)
{
    struct zr_svg_desc desc = usual();
    desc.pixel = 1e-11;
    assert_non_null(strstr(encode(&desc), "M0.0000000000200 0.0000000000750L0.0000000000300 0.0000000000700"));
    desc.pixel = 1e-36;
    assert_non_null(strstr(encode(&desc), "L0.00000000000000000000000000000000000300 0."));
}

TEST(a_drawing_without_lines_is_a_file)
{
    const struct zr_polylines none = {0};
    struct zr_svg_desc desc = usual();
    desc.lines = &none;
    assert_non_null(strstr(encode(&desc), "\">\n</svg>\n"));
}

TEST(a_full_arena_is_told)
{
    static _Alignas(ZR_ARENA_ALIGN) char room[512];
    const struct zr_svg_desc desc = usual();
    struct zr_arena small;
    zr_arena_init_within(&small, room, sizeof room);
    struct zr_buffer out = {.arena = &small};
    assert_false(zr_svg_encode(&desc, &out));
}

TEST(widths_of_iso_are_the_nearest_by_ratio)
{
    assert_true(zr_iso_line_width(0.12) == 0.13 && zr_iso_line_width(0.2) == 0.18 && zr_iso_line_width(0.22) == 0.25);
    assert_true(zr_iso_line_width(0.59) == 0.5 && zr_iso_line_width(0.6) == 0.7 && zr_iso_line_width(2.3) == 2.0);
}

TEST(widths_beyond_the_series_stay)
{
    assert_true(zr_iso_line_width(0.1) == 0.1 && zr_iso_line_width(9.0) == 9.0);
}

TEST(paper_is_a_style)
{
    static const zr_vec3 blue = {0, 0, 1};
    struct zr_svg_desc desc = usual();
    desc.paper = &blue;
    assert_non_null(strstr(encode(&desc), "stroke-linejoin=\"round\" style=\"background:#0000ff\">\n"));
}

RUN_TESTS(open_arena, close_arena)
