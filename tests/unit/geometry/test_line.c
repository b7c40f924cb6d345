/* Lines of width 1, outlines, their clipping, and the depth offset. */
#include <math.h>
#include <stdlib.h>

#include "base/mutant.h"
#include "geometry/outline.h"
#include "raster/depth_offset.h"
#include "raster/line.h"
#include "support/random.h"
#include "support/tests.h"

static struct zr_window_vertex at(float x, float y)
{
    return (struct zr_window_vertex){.x = x, .y = y, .oow = 1};
}

/* ---- what a line covers ---- */

enum { LONGEST = 256 };

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

TEST(older_rule_is_not_in_a_build_for_use)
{
    assert_false(zr_mutant_set("older_mesa", true));
    assert_true(zr_mutant_set("older_mesa", false));
}

TEST(line_that_leaves_no_diamond_is_dropped)
{
    struct zr_line_corners c;
    struct zr_window_vertex a = at(2.5f, 2.5f), b = at(2.375f, 2.5f), d = at(2.625f, 2.5f);
    assert_false(zr_line_corners_make(&a, &a, 1, &c));
    assert_int_equal(cover_of(b.x, b.y, d.x, d.y).count, 0);
    assert_int_equal(cover_of(d.x, d.y, b.x, b.y).count, 0);
    /* Half a pixel on, out of the diamond: drawn, though only a pixel's quarter long. */
    assert_int_equal(cover_of(2.75f, 2.5f, 3.0f, 2.5f).count, 1);
    assert_int_equal(cover_of(2.75f, 2.875f, 3.0f, 2.875f).count, 0);
}

/* ---- judged by Bresenham and by the DDA ---- */

/* In shares of what rounding explains: half a subpixel of the minor coordinate, and half a
 * one of the major times the slope. */
/* ---- clipping ---- */

static bool clip(const zr_vec4 in[2], struct zr_clipped *out)
{
    unsigned outcodes[2] = {zr_clip_outcode(in[0]), zr_clip_outcode(in[1])};
    return zr_clip_line(in, outcodes, out);
}

TEST(clip_line_takes_the_farthest_cut_of_several_planes_from_its_own_end)
{
    /* Out of x = w by 1 of 2 and of y = w by 3 of 4: only the second cut counts. */
    const zr_vec4 in[2] = {{0, 0, 0, 1}, {2, 4, 0, 1}};
    struct zr_clipped out;
    assert_true(clip(in, &out));
    assert_true(out.vertices[0].position.x == 0.0f && out.vertices[1].position.x == 0.5f &&
                out.vertices[1].position.y == 1.0f);
}

TEST(clip_line_from_behind_the_eye_starts_at_the_near_plane)
{
    /* z + w: -3 behind the eye, 1 in front: three quarters are cut off, and w is positive there. */
    const zr_vec4 in[2] = {{0, 0, -2, -1}, {0, 0, -1, 2}};
    struct zr_clipped out;
    assert_true(clip(in, &out));
    assert_true(out.vertices[0].position.z == -1.25f && out.vertices[0].position.w == 1.25f);
    assert_true(out.vertices[1].position.w == 2.0f);
}

TEST(clip_line_past_a_corner_or_outside_of_one_plane_is_gone)
{
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

TEST(clipped_triangle_has_no_edge_along_the_plane)
{
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

/* ---- depth offset ---- */

TEST(depth_offset_is_the_steeper_slope_and_the_step_at_the_farthest_corner)
{
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

RUN_TESTS(NULL, NULL)
