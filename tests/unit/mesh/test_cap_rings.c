/* Rings of caps: which ring a hole belongs to. */
#include "base/run.h"
#include "mesh/cap_rings.h"
#include "mesh/edge_mesh.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 24)

enum { RINGS_MOST = 8 };

static zr_vec4 positions[4 * RINGS_MOST];
static uint32_t indices[4 * RINGS_MOST], offsets[RINGS_MOST + 1], groups[RINGS_MOST], ring_count;

/* Adds a square around a place; a hole turns the other way. */
static void add_square(float x, float y, float half, int is_hole)
{
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (uint32_t i = 0; i < 4; i++) {
        const float *corner = corners[is_hole ? 3 - i : i];
        const uint32_t at = 4 * ring_count + i;
        positions[at] = (zr_vec4){x + half * corner[0], y + half * corner[1], 2, 1};
        indices[at] = at;
    }
    ring_count++;
}

static void group(void)
{
    const struct zr_mesh mesh = {.position_count = 4 * ring_count, .positions = positions, .indices = indices};
    const struct zr_rings rings = {ring_count, offsets};
    for (uint32_t r = 0; r <= ring_count; r++)
        offsets[r] = 4 * r;
    zr_cap_rings_group(&mesh, &rings, NULL, groups);
    ring_count = 0;
}

TEST(a_hole_belongs_to_the_smallest_ring_around_it)
{
    add_square(0, 0, 10, 0);
    add_square(4, 4, 4, 0);
    add_square(4, 4, 1, 1);
    add_square(-5, -5, 1, 1);
    group();
    assert_int_equal(groups[2], 1);
    assert_int_equal(groups[3], 0);
}

/* A bore through two solids that overlap: each has the hole. */
TEST(bores_that_coincide_are_holes_of_both_rings)
{
    add_square(0, 0, 10, 0);
    add_square(0, 0, 4, 0);
    add_square(0, 0, 1, 1);
    add_square(0, 0, 1, 1);
    add_square(7, 7, 1, 1);
    group();
    assert_int_equal(groups[2], 1);
    assert_int_equal(groups[3], 0);
    assert_int_equal(groups[4], 0);
}

/* The same if one bore is wider. */
TEST(so_are_bores_that_contain_one_another)
{
    add_square(0, 0, 10, 0);
    add_square(0, 0, 4, 0);
    add_square(0, 0, 2, 1);
    add_square(0, 0, 1, 1);
    group();
    assert_int_equal(groups[2] + groups[3], 1);
}

/* The hole of the second ring comes before it. */
TEST_AROUND(a_hole_may_come_before_its_ring, open_arena, close_arena)
{
    const uint32_t face_offsets[] = {0, 12}, face_rings[] = {0, 3};
    add_square(0, 0, 10, 0);
    add_square(4, 4, 1, 1);
    add_square(4, 4, 4, 0);
    const uint32_t rings = ring_count;
    group();
    const struct zr_mesh mesh = {.name = "",
                                 .position_count = 4 * rings,
                                 .positions = positions,
                                 .face_count = 1,
                                 .face_offsets = face_offsets,
                                 .indices = indices,
                                 .face_rings = face_rings,
                                 .ring_offsets = offsets,
                                 .cap_count = 1};
    struct zr_edge_mesh made;
    assert_int_equal(zr_edge_mesh_make(&(struct zr_run){.arena = &arena}, &mesh, &made), ZR_OK);
    double area = 0;
    for (uint32_t t = 0; t < made.triangle_count; t++) {
        zr_vec4 p[3];
        for (uint32_t k = 0; k < 3; k++)
            p[k] = positions[made.positions[made.corners[3 * t + k]]];
        area += 0.5 * fabs((double)((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x)));
    }
    assert_true(fabs(area - (400 + 64 - 4)) < 1e-3);
}

RUN_TESTS(NULL, NULL)
