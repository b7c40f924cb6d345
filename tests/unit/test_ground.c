/* Limits of the shadow on the ground. */
#include <math.h>
#include <string.h>

#include "effects/ground.h"
#include "guarded.h"
#include "support/isas.h"
#include "support/random.h"
#include "support/test_arena.h"

enum { SIDE = ZR_GROUND_SIDE, TEXELS = SIDE * SIDE };

TEST_ARENA(1 << 24)

static struct random numbers = {{RANDOM_STATE_1}};

static float between(double low, double high)
{
    return (float)random_range(&numbers, low, high);
}

/* ---- the map ---- */

TEST_AROUND(light_is_full_where_nothing_is_near, open_arena, close_arena)
{
    static float heights[TEXELS];
    for (int i = 0; i < TEXELS; i++)
        heights[i] = INFINITY;
    heights[0] = 0.001f;
    const struct zr_ground ground = zr_ground_make(&arena, NULL, heights, 1.0f, 1.0f);
    assert_true(ground.light[0] < 1.0f);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            if (x > 24 || y > 24) assert_true(ground.light[y * SIDE + x] == 1.0f);
}

TEST_AROUND(maps_of_no_size_give_numbers, open_arena, close_arena)
{
    static float heights[TEXELS];
    heights[5] = INFINITY;
    heights[6] = -1.0f;
    static const float sizes[][2] = {{0.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 0.0f}, {1e-30f, 1e30f}, {1e30f, 1e-30f}};
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
        const struct zr_ground ground = zr_ground_make(&arena, NULL, heights, sizes[k][0], sizes[k][1]);
        for (int i = 0; i < TEXELS; i++)
            assert_true(ground.light[i] >= 0.0f && ground.light[i] <= 1.0f);
        const float light = zr_ground_at(&ground, 0.0f, 0.0f);
        assert_true(light >= 0.0f && light <= 1.0f);
    }
}

TEST(a_failed_arena_gives_no_map)
{
    static float heights[TEXELS];
    struct zr_arena small;
    zr_arena_init(&small, 1000);
    assert_null(zr_ground_make(&small, NULL, heights, 1.0f, 1.0f).light);
    zr_arena_free(&small);
}

/* ---- places and pixels ---- */

/* Dark up to the border, so that steps would show. */
static struct zr_ground rough_ground(float half_size)
{
    static float light[TEXELS];
    for (int i = 0; i < TEXELS; i++)
        light[i] = between(0.0, 1.0);
    return (struct zr_ground){half_size, light};
}

struct place {
    double x, y, z;
};

/* What is asked for one place is what a ray straight down has. */
TEST_EACH_ISA(a_ray_straight_down_has_the_light_of_its_place)
{
    const enum zr_isa isa = isa_under_test(state);
    const struct zr_ground ground = rough_ground(2.0f);
    const struct zr_ground_frame frame = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    enum { WIDTH = 300 };
    const float step = 0.015625f;
    const struct zr_rays rays = {{-2.25f, -1.0f, 4.0f}, {step, 0, 0}, {0, step, 0}, {0, 0, -1}, {0, 0, 0}, {0, 0, 0}};
    float row[WIDTH];
    zr_ground_row_of(isa)(&ground, &frame, &rays, 20, WIDTH, row);
    for (int x = 0; x < WIDTH; x++)
        assert_true(row[x] == zr_ground_at(&ground, -2.25f + ((float)x + 0.5f) * step, -1.0f + 20.5f * step));
}

RUN_TESTS(NULL, NULL)
