/* Shares of light are those that texels around a place have, one by one. */
#include <math.h>
#include <string.h>

#include "guarded.h"
#include "shade/gbuffer.h"
#include "support/isas.h"
#include "support/random.h"
#include "support/shadow_map_kernel.h"

enum { SIDE = ZR_SHADOW_SIDE, BORDER = ZR_SHADOW_BORDER, ROWS = SIDE + 2 * BORDER, STRIDE = ROWS + 8, POINTS = 4096 };

static struct random numbers = {{RANDOM_STATE_1}};

static float between(double low, double high)
{
    return (float)random_range(&numbers, low, high);
}

static shadow_shares_fn *shares_of(enum zr_isa isa)
{
    static shadow_shares_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(shadow_shares);
    return table[isa];
}

static shadow_shares_fn *cone_shares_of(enum zr_isa isa)
{
    static shadow_shares_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(shadow_cone_shares);
    return table[isa];
}

/* At the end of a page nobody may read; the rows' padding is full of what would darken everything. */
static struct guarded guarded_depths(void)
{
    static float depths[ROWS * STRIDE];
    for (int y = 0; y < ROWS; y++)
        for (int x = 0; x < STRIDE; x++) {
            const bool is_map = x >= BORDER && x < SIDE + BORDER && y >= BORDER && y < SIDE + BORDER;
            depths[y * STRIDE + x] = x >= ROWS ? -INFINITY : is_map ? between(-1.0, 1.0) : INFINITY;
        }
    return guarded_copy(depths, sizeof(float) * ((ROWS - 1) * STRIDE + ROWS));
}

struct scene {
    struct guarded depths;
    struct zr_shadow_map map;
    float point[3][POINTS], normal[3][POINTS];
    bool is_cone; /* the map is a spot's */
};

static zr_vec3 any_unit(void)
{
    const float x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(0.1, 1.0);
    return zr_vec3_normalize((zr_vec3){x, y, z});
}

/* A map of 2 by 2 units around a light from anywhere, and points in and around it, some of them far away. */
static void make_scene(struct scene *scene)
{
    const zr_vec3 light = any_unit(), u = zr_vec3_normalize(zr_vec3_cross(any_unit(), light));
    const zr_vec3 v = zr_vec3_cross(light, u);
    const float texels = SIDE / 2;
    scene->is_cone = false;
    scene->depths = guarded_depths();
    scene->map = (struct zr_shadow_map){.depths = (const float *)(const void *)scene->depths.bytes,
                                        .stride = STRIDE,
                                        .u_axis = zr_vec3_scale(u, texels),
                                        .v_axis = zr_vec3_scale(v, texels),
                                        .depth_axis = light,
                                        .u_offset = texels,
                                        .v_offset = texels,
                                        .depth_offset = 0.25f,
                                        .bias = 0.01f,
                                        .eye_scale = 1.0f};
    for (int i = 0; i < POINTS; i++) {
        const zr_vec3 n = any_unit();
        const float a = between(-1.02, 1.02), b = between(-1.02, 1.02), c = between(-1.3, 1.3);
        scene->point[0][i] = a * u.x + b * v.x + c * light.x;
        scene->point[1][i] = a * u.y + b * v.y + c * light.y;
        scene->point[2][i] = a * u.z + b * v.z + c * light.z;
        scene->normal[0][i] = n.x, scene->normal[1][i] = n.y, scene->normal[2][i] = n.z;
    }
    for (int k = 0; k < 3; k++) {
        scene->point[k][7] = ZR_FAR_POINT;
        scene->normal[k][7] = 0.0f;
    }
}

/* The lamp is 3 units before the middle of the points, its map as wide there as theirs; eye space is twice as large as
 * the world. */
static void make_cone(struct scene *scene)
{
    struct zr_shadow_map *map = &scene->map;
    const float texels = SIDE / 2, to_texels = 3.0f * texels;
    make_scene(scene);
    const zr_vec3 u = zr_vec3_scale(map->u_axis, 1.0f / texels), v = zr_vec3_scale(map->v_axis, 1.0f / texels);
    scene->is_cone = true;
    map->eye_scale = 2.0f;
    map->depth_offset = 3.0f;
    map->depth_axis = zr_vec3_scale(map->depth_axis, 0.5f);
    map->u_axis = zr_vec3_add(zr_vec3_scale(u, 0.5f * to_texels), zr_vec3_scale(map->depth_axis, texels));
    map->v_axis = zr_vec3_add(zr_vec3_scale(v, 0.5f * to_texels), zr_vec3_scale(map->depth_axis, texels));
    map->u_offset = map->v_offset = texels * map->depth_offset;
    for (int i = 0; i < ROWS * STRIDE - 8; i++)
        ((float *)scene->depths.bytes)[i] += 3.0f;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < POINTS; i++)
            scene->point[k][i] *= 2.0f;
}

static void shares(enum zr_isa isa, const struct scene *scene, float out[POINTS])
{
    const float *const point[3] = {scene->point[0], scene->point[1], scene->point[2]};
    const float *const normal[3] = {scene->normal[0], scene->normal[1], scene->normal[2]};
    (scene->is_cone ? cone_shares_of : shares_of)(isa)(&scene->map, point, normal, POINTS, out);
}

static double along(zr_vec3 axis, const double p[3], float offset)
{
    return (double)axis.x * p[0] + (double)axis.y * p[1] + (double)axis.z * p[2] + (double)offset;
}

struct share {
    double least, most; /* where a depth is so near to a texel's that floats may see either */
    bool is_certain;    /* else the place is between two texels */
};

static struct share reference_share(const struct scene *scene, int i)
{
    const struct zr_shadow_map *map = &scene->map;
    double p[3], bias = (double)map->bias, scale = (double)map->eye_scale;
    for (int k = 0; k < 3; k++)
        p[k] = (double)scene->point[k][i];
    if (scene->is_cone) {
        bias *= fmax(along(map->depth_axis, p, map->depth_offset), 0.0);
    }
    for (int k = 0; k < 3; k++)
        p[k] += bias * scale * (double)scene->normal[k][i];
    const double w = scene->is_cone ? along(map->depth_axis, p, map->depth_offset) : 1.0;
    const double u = along(map->u_axis, p, map->u_offset) / w, v = along(map->v_axis, p, map->v_offset) / w;
    const double depth = along(map->depth_axis, p, map->depth_offset) - bias;
    struct share share = {0.0, 0.0, fabs(u - rint(u)) > 1e-3 && fabs(v - rint(v)) > 1e-3};
    int texels = 0;
    for (int dy = -4; dy <= 4; dy++)
        for (int dx = -4; dx <= 4; dx++) {
            if (dx * dx + dy * dy > 12) continue;
            const double x = floor(u) + dx, y = floor(v) + dy;
            double texel = (double)INFINITY;
            if (x >= 0 && x < SIDE && y >= 0 && y < SIDE)
                texel = (double)map->depths[((int)y + BORDER) * STRIDE + (int)x + BORDER];
            texels++;
            share.least += depth < texel - 1e-5;
            share.most += depth < texel + 1e-5;
        }
    share.least /= texels, share.most /= texels;
    return share;
}

static void shares_are_those_of_37_texels(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    static struct scene scene;
    static float got[POINTS];
    int certain = 0, between_0_and_1 = 0;
    for (int round = 0; round < 8; round++) {
        (round % 2 ? make_cone : make_scene)(&scene);
        shares(isa, &scene, got);
        for (int i = 0; i < POINTS; i++) {
            const struct share want = reference_share(&scene, i);
            if (!want.is_certain) continue;
            certain++, between_0_and_1 += got[i] > 0.0f && got[i] < 1.0f;
            if (!((double)got[i] > want.least - 1e-6 && (double)got[i] < want.most + 1e-6))
                fail_msg("round %d, point %d: %g, not %g to %g", round, i, (double)got[i], want.least, want.most);
        }
        assert_true(scene.is_cone || got[7] == 1.0f); /* a cone may hold what is far away */
        guarded_free(&scene.depths);
    }
    assert_true(certain > 30000 && between_0_and_1 > 10000);
}

static void all_instruction_sets_give_the_same_shares(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    static struct scene scene;
    static float got[POINTS], want[POINTS];
    static const float odd[] = {1e9f, -1e9f, 1e30f, -3e38f, INFINITY, -INFINITY, NAN, -0.0f};
    for (int round = 0; round < 8; round++) {
        (round % 2 ? make_cone : make_scene)(&scene);
        for (int i = 0; i < 200; i++)
            scene.point[random_below(&numbers, 3)][random_below(&numbers, POINTS)] = odd[random_below(&numbers, 8)];
        shares(ZR_ISA_SCALAR, &scene, want);
        shares(isa, &scene, got);
        assert_memory_equal(got, want, sizeof want);
        for (int i = 0; i < POINTS; i++)
            assert_true(got[i] >= 0.0f && got[i] <= 1.0f);
        guarded_free(&scene.depths);
    }
}

/* A wall over one half of the map: light goes up from 0 to 1 over 7 texels, and the bias frees the wall itself. */
static void the_border_of_a_shadow_is_soft(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    static float depths[ROWS * STRIDE], got[16];
    for (int y = 0; y < ROWS; y++)
        for (int x = 0; x < STRIDE; x++)
            depths[y * STRIDE + x] = x < BORDER + 500 && x >= BORDER ? 10.0f : INFINITY;
    const struct zr_shadow_map map = {.depths = depths,
                                      .stride = STRIDE,
                                      .u_axis = {1, 0, 0},
                                      .v_axis = {0, 1, 0},
                                      .depth_axis = {0, 0, 1},
                                      .bias = 0.1f,
                                      .eye_scale = 1.0f};
    float x[16], y[16], z[16], none[16] = {0}, up[16];
    for (int i = 0; i < 16; i++) {
        x[i] = 494.5f + (float)i, y[i] = 512.0f, z[i] = 20.0f, up[i] = -1.0f;
    }
    const float *const point[3] = {x, y, z}, *const normal[3] = {none, none, up};
    shares_of(isa)(&map, point, normal, 16, got);
    static const int lit[] = {0, 0, 0, 3, 8, 15, 22, 29, 34, 37, 37, 37};
    for (int i = 0; i < 12; i++)
        assert_true(got[i] == (float)lit[i] / 37.0f);
    for (int i = 0; i < 16; i++)
        z[i] = 10.15f;
    shares_of(isa)(&map, point, normal, 16, got);
    for (int i = 0; i < 16; i++)
        assert_true(got[i] == 1.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(shares_are_those_of_37_texels),
        TEST_EACH_ISA(all_instruction_sets_give_the_same_shares),
        TEST_EACH_ISA(the_border_of_a_shadow_is_soft),
    };
    return cmocka_run_group_tests_name("shadow_map", tests, NULL, NULL);
}
