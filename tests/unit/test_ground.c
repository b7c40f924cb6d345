/* The shadow on the ground is that of its formula, and its rows are the same for every instruction set. */
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

static void light_is_full_where_nothing_is_near(void **state)
{
    (void)state;
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

static void maps_of_no_size_give_numbers(void **state)
{
    (void)state;
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

static void a_failed_arena_gives_no_map(void **state)
{
    (void)state;
    static float heights[TEXELS];
    struct zr_arena small;
    zr_arena_init(&small, 1000);
    assert_null(zr_ground_make(&small, NULL, heights, 1.0f, 1.0f).light);
    zr_arena_free(&small);
}

/* ---- places and pixels ---- */

static double texel_or_1(const struct zr_ground *ground, int x, int y)
{
    return x >= 0 && x < SIDE && y >= 0 && y < SIDE ? (double)ground->light[y * SIDE + x] : 1.0;
}

static double reference_at(const struct zr_ground *ground, double x, double y)
{
    const double texel = 2.0 * (double)ground->half_size / SIDE;
    const double u = (x + (double)ground->half_size) / texel - 0.5, v = (y + (double)ground->half_size) / texel - 0.5;
    if (!(u > -1.0 && u < SIDE && v > -1.0 && v < SIDE)) return 1.0;
    const int i = (int)floor(u), j = (int)floor(v);
    double sum = 0.0;
    for (int dy = 0; dy < 2; dy++)
        for (int dx = 0; dx < 2; dx++)
            sum += (1.0 - fabs(u - (double)(i + dx))) * (1.0 - fabs(v - (double)(j + dy))) *
                   texel_or_1(ground, i + dx, j + dy);
    return sum;
}

/* Dark up to the border, so that steps would show. */
static struct zr_ground rough_ground(float half_size)
{
    static float light[TEXELS];
    for (int i = 0; i < TEXELS; i++)
        light[i] = between(0.0, 1.0);
    return (struct zr_ground){half_size, light};
}

static void places_are_between_texels(void **state)
{
    (void)state;
    const struct zr_ground ground = rough_ground(3.0f);
    for (int i = 0; i < 100000; i++) {
        const float x = between(-3.1, 3.1), y = between(-3.1, 3.1);
        const double want = reference_at(&ground, (double)x, (double)y);
        if (!(fabs((double)zr_ground_at(&ground, x, y) - want) < 1e-4))
            fail_msg("at %g, %g: not %g", (double)x, (double)y, want);
    }
    static const float far[] = {3.1f, 1e20f, INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < sizeof far / sizeof far[0]; i++) {
        assert_true(zr_ground_at(&ground, far[i], 0.0f) == 1.0f);
        assert_true(zr_ground_at(&ground, 0.0f, -far[i]) == 1.0f);
    }
}

static zr_vec3 any_vector(void)
{
    const float x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(-1.0, 1.0);
    return (zr_vec3){x, y, z};
}

static struct zr_ground_frame any_frame(void)
{
    const zr_vec3 z = zr_vec3_normalize(any_vector());
    const zr_vec3 x = zr_vec3_normalize(zr_vec3_cross(z, any_vector()));
    return (struct zr_ground_frame){zr_vec3_scale(any_vector(), 3.0f), x, zr_vec3_cross(z, x), z};
}

/* Towards the plane's middle or nearly along the plane, some 100 pixels across. */
static struct zr_rays any_rays(const struct zr_ground_frame *frame, bool is_parallel)
{
    const zr_vec3 none = {0, 0, 0}, start = zr_vec3_add(frame->origin, zr_vec3_scale(any_vector(), 5.0f));
    const zr_vec3 to_middle = zr_vec3_sub(frame->origin, start), step_x = zr_vec3_scale(any_vector(), 0.05f),
                  step_y = zr_vec3_scale(any_vector(), 0.05f);
    if (is_parallel) return (struct zr_rays){start, step_x, step_y, to_middle, none, none};
    return (struct zr_rays){start, none, none, zr_vec3_sub(to_middle, zr_vec3_scale(step_x, 50.0f)), step_x, step_y};
}

struct place {
    double x, y, z;
};

static struct place place_on(zr_vec3 v, zr_vec3 v_x, zr_vec3 v_y, double x, double y)
{
    return (struct place){(double)v.x + x * (double)v_x.x + y * (double)v_y.x,
                          (double)v.y + x * (double)v_x.y + y * (double)v_y.y,
                          (double)v.z + x * (double)v_x.z + y * (double)v_y.z};
}

static double dot(struct place a, zr_vec3 b)
{
    return a.x * (double)b.x + a.y * (double)b.y + a.z * (double)b.z;
}

/* False where the ray is so near to a case of its own that floats may see another one. */
static bool reference_pixel(const struct zr_ground *ground, const struct zr_ground_frame *frame,
                            const struct zr_rays *rays, int x, int y, double *light)
{
    const double px = (double)x + 0.5, py = (double)y + 0.5;
    struct place o = place_on(rays->origin, rays->origin_x, rays->origin_y, px, py);
    const struct place d = place_on(rays->direction, rays->direction_x, rays->direction_y, px, py);
    o = (struct place){o.x - (double)frame->origin.x, o.y - (double)frame->origin.y, o.z - (double)frame->origin.z};
    const double height = dot(o, frame->z_axis), falls = dot(d, frame->z_axis);
    if (fabs(height) < 1e-3 || fabs(falls) < 1e-2) return false;
    const double t = -height / falls;
    *light = 1.0;
    if (t > 0.0)
        *light = reference_at(ground, dot(o, frame->x_axis) + t * dot(d, frame->x_axis),
                              dot(o, frame->y_axis) + t * dot(d, frame->y_axis));
    return true;
}

/* Smooth, so that what floats round away does not show. */
static struct zr_ground smooth_ground(float half_size)
{
    static float light[TEXELS];
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const float u = (float)x / 96.0f - 1.0f, v = (float)y / 96.0f - 0.9f, square = u * u + v * v;
            light[y * SIDE + x] = square < 0.9f ? 0.1f + square : 1.0f;
        }
    return (struct zr_ground){half_size, light};
}

static void rows_have_the_light_where_rays_meet_the_plane(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    const struct zr_ground ground = smooth_ground(2.0f);
    enum { WIDTH = 101 };
    int seen = 0, dark = 0;
    for (int round = 0; round < 400; round++) {
        const struct zr_ground_frame frame = any_frame();
        const struct zr_rays rays = any_rays(&frame, round % 2);
        const int y = (int)random_below(&numbers, 50);
        float row[WIDTH];
        zr_ground_row_of(isa)(&ground, &frame, &rays, y, WIDTH, row);
        for (int x = 0; x < WIDTH; x++) {
            double want;
            if (!reference_pixel(&ground, &frame, &rays, x, y, &want)) continue;
            seen++, dark += want < 0.9;
            if (!(fabs((double)row[x] - want) < 2e-3))
                fail_msg("round %d, pixel %d, %d: %g, not %g", round, x, y, (double)row[x], want);
        }
    }
    assert_true(seen > 30000 && dark > 3000);
}

/* What is asked for one place is what a ray straight down has. */
static void a_ray_straight_down_has_the_light_of_its_place(void **state)
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(light_is_full_where_nothing_is_near, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(maps_of_no_size_give_numbers, open_arena, close_arena),
        cmocka_unit_test(a_failed_arena_gives_no_map),
        cmocka_unit_test(places_are_between_texels),
        TEST_EACH_ISA(rows_have_the_light_where_rays_meet_the_plane),
        TEST_EACH_ISA(a_ray_straight_down_has_the_light_of_its_place),
    };
    return cmocka_run_group_tests_name("ground", tests, NULL, NULL);
}
