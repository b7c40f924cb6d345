/* Rings of caps: which ring a hole belongs to. */
#include "mesh/cap_rings.h"
#include "support/tests.h"

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

RUN_TESTS(NULL, NULL)
