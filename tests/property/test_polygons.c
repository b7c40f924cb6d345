/* Polygons of any shape, through the whole pipeline, against the odd-even rule in exact integers. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

enum { CORNERS_MAX = 1024, RINGS_MAX = 5, SIDE_MAX = 150 };

TEST_ARENA((size_t)1 << 28)

/* One face of several rings, in clip space. Points into itself: do not copy. */
struct polygon {
    struct test_scene test;
    zr_vec4 positions[CORNERS_MAX], colors[CORNERS_MAX];
    uint32_t face_rings[2], ring_offsets[RINGS_MAX + 1], corners, rings;
};

static void polygon_start(struct polygon *p, uint32_t width, uint32_t height)
{
    scene_of_triangles(&p->test, width, height, p->positions, 1);
    p->corners = p->rings = 0;
}

static void add_corner(struct polygon *p, float x, float y, float z, float w)
{
    p->test.indices[p->corners] = p->corners;
    p->positions[p->corners++] = (zr_vec4){x * w, y * w, z * w, w};
}

static void end_ring(struct polygon *p)
{
    p->ring_offsets[++p->rings] = p->corners;
}

static const struct zr_frame *draw(struct polygon *p)
{
    p->ring_offsets[0] = p->face_rings[0] = 0;
    p->face_rings[1] = p->rings;
    p->test.face_offsets[1] = p->test.mesh.position_count = p->corners;
    if (p->rings > 1) {
        p->test.mesh.face_rings = p->face_rings;
        p->test.mesh.ring_offsets = p->ring_offsets;
    }
    return scene_render(&arena, NULL, &p->test.scene);
}

/* ---- the independent opinion ---- */

/* As the viewport places it: units of 1/256 pixel from the centre of the lowest left pixel. */
static int64_t snapped(float clip, float w, uint32_t side)
{
    float half = (float)side * 0.5f, window = clip * (1.0f / w) * half + half;
    return (int64_t)rintf((window - 0.5f) * 256.0f);
}

/* Does the edge pass the sample's row on its left, or through it? Left and bottom edges are inside. */
static bool passes_left(const int64_t a[2], const int64_t b[2], int64_t x, int64_t y)
{
    const int64_t *low = a[1] < b[1] ? a : b, *high = a[1] < b[1] ? b : a;
    if (y < low[1] || y >= high[1]) return false;
    return (high[0] - low[0]) * (y - low[1]) <= (x - low[0]) * (high[1] - low[1]);
}

static bool is_inside(const struct polygon *p, int64_t (*corner)[2], int64_t x, int64_t y)
{
    bool inside = false;
    for (uint32_t r = 0; r < p->rings; r++)
        for (uint32_t begin = p->ring_offsets[r], end = p->ring_offsets[r + 1], i = begin; i < end; i++)
            if (passes_left(corner[i], corner[i + 1 < end ? i + 1 : begin], x, y)) inside = !inside;
    return inside;
}

/* Samples that differ. */
static uint32_t check(struct polygon *p)
{
    static int64_t corner[CORNERS_MAX][2];
    const struct zr_frame *frame = draw(p);
    uint32_t width = frame->width, height = frame->height, wrong = 0;
    for (uint32_t i = 0; i < p->corners; i++) {
        corner[i][0] = snapped(p->positions[i].x, p->positions[i].w, width);
        corner[i][1] = snapped(p->positions[i].y, p->positions[i].w, height);
    }
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            bool inside = is_inside(p, corner, (int64_t)x * 256, (int64_t)y * 256);
            wrong += frame->face_id[(size_t)(height - 1 - y) * width + x] != (inside ? 1u : 0u);
        }
    zr_arena_reset(&arena, (size_t)1 << 28);
    return wrong;
}

/* ---- shapes ---- */

/* Any places, on a grid of so many steps a pixel: crossings, touching and repeated corners. */
static void random_ring(struct polygon *p, struct random *r, uint32_t corners, double steps)
{
    double width = p->test.scene.views[0].width, height = p->test.scene.views[0].height, w = random_range(r, 0.25, 4.0);
    for (uint32_t i = 0; i < corners; i++) {
        double x = floor(random_range(r, 0, width) * steps) / steps,
               y = floor(random_range(r, 0, height) * steps) / steps;
        if (random_below(r, 4) == 0) w = random_range(r, 0.25, 4.0);
        add_corner(p, (float)(2 * x / width - 1), (float)(2 * y / height - 1), 0.25f, steps > 2 ? (float)w : 1.0f);
    }
    end_ring(p);
}

/* A star around a centre: simple, with dents. */
static void star_ring(struct polygon *p, struct random *r, uint32_t corners, double scale)
{
    double cx = random_range(r, -0.2, 0.2), cy = random_range(r, -0.2, 0.2);
    double turn = random_range(r, 0, 6);
    for (uint32_t i = 0; i < corners; i++) {
        double angle = turn + 6.283185307179586 * i / corners, radius = scale * random_range(r, 0.2, 0.75);
        add_corner(p, (float)(cx + radius * cos(angle)), (float)(cy + radius * sin(angle)), 0.25f, 1);
    }
    end_ring(p);
}

static void random_polygon(struct polygon *p, struct random *r)
{
    static const double steps[] = {0.5, 1, 2, 256, 4096};
    polygon_start(p, 1 + random_below(r, SIDE_MAX), 1 + random_below(r, SIDE_MAX));
    uint32_t rings = 1 + random_below(r, 3) * random_below(r, 2), corners = 4 + random_below(r, 12);
    if (random_below(r, 40) == 0) corners = CORNERS_MAX / 4;
    bool star = random_below(r, 2);
    double step = steps[random_below(r, sizeof steps / sizeof *steps)];
    for (uint32_t i = 0; i < rings; i++) {
        if (star)
            star_ring(p, r, corners, i ? 0.3 : 1.0);
        else
            random_ring(p, r, corners, step);
    }
}

TEST(polygons_of_any_shape_follow_the_odd_even_rule_sample_by_sample)
{
    static struct polygon polygon;
    struct random random = random_seeded(31);
    for (int round = 0; round < 3000; round++) {
        random_polygon(&polygon, &random);
        assert_int_equal(check(&polygon), 0);
    }
}

TEST(polygon_of_1024_corners_follows_the_odd_even_rule)
{
    static struct polygon polygon;
    struct random random = random_seeded(32);
    for (int round = 0; round < 8; round++) {
        polygon_start(&polygon, SIDE_MAX, SIDE_MAX);
        if (round % 2)
            star_ring(&polygon, &random, CORNERS_MAX, 1.0);
        else
            random_ring(&polygon, &random, CORNERS_MAX, 256);
        assert_int_equal(check(&polygon), 0);
    }
}

/* The check sees a corner that has moved by one subpixel. */
TEST(check_sees_one_subpixel)
{
    static struct polygon polygon;
    polygon_start(&polygon, 64, 64);
    const float ring[6][2] = {{-0.984375f, -0.984375f}, {0.015625f, -0.984375f}, {0.015625f, -0.484375f},
                              {-0.484375f, -0.484375f}, {-0.484375f, 0.015625f}, {-0.984375f, 0.015625f}};
    for (int i = 0; i < 6; i++)
        add_corner(&polygon, ring[i][0], ring[i][1], 0.25f, 1);
    end_ring(&polygon);
    assert_int_equal(check(&polygon), 0);
    const struct zr_frame *frame = draw(&polygon);
    uint32_t covered = 0;
    for (uint32_t i = 0; i < 64 * 64; i++)
        covered += frame->face_id[i];
    assert_int_equal(covered, 32 * 16 + 16 * 16); /* corners on pixel centres: left and bottom edges count */
    for (int i = 0; i < 6; i++)
        polygon.positions[i].x += 2.0f / 64 / 256;
    frame = draw(&polygon);
    uint32_t moved = 0;
    for (uint32_t y = 0; y < 64; y++)
        moved += frame->face_id[y * 64] != 0;
    assert_int_equal(moved, 0); /* the left column is lost */
    zr_arena_reset(&arena, (size_t)1 << 28);
}

/* ---- depth and colour ---- */

/* Planar: whatever the triangles inside, each sample must lie in the polygon's plane. */
TEST(planar_polygons_of_any_shape_have_the_depth_of_their_plane)
{
    static struct polygon polygon;
    struct random random = random_seeded(33);
    for (int round = 0; round < 300; round++) {
        random_polygon(&polygon, &random);
        double a = random_range(&random, -0.4, 0.4), b = random_range(&random, -0.4, 0.4);
        uint32_t width = polygon.test.scene.views[0].width, height = polygon.test.scene.views[0].height;
        for (uint32_t i = 0; i < polygon.corners; i++) {
            zr_vec4 *p = &polygon.positions[i];
            p->z = (float)(a * (double)p->x + b * (double)p->y);
        }
        const struct zr_frame *frame = draw(&polygon);
        for (uint32_t y = 0; y < height; y++)
            for (uint32_t x = 0; x < width; x++) {
                size_t i = (size_t)(height - 1 - y) * width + x;
                if (frame->face_id[i] == 0) continue;
                double want = 0.5 + 0.5 * (a * (2 * (x + 0.5) / width - 1) + b * (2 * (y + 0.5) / height - 1));
                if (fabs((double)frame->window_depth[i] - want) > 1e-3)
                    fail_msg("round %d, pixel %u, %u: depth %.9g, not %.9g", round, x, y,
                             (double)frame->window_depth[i], want);
            }
        zr_arena_reset(&arena, (size_t)1 << 28);
    }
}

/* Corners on pixel centres and one more on each edge, as near to it as floats are: triangles that are all but
 * flat lie along the edges, and must tell nothing. */
TEST(corners_on_edges_neither_lose_samples_nor_bend_the_depth)
{
    enum { SIDE = 64 };
    static struct polygon polygon;
    struct random random = random_seeded(35);
    int concave = 0;
    for (int round = 0; round < 2000; round++) {
        double a = random_range(&random, -0.4, 0.4), b = random_range(&random, -0.4, 0.4), x[5], y[5];
        uint32_t corners = 4 + random_below(&random, 2);
        polygon_start(&polygon, SIDE, SIDE);
        for (uint32_t i = 0; i < corners; i++) {
            x[i] = (2.0 * (random_below(&random, SIDE) + 0.5) / SIDE - 1) * 0.98;
            y[i] = (2.0 * (random_below(&random, SIDE) + 0.5) / SIDE - 1) * 0.98;
            if (round % 2) {
                x[i] /= 0.98;
                y[i] /= 0.98;
            }
        }
        for (uint32_t i = 0; i < corners; i++) {
            uint32_t next = (i + 1) % corners;
            double t = random_range(&random, 0.1, 0.9), mx = x[i] + t * (x[next] - x[i]),
                   my = y[i] + t * (y[next] - y[i]);
            add_corner(&polygon, (float)x[i], (float)y[i], (float)(a * x[i] + b * y[i]), 1);
            add_corner(&polygon, (float)mx, (float)my, (float)(a * mx + b * my), 1);
        }
        end_ring(&polygon);
        const struct zr_frame *frame = draw(&polygon);
        if (frame->counts.concave_polygons == 0) continue; /* drawn as GL_POLYGON is, thin triangles and all */
        concave++;
        assert_int_equal(check(&polygon), 0);
        frame = draw(&polygon);
        for (uint32_t v = 0; v < SIDE; v++)
            for (uint32_t u = 0; u < SIDE; u++) {
                size_t i = (size_t)(SIDE - 1 - v) * SIDE + u;
                double want = 0.5 + 0.5 * (a * (2 * (u + 0.5) / SIDE - 1) + b * (2 * (v + 0.5) / SIDE - 1));
                if (frame->face_id[i] == 0 || fabs((double)frame->window_depth[i] - want) < 1e-4) continue;
                fail_msg("round %d, pixel %u, %u: depth %.9g, not %.9g", round, u, v, (double)frame->window_depth[i],
                         want);
            }
        zr_arena_reset(&arena, (size_t)1 << 28);
    }
    assert_true(concave > 1000);
}

/* A bow tie whose left wing is the larger one: one-sided, it shows the side that the whole of it tells. */
TEST(side_of_a_polygon_does_not_depend_on_what_the_window_cuts_off)
{
    static struct polygon polygon;
    const float ring[4][2] = {{-2, 2}, {2, -1}, {2, 1}, {-2, -2}};
    int sides = 0;
    for (int turned = 0; turned < 2; turned++) {
        int seen[3];
        for (int zoom = 0; zoom < 3; zoom++) { /* all of it, the left wing, the right one */
            const float middle[3] = {0, -1.5f, 1.5f}, half[3] = {3, 0.6f, 0.6f};
            polygon_start(&polygon, 64, 64);
            polygon.test.material.double_sided = false;
            for (int i = 0; i < 4; i++) {
                const float *at = ring[turned ? 3 - i : i];
                add_corner(&polygon, (at[0] - middle[zoom]) / half[zoom], at[1] / half[zoom], 0, 1);
            }
            end_ring(&polygon);
            const struct zr_frame *frame = draw(&polygon);
            seen[zoom] = 0;
            for (int i = 0; i < 64 * 64; i++)
                seen[zoom] += frame->face_id[i] != 0;
            zr_arena_reset(&arena, (size_t)1 << 28);
        }
        assert_true((seen[0] > 0) == (seen[1] > 0) && (seen[0] > 0) == (seen[2] > 0));
        sides += seen[0] > 0;
    }
    assert_int_equal(sides, 1);
}

/* ---- corners behind the eye ---- */

/* Rays around an axis, or any, in a random three-dimensional part of homogeneous space. */
static void random_cone(struct polygon *p, struct random *r)
{
    const uint32_t corners = 4 + random_below(r, 5);
    const bool convex = random_below(r, 2);
    double axes[3][4];
    for (int k = 0; k < 12; k++)
        axes[k / 4][k % 4] = random_range(r, -1, 1);
    polygon_start(p, 1 + random_below(r, SIDE_MAX), 1 + random_below(r, SIDE_MAX));
    for (uint32_t i = 0; i < corners; i++) {
        const double angle = 6.283185307179586 * (i + random_range(r, 0, 0.9)) / corners,
                     size = random_range(r, 0.1, 2);
        const double ray[3] = {size * (convex ? cos(angle) : random_range(r, -1, 1)),
                               size * (convex ? sin(angle) : random_range(r, -1, 1)),
                               size * (convex ? 0.7 : random_range(r, -1, 1))};
        float v[4];
        for (int c = 0; c < 4; c++)
            v[c] = (float)(ray[0] * axes[0][c] + ray[1] * axes[1][c] + ray[2] * axes[2][c]);
        p->test.indices[p->corners] = p->corners;
        p->positions[p->corners++] = (zr_vec4){v[0], v[1], v[2], v[3]};
    }
    end_ring(p);
}

/* A hole that is a single point, a corner, makes a shape of any face, and that is drawn by parity. */
static void add_empty_hole(struct polygon *p)
{
    for (int i = 0; i < 3; i++) {
        p->test.indices[p->corners] = p->corners;
        p->positions[p->corners++] = p->positions[0];
    }
    end_ring(p);
}

TEST(faces_with_corners_behind_the_eye_cover_what_their_parity_says)
{
    enum { CONES = 6000 };
    struct random random = random_seeded(77);
    static struct polygon p;
    static uint32_t ids[SIDE_MAX * SIDE_MAX];
    uint32_t fans = 0, shapes = 0;
    size_t covered = 0, wrong = 0;
    for (int i = 0; i < CONES; i++) {
        random_cone(&p, &random);
        const struct zr_frame *frame = draw(&p);
        const size_t pixels = (size_t)frame->width * frame->height;
        if (frame->covered_pixels > 0) ++*(frame->counts.concave_polygons ? &shapes : &fans);
        memcpy(ids, frame->face_id, pixels * sizeof *ids);
        zr_arena_reset(&arena, (size_t)1 << 28);
        add_empty_hole(&p);
        frame = draw(&p);
        assert_int_equal(frame->counts.concave_polygons, 1);
        for (size_t k = 0; k < pixels; k++) {
            covered += ids[k] != 0;
            wrong += ids[k] != frame->face_id[k];
        }
        zr_arena_reset(&arena, (size_t)1 << 28);
    }
    assert_true(fans > CONES / 10 && shapes > CONES / 10);
    assert_true(wrong <= covered / 1000000); /* what rounding may cost where triangles are clipped */
}

RUN_TESTS(open_arena, close_arena)
