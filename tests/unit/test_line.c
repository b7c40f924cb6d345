/* Lines of width 1, outlines, their clipping, and the depth offset.
 *
 * Two textbook ways judge the reference's. They differ by rule. Bresenham's runs between
 * pixel centres and draws both ends. The reference rounds the ends to 1/256 pixel, and
 * leaves out the last pixel, whose diamond the line does not exit; where need be it cuts the line off at
 * that pixel's border, and rounds again there. So between pixel centres only exact ties may fall to
 * the other side; and any line, from wherever to wherever, stays within 1/256 pixel of the
 * ideal one: half of that from rounding the minor coordinate, half from the major one.
 */
#include <math.h>
#include <stdlib.h>

#include "base/mutant.h"
#include "geometry/outline.h"
#include "raster/depth_offset.h"
#include "raster/line.h"
#include "support/cmocka_all.h"
#include "support/random.h"
#include "support/straight.h"

static struct zr_window_vertex at(float x, float y)
{
    return (struct zr_window_vertex){.x = x, .y = y, .oow = 1};
}

/* ---- what a line covers ---- */

enum { WINDOW = 64, LONGEST = 256 };

struct cover {
    int count;
    int32_t x[LONGEST], y[LONGEST];
};

static bool is_covered(const struct zr_line_corners *c, int32_t px, int32_t py)
{
    for (int i = 0; i < 4; i++) {
        int j = (i + 1) % 4;
        int64_t a = c->y[i] - c->y[j], b = c->x[i] - c->x[j];
        int64_t bias = a < 0 || (a == 0 && b > 0) ? 1 : 0;
        if (a * c->x[i] - b * c->y[i] + ZR_SUBPIXELS * (b * py - a * px) + bias <= 0) return false;
    }
    return true;
}

static struct cover cover_of(float x0, float y0, float x1, float y1)
{
    struct cover cover = {0};
    struct zr_line_corners corners;
    struct zr_window_vertex v0 = at(x0, y0), v1 = at(x1, y1);
    if (!zr_line_corners_make(&v0, &v1, 1, &corners)) return cover;
    int32_t box[2][2] = {{corners.x[0], corners.x[0]}, {corners.y[0], corners.y[0]}};
    for (int i = 1; i < 4; i++) {
        box[0][0] = corners.x[i] < box[0][0] ? corners.x[i] : box[0][0];
        box[0][1] = corners.x[i] > box[0][1] ? corners.x[i] : box[0][1];
        box[1][0] = corners.y[i] < box[1][0] ? corners.y[i] : box[1][0];
        box[1][1] = corners.y[i] > box[1][1] ? corners.y[i] : box[1][1];
    }
    for (int32_t y = box[1][0] / ZR_SUBPIXELS - 1; y <= box[1][1] / ZR_SUBPIXELS + 1; y++)
        for (int32_t x = box[0][0] / ZR_SUBPIXELS - 1; x <= box[0][1] / ZR_SUBPIXELS + 1; x++)
            if (is_covered(&corners, x, y)) {
                assert_true(cover.count < LONGEST);
                cover.x[cover.count] = x;
                cover.y[cover.count++] = y;
            }
    return cover;
}

static bool covers(const struct cover *cover, int32_t x, int32_t y)
{
    for (int i = 0; i < cover->count; i++)
        if (cover->x[i] == x && cover->y[i] == y) return true;
    return false;
}

static void line_from_centre_to_centre_has_its_first_pixel_and_not_its_last(void **state)
{
    (void)state;
    struct cover right = cover_of(1.5f, 2.5f, 4.5f, 2.5f), left = cover_of(4.5f, 2.5f, 1.5f, 2.5f);
    struct cover up = cover_of(2.5f, 1.5f, 2.5f, 4.5f), down = cover_of(2.5f, 4.5f, 2.5f, 1.5f);
    assert_int_equal(right.count, 3);
    assert_int_equal(left.count, 3);
    assert_int_equal(up.count, 3);
    assert_int_equal(down.count, 3);
    for (int32_t i = 1; i <= 3; i++) {
        assert_true(covers(&right, i, 2));
        assert_true(covers(&left, i + 1, 2));
        assert_true(covers(&up, 2, i));
        assert_true(covers(&down, 2, i + 1));
    }
}

static void corners_go_round_clockwise_with_the_ends_moved_to_pixel_borders(void **state)
{
    (void)state;
    struct zr_window_vertex v0 = at(1.5f, 2.5f), v1 = at(4.5f, 2.5f);
    struct zr_line_corners c;
    /* x: from the centre 1.5, 256 on the grid, to the centre 4.5, 1024, whose pixel the fill rule leaves out. */
    assert_true(zr_line_corners_make(&v0, &v1, 1, &c));
    const int32_t right_x[4] = {1024, 256, 256, 1024}, right_y[4] = {384, 384, 640, 640};
    assert_memory_equal(c.x, right_x, sizeof right_x);
    assert_memory_equal(c.y, right_y, sizeof right_y);
    /* Back: from the border 5.0, 1152, so that its first pixel is kept, to 2.0, 384. */
    assert_true(zr_line_corners_make(&v1, &v0, 1, &c));
    const int32_t left_x[4] = {1152, 384, 384, 1152};
    assert_memory_equal(c.x, left_x, sizeof left_x);
    assert_memory_equal(c.y, right_y, sizeof right_y);
}

static void ends_are_snapped_half_to_even(void **state)
{
    (void)state;
    /* Minor coordinates of -1.5, 0.5 and 2.5 subpixels from the centre of row 0. */
    struct zr_window_vertex v0 = at(1.25f, 0.5f - 1.5f / 256), v1 = at(9.25f, 0.5f + 0.5f / 256);
    struct zr_line_corners c;
    assert_true(zr_line_corners_make(&v0, &v1, 1, &c));
    assert_int_equal(c.y[1] + 128, -2);
    assert_int_equal(c.y[0] + 128, 0);
    v1.y = 0.5f + 2.5f / 256;
    assert_true(zr_line_corners_make(&v0, &v1, 1, &c));
    assert_int_equal(c.y[0] + 128, 2);
}

static void older_rule_is_not_in_a_build_for_use(void **state)
{
    (void)state;
    assert_false(zr_mutant_set("older_lines", true));
    assert_true(zr_mutant_set("older_lines", false));
}

static void line_that_leaves_no_diamond_is_dropped(void **state)
{
    (void)state;
    struct zr_line_corners c;
    struct zr_window_vertex a = at(2.5f, 2.5f), b = at(2.375f, 2.5f), d = at(2.625f, 2.5f);
    assert_false(zr_line_corners_make(&a, &a, 1, &c));
    assert_int_equal(cover_of(b.x, b.y, d.x, d.y).count, 0);
    assert_int_equal(cover_of(d.x, d.y, b.x, b.y).count, 0);
    /* Half a pixel on, out of the diamond: drawn, though only a pixel's quarter long. */
    assert_int_equal(cover_of(2.75f, 2.5f, 3.0f, 2.5f).count, 1);
    assert_int_equal(cover_of(2.75f, 2.875f, 3.0f, 2.875f).count, 0);
}

static void lines_in_a_chain_share_no_pixel_and_leave_no_gap(void **state)
{
    (void)state;
    struct random r = random_seeded(3);
    for (int i = 0; i < 2000; i++) {
        /* To the right, bent at most once a piece, joints inside of diamonds. */
        float x = 2.5f + (float)random_range(&r, -0.2, 0.2), y = 30.5f + (float)random_range(&r, -0.2, 0.2);
        int seen[WINDOW] = {0};
        float first = x;
        while (x < 50.0f) {
            float nx = floorf(x) + 0.5f + (float)(1 + random_below(&r, 6)) + (float)random_range(&r, -0.2, 0.2);
            float ny = floorf(y) + 0.5f + (float)random_range(&r, -0.2, 0.2);
            struct cover piece = cover_of(x, y, nx, ny);
            for (int k = 0; k < piece.count; k++)
                seen[piece.x[k]]++;
            x = nx;
            y = ny;
        }
        for (int k = (int)floorf(first); k < (int)floorf(x); k++)
            assert_int_equal(seen[k], 1);
        assert_int_equal(seen[(int)floorf(x)], 0);
    }
}

/* ---- planes ---- */

static void plane_runs_along_the_major_axis_from_the_first_value_to_the_second(void **state)
{
    (void)state;
    struct zr_window_vertex v0 = at(0.5f, 0.5f), v1 = at(4.5f, 4.5f), v2 = at(2.5f, 8.5f);
    struct zr_line_basis diagonal = zr_line_basis_make(&v0, &v1), steep = zr_line_basis_make(&v0, &v2);
    struct zr_plane plane = zr_line_plane_make(&diagonal, 0.0f, 1.0f);
    assert_true(plane.a0 == 0.0f && plane.dadx == 0.25f && plane.dady == 0.0f);
    plane = zr_line_plane_make(&steep, 3.0f, 5.0f);
    assert_true(plane.dadx == 0.0f && fabsf(plane.dady - 0.25f) < 1e-6f);
    assert_true(fabsf(zr_plane_at(&plane, 2, 8) - 5.0f) < 1e-5f);
}

/* ---- judged by Bresenham and by the DDA ---- */

/* Between pixel centres, pixel (32, 32) and (32 + dx, 32 + dy). */
static void judge_by_bresenham(int32_t dx, int32_t dy)
{
    struct straight_pixel pixels[LONGEST];
    size_t count = straight_bresenham(32, 32, 32 + dx, 32 + dy, pixels, LONGEST);
    struct cover cover = cover_of(32.5f, 32.5f, 32.5f + (float)dx, 32.5f + (float)dy);
    bool x_major = abs(dx) >= abs(dy);
    assert_int_equal(cover.count, (int)count - 1);
    for (size_t i = 0; i + 1 < count; i++) {
        struct straight_pixel p = pixels[i], other = p;
        if (x_major)
            other.y += dy > 0 ? 1 : -1;
        else
            other.x += dx > 0 ? 1 : -1;
        assert_true(covers(&cover, p.x, p.y) != (p.tie && covers(&cover, other.x, other.y)));
        assert_true(p.tie || covers(&cover, p.x, p.y));
    }
}

static void between_pixel_centres_bresenham_agrees_but_for_the_last_pixel_and_ties(void **state)
{
    (void)state;
    for (int32_t dy = -24; dy <= 24; dy++)
        for (int32_t dx = -24; dx <= 24; dx++)
            judge_by_bresenham(dx, dy);
}

static void ties_go_left_of_steep_lines_and_to_the_upper_left_of_others(void **state)
{
    (void)state;
    /* Slope 1/2: the cut end needs no rounding, so column (or row) 1 is an exact tie. */
    struct cover rising = cover_of(2.5f, 2.5f, 6.5f, 4.5f), falling = cover_of(2.5f, 4.5f, 6.5f, 2.5f);
    struct cover steep = cover_of(2.5f, 2.5f, 4.5f, 6.5f), leaning = cover_of(4.5f, 2.5f, 2.5f, 6.5f);
    assert_true(covers(&rising, 3, 3) && !covers(&rising, 3, 2));
    assert_true(covers(&falling, 3, 3) && !covers(&falling, 3, 4));
    assert_true(covers(&steep, 2, 3) && !covers(&steep, 3, 3));
    assert_true(covers(&leaning, 3, 3) && !covers(&leaning, 4, 3));
}

/* How far the ideal line is from the pixel's centre, along the minor axis. */
static double minor_distance(const double p[4], bool x_major, double slope, int32_t x, int32_t y)
{
    if (x_major) return p[1] + (x + 0.5 - p[0]) * slope - (y + 0.5);
    return p[0] + (y + 0.5 - p[1]) * slope - (x + 0.5);
}

/* In shares of what rounding explains: half a subpixel of the minor coordinate, and half a
 * one of the major times the slope. */
struct judgement {
    double farthest; /* over half a pixel: of a pixel's centre from the ideal line */
    double doubtful; /* of the line from the midpoint of two pixels that the two ways disagreed about */
    uint64_t pixels, at_ends;
};

static void judge_by_dda(const double p[4], struct judgement *judgement)
{
    struct straight_pixel pixels[LONGEST];
    size_t count = straight_dda(p[0], p[1], p[2], p[3], pixels, LONGEST);
    struct cover cover = cover_of((float)p[0], (float)p[1], (float)p[2], (float)p[3]);
    bool x_major = fabs(p[2] - p[0]) >= fabs(p[3] - p[1]);
    double slope = x_major ? (p[3] - p[1]) / (p[2] - p[0]) : (p[2] - p[0]) / (p[3] - p[1]);
    double share = (1.0 + fabs(slope)) / (2 * ZR_SUBPIXELS);
    int seen[WINDOW + 4] = {0}, both = 0;
    for (int i = 0; i < cover.count; i++) {
        int32_t x = cover.x[i], y = cover.y[i];
        double over = (fabs(minor_distance(p, x_major, slope, x, y)) - 0.5) / share;
        judgement->farthest = fmax(judgement->farthest, over);
        assert_int_equal(seen[(x_major ? x : y) + 2]++, 0); /* one a step */
        judgement->pixels++;
        for (size_t k = 0; k < count; k++) {
            if ((x_major ? pixels[k].x : pixels[k].y) != (x_major ? x : y)) continue;
            both++;
            bool agree = pixels[k].x == x && pixels[k].y == y;
            if (!agree) judgement->doubtful = fmax(judgement->doubtful, fabs(over));
        }
    }
    /* Diamonds give or take one pixel at each end. */
    assert_true(cover.count - both <= 2 && (int)count - both <= 2);
    judgement->at_ends += (uint64_t)(cover.count - both) + (uint64_t)((int)count - both);
}

static void any_line_stays_within_a_subpixel_of_the_ideal_one_and_of_the_dda(void **state)
{
    (void)state;
    struct random r = random_seeded(11);
    struct judgement judgement = {0};
    for (int i = 0; i < 100000; i++) {
        double p[4]; /* places that floats hold */
        for (int k = 0; k < 4; k++)
            p[k] = (double)(float)random_range(&r, 4, WINDOW - 4);
        if (i % 2) { /* where both coordinates' rounding adds up: short, and nearly diagonal */
            double step = random_range(&r, -3, 3), lean = random_range(&r, 0.9, 1.1);
            p[2] = (double)(float)(p[0] + step);
            p[3] = (double)(float)(p[1] + (random_below(&r, 2) ? step : -step) * lean);
        }
        judge_by_dda(p, &judgement);
    }
    /* The hundredth is what float rounds off while the ends move. Both bounds are nearly
     * reached: a grid half as fine, or twice, would be noticed. */
    assert_true(judgement.farthest <= 1.01 && judgement.doubtful <= 1.01);
    assert_true(judgement.farthest > 0.85 && judgement.doubtful > 0.85);
    assert_true(judgement.pixels > 200000 && judgement.at_ends > 0);
}

/* ---- clipping ---- */

static bool clip(const zr_vec4 in[2], struct zr_clipped *out)
{
    unsigned outcodes[2] = {zr_clip_outcode(in[0]), zr_clip_outcode(in[1])};
    return zr_clip_line(in, outcodes, out);
}

static void clip_line_inside_is_kept_as_it_is(void **state)
{
    (void)state;
    const zr_vec4 in[2] = {{-0.3f, 0.1f, 0.7f, 1}, {1, -1, 1, 1}};
    struct zr_clipped out;
    assert_true(clip(in, &out));
    for (int i = 0; i < 2; i++)
        assert_memory_equal(&out.vertices[i].position, &in[i], sizeof in[i]);
}

static void clip_line_out_on_both_sides_is_cut_at_both_with_its_attributes(void **state)
{
    (void)state;
    /* d0 = -1, d1 = 3 at x + w: a quarter is cut off; the same at the other end. */
    const zr_vec4 in[2] = {{-2, 0.5f, 0, 1}, {2, 0.5f, 0, 1}};
    struct zr_clipped out;
    assert_true(clip(in, &out));
    assert_true(out.vertices[0].position.x == -1.0f && out.vertices[1].position.x == 1.0f &&
                out.vertices[0].position.y == 0.5f);
    zr_vec4 values[ZR_CLIP_VALUES] = {{-2, 8, 0, 0}, {2, 0, 0, 0}};
    zr_clip_replay(out.made, out.made_count, out.corners, values);
    const zr_vec4 *first = &values[out.vertices[0].id], *last = &values[out.vertices[1].id];
    assert_true(first->x == -1.0f && last->x == 1.0f && first->y == 6.0f && last->y == 2.0f);
}

static void clip_line_takes_the_farthest_cut_of_several_planes_from_its_own_end(void **state)
{
    (void)state;
    /* Out of x = w by 1 of 2 and of y = w by 3 of 4: only the second cut counts. */
    const zr_vec4 in[2] = {{0, 0, 0, 1}, {2, 4, 0, 1}};
    struct zr_clipped out;
    assert_true(clip(in, &out));
    assert_true(out.vertices[0].position.x == 0.0f && out.vertices[1].position.x == 0.5f &&
                out.vertices[1].position.y == 1.0f);
}

static void clip_line_from_behind_the_eye_starts_at_the_near_plane(void **state)
{
    (void)state;
    /* z + w: -3 behind the eye, 1 in front: three quarters are cut off, and w is positive there. */
    const zr_vec4 in[2] = {{0, 0, -2, -1}, {0, 0, -1, 2}};
    struct zr_clipped out;
    assert_true(clip(in, &out));
    assert_true(out.vertices[0].position.z == -1.25f && out.vertices[0].position.w == 1.25f);
    assert_true(out.vertices[1].position.w == 2.0f);
}

static void clip_line_past_a_corner_or_outside_of_one_plane_is_gone(void **state)
{
    (void)state;
    const zr_vec4 past[2] = {{-2, 0.5f, 0, 1}, {0.5f, 3, 0, 1}};
    struct zr_clipped out;
    const zr_vec4 beyond[2] = {{2, 0, 0, 1}, {3, 0, 0, 1}};
    const zr_vec4 nowhere[2] = {{0, 0, 0, 1}, {NAN, 0, 0, 1}};
    const zr_vec4 endless[2] = {{0, 0, 0, 1}, {INFINITY, 0, 0, 1}};
    assert_false(clip(past, &out));
    assert_false(clip(beyond, &out));
    assert_false(clip(nowhere, &out));
    assert_false(clip(endless, &out));
}

/* ---- outlines ---- */

static void clipped_triangle_has_no_edge_along_the_plane(void **state)
{
    (void)state;
    /* Corner 1 lies outside of x = w: 0, then the two cuts, then 2. */
    const zr_vec4 tri[3] = {{0, 0, 0, 1}, {2, 0, 0, 1}, {0, 1, 0, 1}};
    struct zr_clipped out, plain;
    unsigned outcode = zr_clip_outcode(tri[1]), edges = 7, some = 5;
    assert_int_equal(zr_clip_triangle(tri, outcode, &edges, &out), 4);
    assert_int_equal(edges, 0xd); /* 0 to 1, 2 to 3, 3 to 0; not 1 to 2 */
    assert_true(out.vertices[1].position.x == 1.0f && out.vertices[2].position.x == 1.0f);
    assert_int_equal(zr_clip_triangle(tri, outcode, &some, &out), 4);
    assert_int_equal(some, 0x9); /* the edge from 1 to 2 was none, so what is left of it is none */
    assert_int_equal(zr_clip_triangle(tri, outcode, NULL, &plain), 4);
    for (int i = 0; i < 4; i++)
        assert_memory_equal(&out.vertices[i].position, &plain.vertices[i].position, sizeof(zr_vec4));
}

static void assert_lines(const struct zr_outline_line *lines, int count, const uint8_t want[][2], int want_count)
{
    assert_int_equal(count, want_count);
    for (int i = 0; i < count; i++) {
        assert_int_equal(lines[i].from, want[i][0]);
        assert_int_equal(lines[i].to, want[i][1]);
    }
}

static void outline_of_a_whole_triangle_starts_with_its_last_edge(void **state)
{
    (void)state;
    const struct zr_window_vertex v[3] = {at(0, 0), at(4, 0), at(0, 4)};
    struct zr_outline_line lines[ZR_CLIP_MAX];
    int count = zr_outline_make(v, 3, 7, false, ZR_SIDE_BOTH, lines);
    assert_lines(lines, count, (const uint8_t[][2]){{2, 0}, {0, 1}, {1, 2}}, 3);
    count = zr_outline_make(v, 3, 7, true, ZR_SIDE_BOTH, lines);
    assert_lines(lines, count, (const uint8_t[][2]){{0, 1}, {1, 2}, {2, 0}}, 3);
}

static void outline_of_a_clipped_triangle_goes_round_it_without_the_edge_along_the_plane(void **state)
{
    (void)state;
    const struct zr_window_vertex v[4] = {at(0, 0), at(4, 0), at(4, 2), at(0, 4)};
    struct zr_outline_line lines[ZR_CLIP_MAX];
    int count = zr_outline_make(v, 4, 0xd, true, ZR_SIDE_BOTH, lines);
    assert_lines(lines, count, (const uint8_t[][2]){{0, 1}, {2, 3}, {3, 0}}, 3);
}

static void outline_of_a_polygon_leaves_out_the_diagonals_of_its_fan(void **state)
{
    (void)state;
    /* Pieces (1, 2, 0), (2, 3, 0) and (3, 4, 0); bits: its edges 0 to 1, 1 to 2, 2 to 0. */
    assert_int_equal(zr_outline_fan_edges(2, 5), 1 | 4);
    assert_int_equal(zr_outline_fan_edges(3, 5), 1);
    assert_int_equal(zr_outline_fan_edges(4, 5), 1 | 2);
    assert_int_equal(zr_outline_fan_edges(2, 3), 7);
}

static void outline_culls_by_side_and_takes_no_area_for_a_back_with_the_colours_of_the_front(void **state)
{
    (void)state;
    const struct zr_window_vertex front[3] = {at(0, 0), at(4, 0), at(0, 4)}, back[3] = {at(0, 0), at(0, 4), at(4, 0)},
                                  flat[3] = {at(0, 0), at(4, 4), at(2, 2)};
    struct zr_outline_line lines[ZR_CLIP_MAX];
    assert_int_equal(zr_outline_make(front, 3, 7, false, ZR_SIDE_FRONT, lines), 3);
    assert_false(lines[0].back);
    assert_int_equal(zr_outline_make(front, 3, 7, false, ZR_SIDE_BACK, lines), 0);
    assert_int_equal(zr_outline_make(back, 3, 7, false, ZR_SIDE_FRONT, lines), 0);
    assert_int_equal(zr_outline_make(back, 3, 7, false, ZR_SIDE_BACK, lines), 3);
    assert_true(lines[0].back);
    assert_int_equal(zr_outline_make(flat, 3, 7, false, ZR_SIDE_FRONT, lines), 0);
    assert_int_equal(zr_outline_make(flat, 3, 7, false, ZR_SIDE_BACK, lines), 3);
    assert_false(lines[0].back);
}

/* ---- depth offset ---- */

static void depth_offset_is_the_steeper_slope_and_the_step_at_the_farthest_corner(void **state)
{
    (void)state;
    struct zr_window_vertex v0 = at(0, 0), v1 = at(0, 8), v2 = at(16, 0);
    v0.z = v1.z = v2.z = 0.5f;
    assert_true(zr_depth_offset(&v0, &v1, &v2, 1, 1) == 0x1p-24f);
    assert_true(zr_depth_offset(&v0, &v1, &v2, 5, -3) == -0x3p-24f);
    v2.z = 0.75f; /* 1/64 a pixel in x, the same power of two */
    assert_true(zr_depth_offset(&v0, &v1, &v2, 1, 0) == 0x1p-6f);
    assert_true(zr_depth_offset(&v0, &v1, &v2, -2, 0) == -0x1p-5f);
    assert_true(zr_depth_offset(&v0, &v1, &v2, 0, 1) == 0x1p-24f);
    v1.z = 0.25f; /* 1/32 in y, steeper */
    assert_true(zr_depth_offset(&v0, &v1, &v2, 1, 0) == 0x1p-5f);
}

static void depth_offset_step_is_zero_where_a_float_has_none_left(void **state)
{
    (void)state;
    assert_true(zr_depth_offset_step(1.0f) == 0x1p-23f);
    assert_true(zr_depth_offset_step(0x1.8p-10f) == 0x1p-33f);
    assert_true(zr_depth_offset_step(0x1p-103f) == 0x1p-126f);
    assert_true(zr_depth_offset_step(0x1p-104f) == 0.0f);
    assert_true(zr_depth_offset_step(0.0f) == 0.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(line_from_centre_to_centre_has_its_first_pixel_and_not_its_last),
        cmocka_unit_test(corners_go_round_clockwise_with_the_ends_moved_to_pixel_borders),
        cmocka_unit_test(ends_are_snapped_half_to_even),
        cmocka_unit_test(older_rule_is_not_in_a_build_for_use),
        cmocka_unit_test(line_that_leaves_no_diamond_is_dropped),
        cmocka_unit_test(lines_in_a_chain_share_no_pixel_and_leave_no_gap),
        cmocka_unit_test(plane_runs_along_the_major_axis_from_the_first_value_to_the_second),
        cmocka_unit_test(between_pixel_centres_bresenham_agrees_but_for_the_last_pixel_and_ties),
        cmocka_unit_test(ties_go_left_of_steep_lines_and_to_the_upper_left_of_others),
        cmocka_unit_test(any_line_stays_within_a_subpixel_of_the_ideal_one_and_of_the_dda),
        cmocka_unit_test(clip_line_inside_is_kept_as_it_is),
        cmocka_unit_test(clip_line_out_on_both_sides_is_cut_at_both_with_its_attributes),
        cmocka_unit_test(clip_line_takes_the_farthest_cut_of_several_planes_from_its_own_end),
        cmocka_unit_test(clip_line_from_behind_the_eye_starts_at_the_near_plane),
        cmocka_unit_test(clip_line_past_a_corner_or_outside_of_one_plane_is_gone),
        cmocka_unit_test(clipped_triangle_has_no_edge_along_the_plane),
        cmocka_unit_test(outline_of_a_whole_triangle_starts_with_its_last_edge),
        cmocka_unit_test(outline_of_a_clipped_triangle_goes_round_it_without_the_edge_along_the_plane),
        cmocka_unit_test(outline_of_a_polygon_leaves_out_the_diagonals_of_its_fan),
        cmocka_unit_test(outline_culls_by_side_and_takes_no_area_for_a_back_with_the_colours_of_the_front),
        cmocka_unit_test(depth_offset_is_the_steeper_slope_and_the_step_at_the_farthest_corner),
        cmocka_unit_test(depth_offset_step_is_zero_where_a_float_has_none_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
