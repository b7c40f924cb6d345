/* Paper of technical drawings: scales, places of the views, texts of scales, holes with notes. */
#include <math.h>

#include "drawing/hole_notes.h"
#include "drawing/page.h"
#include "support/random.h"
#include "support/tests.h"

static struct zr_page_request request_of(double width, double height, double depth)
{
    struct zr_page_request request = {.asked = {0, 1}};
    const double sizes[ZR_PAGE_VIEWS][2] = {
        [ZR_PAGE_FRONT] = {width, height},
        [ZR_PAGE_TOP] = {width, depth},
        [ZR_PAGE_RIGHT] = {depth, height},
        [ZR_PAGE_ISOMETRIC] = {0.71 * (width + depth), 0.82 * height + 0.41 * (width + depth)}};
    memcpy(request.sizes, sizes, sizeof sizes);
    return request;
}

static bool is_inside(struct zr_page_box box, const struct zr_page *page)
{
    return box.x0 >= page->frame.x0 && box.y0 >= page->frame.y0 && box.x1 <= page->frame.x1 && box.y1 <= page->title.y0;
}

static bool overlap(struct zr_page_box a, struct zr_page_box b)
{
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/* One of 1, 2 and 5 times a power of ten, on one side of the colon. */
static bool is_standard(struct zr_page_scale scale)
{
    double n = scale.paper > scale.model ? scale.paper : scale.model;
    if (scale.paper != 1 && scale.model != 1) return false;
    while (n >= 10)
        n /= 10;
    return n == 1 || n == 2 || n == 5;
}

TEST(views_lie_apart_inside_the_frame_at_a_standard_scale)
{
    struct random random = {{RANDOM_STATE_1}};
    for (int round = 0; round < 2000; round++) {
        const struct zr_page page = zr_page_make(round % 2 ? ZR_PAGE_A3 : ZR_PAGE_A4, random_below(&random, 2) == 1);
        double size[3];
        for (int k = 0; k < 3; k++) {
            size[k] = 1 + random_below(&random, 1000);
            for (uint32_t i = random_below(&random, 5); i > 0; i--)
                size[k] /= 10;
        }
        struct zr_page_request request = request_of(size[0], size[1], size[2]);
        struct zr_page_layout layout, larger;
        struct zr_page_scale largest;
        for (int view = 0; view < ZR_PAGE_VIEWS; view++)
            request.notes[view] = random_below(&random, 4);
        request.has_cut_below = random_below(&random, 2) == 1;
        assert_true(zr_page_lay_out(&page, &request, &layout, &largest));
        assert_true(is_standard(layout.scale));
        const double factor = zr_page_factor(layout.scale);
        for (int view = 0; view < ZR_PAGE_VIEWS; view++) {
            const struct zr_page_box box = layout.views[view];
            assert_true(is_inside(box, &page));
            assert_true(fabs(box.x1 - box.x0 - factor * request.sizes[view][0]) < 1e-9);
            assert_true(fabs(box.y1 - box.y0 - factor * request.sizes[view][1]) < 1e-9);
            for (int other = 0; other < view; other++)
                assert_false(overlap(box, layout.views[other]));
        }
        const struct zr_page_box front = layout.views[ZR_PAGE_FRONT], top = layout.views[ZR_PAGE_TOP],
                                 right = layout.views[ZR_PAGE_RIGHT];
        assert_true(fabs(front.x0 - top.x0) < 1e-9 && fabs(front.y0 - right.y0) < 1e-9);
        assert_true(page.is_first_angle ? top.y0 > front.y1 && right.x1 < front.x0
                                        : top.y1 < front.y0 && right.x0 > front.x1);
        /* 2.5 times as large does not fit: the steps are 2 and 2.5. */
        request.asked = (struct zr_page_scale){5 * layout.scale.paper, 2 * layout.scale.model};
        assert_false(zr_page_lay_out(&page, &request, &larger, &largest));
        assert_true(largest.paper == layout.scale.paper && largest.model == layout.scale.model);
    }
}

TEST(a_scale_that_is_asked_for_is_used_if_it_fits)
{
    const struct zr_page page = zr_page_make(ZR_PAGE_A3, false);
    struct zr_page_request request = request_of(40, 20, 10);
    struct zr_page_layout layout;
    struct zr_page_scale largest;
    request.asked = (struct zr_page_scale){2, 3};
    assert_true(zr_page_lay_out(&page, &request, &layout, &largest));
    assert_true(layout.scale.paper == 2 && layout.scale.model == 3);
    request.sizes[ZR_PAGE_FRONT][0] = HUGE_VAL;
    assert_false(zr_page_lay_out(&page, &request, &layout, &largest));
    assert_true(largest.paper == 0);
}

TEST(scales_are_read_and_written)
{
    static const char *const good[] = {"1:1", "1:2", "50:1", "2:3", "999999999:1"},
                             *const bad[] = {"",      "1",    ":",     "1:",   ":1",   "0:1",          "1:0",
                                             "1:2:3", "-1:2", "1.5:1", " 1:2", "1:2 ", "1000000000:1", "a:b"};
    struct zr_page_scale scale;
    char text[ZR_PAGE_SCALE_SIZE];
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        assert_true(zr_page_scale_read(good[i], &scale));
        zr_page_scale_write(scale, text);
        assert_string_equal(text, good[i]);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(zr_page_scale_read(bad[i], &scale));
}

/* A blind hole from above, a bore across, and an oblique one. The top view is cut below the blind hole. */
TEST(each_hole_has_a_note_or_a_reason)
{
    static struct zr_hole_notes notes;
    struct zr_part_hole at[] = {
        {.hole = {.axis = {0, -1, 0}, .diameter = 8, .coverage = 360, .reach = ZR_REACH_BLIND},
         .ends = {{0, 10, 0}, {0, 4, 0}},
         .radius = 4},
        {.hole = {.axis = {0, 0, -1}, .diameter = 5, .coverage = 360}, .ends = {{9, 1, 9}, {9, 1, 0}}, .radius = 2.5},
        {.hole = {.axis = {0.6, 0.8, 0}, .diameter = 3, .coverage = 360},
         .ends = {{5, 0, 0}, {6, 1, 0}},
         .radius = 1.5}};
    const struct zr_part_holes holes = {.count = sizeof at / sizeof *at, .at = at};
    struct zr_placed_views placed = {
        .unit = 1, .sizes = {40, 10, 30}, .has_hidden = true, .cut = ZR_PAGE_TOP, .cut_place = 3};
    for (int view = 0; view < ZR_PAGE_VIEWS; view++)
        placed.views[view].axes = zr_view_axes_of((enum zr_page_view)view, false);
    for (int is_cut = 0; is_cut < 2; is_cut++) {
        placed.is_cut = is_cut;
        zr_hole_notes_list(&placed, &holes, &notes);
        assert_int_equal(notes.count, 2 - is_cut);
        assert_int_equal(notes.unnoted[ZR_NO_NOTE_CUT_AWAY].count, is_cut);
        assert_int_equal(notes.unnoted[ZR_NO_NOTE_OBLIQUE].count, 1);
        assert_int_equal(notes.unnoted[ZR_NO_NOTE_HIDDEN].count, 0);
    }
    assert_true(strstr(notes.unnoted[ZR_NO_NOTE_CUT_AWAY].first, "8"));
    placed.has_hidden = false;
    at[0].hole.axis.y = 1; /* opens downwards */
    placed.is_cut = false;
    zr_hole_notes_list(&placed, &holes, &notes);
    assert_int_equal(notes.unnoted[ZR_NO_NOTE_HIDDEN].count, 1);
}

RUN_TESTS(NULL, NULL)
