/* Limits of the shadow on the ground. */
#include <math.h>
#include <string.h>

#include "base/run.h"
#include "effects/ground.h"
#include "support/isas.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/guarded.h"

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
    const struct zr_ground ground = zr_ground_make(&(struct zr_run){.arena = &arena}, heights, 1.0f, 1.0f, INFINITY);
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
        const struct zr_ground ground =
            zr_ground_make(&(struct zr_run){.arena = &arena}, heights, sizes[k][0], sizes[k][1], INFINITY);
        for (int i = 0; i < TEXELS; i++)
            assert_true(ground.light[i] >= 0.0f && ground.light[i] <= 1.0f);
        const float light = zr_ground_at(&ground, 0.0f, 0.0f);
        assert_true(light >= 0.0f && light <= 1.0f);
    }
}

/* A plate of height h on the plane: far from it there is no halo, and the contact line is darker than under what is
 * higher. */
TEST_AROUND(low_scenes_have_no_halo, open_arena, close_arena)
{
    static float heights[TEXELS];
    for (int i = 0; i < TEXELS; i++)
        heights[i] = i % SIDE < SIDE / 2 ? 0.0f : INFINITY;
    const struct zr_ground high = zr_ground_make(&(struct zr_run){.arena = &arena}, heights, 1.0f, 1.0f, INFINITY);
    const struct zr_ground same =
        zr_ground_make(&(struct zr_run){.arena = &arena}, heights, 1.0f, 1.0f, 0.4201f); /* 1.2 * 0.35 */
    const struct zr_ground less = zr_ground_make(&(struct zr_run){.arena = &arena}, heights, 1.0f, 1.0f, 0.4f);
    const struct zr_ground low = zr_ground_make(&(struct zr_run){.arena = &arena}, heights, 1.0f, 1.0f, 0.01f);
    const struct zr_ground flat = zr_ground_make(&(struct zr_run){.arena = &arena}, heights, 1.0f, 1.0f, 0.0f);
    const float *middle = low.light + SIDE / 2 * SIDE;
    assert_memory_equal(high.light, same.light, TEXELS * sizeof *high.light);
    assert_true(memcmp(high.light, less.light, TEXELS * sizeof *high.light) != 0);
    /* the blur of the far part is 3 * 0.07 D * f wide: f is 0.12, and of the near part 0.139 */
    assert_true(middle[SIDE / 2 + 4] == 1.0f && high.light[SIDE / 2 * SIDE + SIDE / 2 + 4] < 0.9f);
    /* below it, each part has (1 + f) / 2 of its strength */
    const double share = 0.01 / (1.2 * 0.06), near = 0.55 * (1 + share) / 2, far = 0.45 * (1 + 0.12) / 2;
    assert_true(fabs((double)middle[SIDE / 4] - (1 - near) * (1 - far)) < 1e-4);
    assert_true(flat.light[SIDE / 2 * SIDE + SIDE / 4] > middle[SIDE / 4]);
}

TEST(a_failed_arena_gives_no_map)
{
    static float heights[TEXELS];
    struct zr_arena small;
    zr_arena_init(&small, 1000);
    assert_null(zr_ground_make(&(struct zr_run){.arena = &small}, heights, 1.0f, 1.0f, INFINITY).light);
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

/* ---- the shadow of a lamp ---- */

enum { SUN_STRIDE = ZR_SHADOW_SIDE + 2 * ZR_SHADOW_BORDER };

/* In front of the plane in a checkered part of the map, which shows from where texels are counted. */
static const float *make_blockers(void)
{
    static float depths[SUN_STRIDE * SUN_STRIDE];
    for (int y = 0; y < SUN_STRIDE; y++)
        for (int x = 0; x < SUN_STRIDE; x++) {
            const int u = x - ZR_SHADOW_BORDER, v = y - ZR_SHADOW_BORDER;
            const bool within = u >= 0 && u < ZR_SHADOW_SIDE && v >= 0 && v < ZR_SHADOW_SIDE;
            depths[y * SUN_STRIDE + x] = within && (u / 5 + v / 3) % 2 ? -1.0f : INFINITY;
        }
    return depths;
}

/* The share of the texels around one that are lit. */
static double lit_around(const float *depths, int u, int v)
{
    int lit = 0;
    for (int y = -3; y <= 3; y++)
        for (int x = -3; x <= 3; x++) {
            const int at_u = u + x, at_v = v + y;
            if (x * x + y * y > 12) continue;
            const bool within = at_u >= 0 && at_u < ZR_SHADOW_SIDE && at_v >= 0 && at_v < ZR_SHADOW_SIDE;
            lit += !within || depths[(at_v + ZR_SHADOW_BORDER) * SUN_STRIDE + at_u + ZR_SHADOW_BORDER] > 0.0f;
        }
    return lit / 37.0;
}

TEST_EACH_ISA(a_lamps_shadow_takes_up_to_half_of_the_ground)
{
    enum { WIDTH = 300, ROW = 20 };
    const enum zr_isa isa = isa_under_test(state);
    const float *depths = make_blockers(), step = 4.0f;
    /* a texel is a unit; rays go straight down, from beyond the map on its left */
    const struct zr_shadow_map map = {.depths = depths,
                                      .stride = SUN_STRIDE,
                                      .u_axis = {1, 0, 0},
                                      .v_axis = {0, 1, 0},
                                      .depth_axis = {0, 0, -1},
                                      .eye_scale = 1};
    const struct zr_ground_sun sun = {&map, {0, 0, 0}};
    const struct zr_ground_frame frame = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const struct zr_rays rays = {{-64.0f, 7.5f, 4.0f}, {step, 0, 0}, {0, step, 0}, {0, 0, -1}, {0, 0, 0}, {0, 0, 0}};
    float row[WIDTH];
    int darkened = 0;
    for (int x = 0; x < WIDTH; x++)
        row[x] = 0.5f;
    zr_ground_sun_row_of(isa)(&sun, &frame, &rays, ROW, WIDTH, row);
    for (int x = 0; x < WIDTH; x++) {
        const double u = -64.0 + (x + 0.5) * 4.0, v = 7.5 + (ROW + 0.5) * 4.0;
        const double want = 0.5 * (1.0 - 0.5 * (1.0 - lit_around(depths, (int)floor(u), (int)floor(v))));
        assert_true(fabs((double)row[x] - want) < 1e-6);
        darkened += row[x] < 0.5f;
    }
    assert_in_range(darkened, 200, 280);
}

/* It leaves the picture as in a photograph. */
TEST_EACH_ISA(a_lamps_shadow_reaches_the_border)
{
    enum { WIDTH = 80, HEIGHT = 96 };
    static float depths[SUN_STRIDE * SUN_STRIDE];
    for (int i = 0; i < SUN_STRIDE * SUN_STRIDE; i++)
        depths[i] = -1.0f;
    const struct zr_shadow_map map = {.depths = depths,
                                      .stride = SUN_STRIDE,
                                      .u_axis = {1, 0, 0},
                                      .v_axis = {0, 1, 0},
                                      .u_offset = 300,
                                      .v_offset = 300,
                                      .depth_axis = {0, 0, -1},
                                      .eye_scale = 1};
    const struct zr_ground_sun sun = {&map, {0, 0, 0}};
    const struct zr_ground_frame frame = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const struct zr_rays rays = {{0, 0, 4}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 0}, {0, 0, 0}};
    for (int y = 0; y < HEIGHT; y++) {
        float row[WIDTH];
        for (int x = 0; x < WIDTH; x++)
            row[x] = 1.0f;
        zr_ground_sun_row_of(isa_under_test(state))(&sun, &frame, &rays, y, WIDTH, row);
        for (int x = 0; x < WIDTH; x++)
            assert_true(row[x] == 0.5f);
    }
}

/* Rays that go up meet no ground. */
TEST_EACH_ISA(above_the_horizon_no_lamp_casts_a_shadow)
{
    const float *depths = make_blockers();
    const struct zr_shadow_map map = {.depths = depths, .stride = SUN_STRIDE, .u_offset = 512, .v_offset = 510};
    const struct zr_ground_sun sun = {&map, {0, 0, 0}};
    const struct zr_ground_frame frame = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const struct zr_rays rays = {{0, 0, 4}, {0, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, 0, 0}};
    float row[20];
    for (int x = 0; x < 20; x++)
        row[x] = 1.0f;
    zr_ground_sun_row_of(isa_under_test(state))(&sun, &frame, &rays, 0, 20, row);
    for (int x = 0; x < 20; x++)
        assert_true(row[x] == 1.0f);
}

RUN_TESTS(NULL, NULL)
