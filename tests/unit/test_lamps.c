/* Lamps that have a place: how their light falls off, held against the formulas of KHR_lights_punctual in double, as
 * vertices are lit and as samples are; and that each instruction set gives the same bytes, whatever it is given. */
#include <math.h>
#include <string.h>

#include "lit_samples.h"
#include "shade/lights/light.h"
#include "support/isas.h"

enum { LIGHTS = 6, POINTS = 1001 };

static struct zr_light lights[LIGHTS];
static struct zr_camera camera;
static zr_vec4 normals[POINTS], points[POINTS], bases[POINTS], fronts[2][POINTS], backs[2][POINTS];

/* At the origin, along -z. */
static void make_camera(float scale)
{
    camera = (struct zr_camera){.world_to_eye = zr_mat4_identity()};
    for (int i = 0; i < 3; i++)
        camera.world_to_eye.m[5 * i] = scale;
    camera.projection = (zr_mat4){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -1, 0}};
}

static struct zr_light any_light(struct random *r, bool has_range, bool is_spot)
{
    struct zr_light light = {.type = is_spot ? ZR_LIGHT_SPOT : ZR_LIGHT_POINT,
                             .position = any3(r, -3, 3),
                             .color = any3(r, 0, 0.2),
                             .direction = any_unit(r),
                             .camera_frame = random_below(r, 2)};
    if (has_range) light.range = any(r, 2, 9);
    if (is_spot) {
        light.outer_degrees = random_range(r, 5, 90);
        light.inner_degrees = random_range(r, 0, light.outer_degrees);
    }
    return light;
}

static void make_points(struct random *r)
{
    for (int i = 0; i < POINTS; i++) {
        const zr_vec3 n = any_unit(r), p = any3(r, -4, 4);
        normals[i] = (zr_vec4){n.x, n.y, n.z, 0};
        points[i] = (zr_vec4){p.x, p.y, p.z, 0};
        bases[i] = (zr_vec4){any(r, 0, 1), any(r, 0, 1), any(r, 0, 1), 1};
    }
}

static struct zr_lights make_lighting(struct zr_arena *arena, uint32_t count)
{
    const struct zr_scene scene = {.lights = lights, .light_count = count, .ambient = {0.01f, 0.02f, 0.03f}};
    return zr_lights_make(arena, &scene, &camera);
}

static const struct zr_normal_matrix as_they_are = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

static void light_all(enum zr_isa isa, const struct zr_lights *lighting, int to)
{
    zr_light_placed_of(isa)(lighting, &as_they_are, normals, points, bases, POINTS, fronts[to], backs[to]);
}

/* ---- formulas ---- */

/* What arrives of a lamp's colour at a point of eye space, which is `scale` times as large as the world, and the way
 * there. By KHR_lights_punctual. */
static double arriving(const struct zr_light *light, double scale, d3 point, d3 *to_light)
{
    const d3 position = d3_scale(d3_of(light->position), light->camera_frame ? 1.0 : scale);
    d3 way;
    for (int k = 0; k < 3; k++)
        way.v[k] = position.v[k] - point.v[k];
    const double d = sqrt(d3_dot(way, way)) / scale, degree = acos(-1.0) / 180.0;
    double share = 1.0 / (d * d);
    *to_light = d3_unit(way);
    if (light->range > 0.0f) share *= fmax(fmin(1.0 - pow(d / (double)light->range, 4.0), 1.0), 0.0);
    if (light->type != ZR_LIGHT_SPOT) return share;
    const double inner = cos(light->inner_degrees * degree), outer = cos(light->outer_degrees * degree);
    const double angle_scale = 1.0 / fmax(0.001, inner - outer), angle_offset = -outer * angle_scale;
    const double cosine = -d3_dot(d3_of(light->direction), *to_light);
    const double cone = fmin(fmax(cosine * angle_scale + angle_offset, 0.0), 1.0);
    return share * cone * cone;
}

/* As far as float tells, of what is not cut off at 1. */
static void assert_near(float got, double want, int at)
{
    const double seen = fmin(want, 1.0);
    if (!(fabs((double)got - seen) <= 2e-5 * seen + 2e-6)) fail_msg("point %d: %.9g, not %.9g", at, (double)got, seen);
}

static void check_vertices(uint32_t count, double scale)
{
    static const double ambient[3] = {0.01, 0.02, 0.03};
    for (int i = 0; i < POINTS; i++) {
        const d3 n = d3_of((zr_vec3){normals[i].x, normals[i].y, normals[i].z}),
                 p = d3_of((zr_vec3){points[i].x, points[i].y, points[i].z});
        const float *base = &bases[i].x;
        double front[3], back[3];
        for (int k = 0; k < 3; k++)
            front[k] = back[k] = ambient[(size_t)k] * (double)base[k];
        for (uint32_t l = 0; l < count; l++) {
            d3 to_light;
            const double share = arriving(&lights[l], scale, p, &to_light), facing = d3_dot(n, to_light);
            const float *color = &lights[l].color.x;
            for (int k = 0; k < 3; k++)
                *(facing > 0.0 ? &front[k] : &back[k]) += fabs(facing) * share * (double)color[k] * (double)base[k];
        }
        for (int k = 0; k < 3; k++) {
            assert_near((&fronts[0][i].x)[k], front[k], i);
            assert_near((&backs[0][i].x)[k], back[k], i);
        }
    }
}

/* Of each kind alone, and of some at once; in a view that scales, too. */
static void vertices_have_the_light_of_the_formulas(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(71);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 16);
    for (uint32_t round = 0; round < 48; round++) {
        const float scale = round % 3 ? 1.0f : 2.5f;
        const uint32_t count = round % 2 ? 1 : LIGHTS;
        make_camera(scale);
        make_points(&r);
        for (uint32_t l = 0; l < count; l++)
            lights[l] = any_light(&r, (round + l) / 2 % 2, (round + l) / 4 % 2);
        const struct zr_lights lighting = make_lighting(&arena, count);
        light_all(isa, &lighting, 0);
        check_vertices(count, (double)scale);
        zr_arena_reset(&arena, 1 << 16);
    }
    zr_arena_free(&arena);
}

/* White, flat, and turned towards the lamp. */
static void samples_have_the_light_of_the_formulas(void **state)
{
    static struct lit_samples samples;
    static const struct zr_material white = {.shading = ZR_SHADING_FLAT};
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(72);
    struct zr_lamp lamp = {.is_placed = true, .lights_pbr = true, .lights_classic = true};
    make_camera(1.0f);
    for (uint32_t round = 0; round < 8; round++) {
        const struct zr_light light = any_light(&r, round % 2, round / 2 % 2);
        struct zr_linear_lighting lighting = no_light(&white);
        lamp.place = zr_lamp_place_of(&light, &camera);
        lamp.color = light.color;
        lighting.lights.lamps = &lamp;
        lighting.lights.count = lighting.lights.placed_count = 1;
        samples_clear(&samples);
        for (size_t i = 0; i < SAMPLES; i++) {
            const zr_vec3 point = any3(&r, -4, 4);
            samples_set(&samples, i, 0, (zr_vec3){1, 1, 1}, zr_vec3_normalize(zr_vec3_sub(light.position, point)),
                        point);
        }
        samples_light(&samples, isa, &lighting);
        for (size_t i = 0; i < SAMPLES; i++) {
            d3 to_light;
            const double share = arriving(&light, 1.0, d3_of(get3(samples.g.point, i)), &to_light);
            for (int k = 0; k < 3; k++)
                assert_near(samples.out[k][i], share * (double)(&light.color.x)[k], (int)i);
        }
    }
}

/* ---- cases that are known ---- */

/* Of a white face that is turned to the lamp, at the distance d, off its axis by an angle. */
static float light_at(const struct zr_light *light, double d, double degrees)
{
    const double a = degrees * acos(-1.0) / 180.0;
    const zr_vec3 at = {(float)(d * sin(a)), 0.0f, (float)(-d * cos(a))};
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 12);
    make_camera(1.0f);
    lights[0] = *light;
    points[0] = (zr_vec4){at.x, at.y, at.z, 0};
    normals[0] = (zr_vec4){-at.x, -at.y, -at.z, 0};
    bases[0] = (zr_vec4){1, 1, 1, 1};
    struct zr_lights lighting = make_lighting(&arena, 1);
    lighting.ambient = (zr_vec3){0, 0, 0};
    zr_light_placed_of(ZR_ISA_SCALAR)(&lighting, &as_they_are, normals, points, bases, 1, fronts[0], backs[0]);
    zr_arena_free(&arena);
    return fronts[0][0].x;
}

static void a_point_lamp_falls_off_by_the_square(void **state)
{
    (void)state;
    const struct zr_light lamp = {.type = ZR_LIGHT_POINT, .color = {1, 1, 1}};
    assert_true(light_at(&lamp, 1, 0) == 1.0f);
    assert_true(light_at(&lamp, 2, 0) == 0.25f);
    assert_true(light_at(&lamp, 8, 0) == 1.0f / 64);
    assert_true(fabsf(light_at(&lamp, 4, 123) - 1.0f / 16) < 1e-8f);
}

static void nothing_arrives_at_the_range_and_behind(void **state)
{
    (void)state;
    const struct zr_light lamp = {.type = ZR_LIGHT_POINT, .color = {16, 16, 16}, .range = 8};
    assert_true(light_at(&lamp, 8, 0) == 0.0f && light_at(&lamp, 9, 0) == 0.0f && light_at(&lamp, 1e6, 0) == 0.0f);
    assert_true(light_at(&lamp, 7.99, 0) > 0.0f);
    assert_true(fabsf(light_at(&lamp, 4, 0) - (1.0f - 1.0f / 16)) < 1e-6f);
}

static void a_spot_ends_at_its_outer_angle(void **state)
{
    (void)state;
    const struct zr_light lamp = {
        .type = ZR_LIGHT_SPOT, .color = {4, 4, 4}, .direction = {0, 0, -1}, .inner_degrees = 20, .outer_degrees = 40};
    for (double degrees = 0; degrees <= 19.9; degrees += 19.9)
        assert_true(fabsf(light_at(&lamp, 2, degrees) - 1.0f) < 1e-6f);
    const double degree = acos(-1.0) / 180.0, outer = cos(40 * degree);
    const double half = (cos(30 * degree) - outer) / (cos(20 * degree) - outer);
    assert_true(fabs((double)light_at(&lamp, 2, 30) - half * half) < 1e-5);
    assert_true(light_at(&lamp, 2, 39.9) > 0.0f);
    assert_true(light_at(&lamp, 2, 40.1) == 0.0f && light_at(&lamp, 2, 90) == 0.0f && light_at(&lamp, 2, 180) == 0.0f);
}

/* ---- the same bytes ---- */

static void assert_same_light(int a, int b)
{
    assert_memory_equal(fronts[a], fronts[b], sizeof fronts[a]);
    assert_memory_equal(backs[a], backs[b], sizeof backs[a]);
}

/* Also where a lamp is at the point, or coordinates are as large as floats are, or none. */
static void every_instruction_set_gives_the_same_bytes(void **state)
{
    static const float odd[] = {0.0f, 1e-30f, -1e-20f, 1e-12f, 1e6f, -1e15f, 1e18f, 1e30f, INFINITY, -INFINITY, NAN};
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(73);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 16);
    make_camera(1.0f);
    for (uint32_t round = 0; round < 40; round++) {
        make_points(&r);
        for (int l = 0; l < LIGHTS; l++) {
            lights[l] = any_light(&r, random_below(&r, 2), random_below(&r, 2));
            if (l == 5) lights[l] = (struct zr_light){.direction = any_unit(&r), .color = any3(&r, 0, 1)};
            lights[l].color = zr_vec3_scale(lights[l].color, (float)pow(10.0, random_range(&r, -14, 15)));
            if (l == 0) lights[l].range = (float)pow(10.0, random_range(&r, -30, 9));
        }
        for (int i = 0; i < POINTS; i += 2) {
            float *p = &points[i].x;
            p[random_below(&r, 3)] = odd[random_below(&r, sizeof odd / sizeof *odd)];
            const zr_vec3 at = lights[0].position;
            if (i % 10 == 0) points[i] = (zr_vec4){at.x, at.y, at.z, 0};
        }
        const struct zr_lights lighting = make_lighting(&arena, LIGHTS);
        light_all(ZR_ISA_SCALAR, &lighting, 0);
        light_all(isa, &lighting, 1);
        assert_same_light(0, 1);
        for (int i = 0; i < POINTS; i++)
            for (int k = 0; k < 4; k++) {
                const float front = (&fronts[0][i].x)[k], back = (&backs[0][i].x)[k];
                if (!(front >= 0.0f && front <= 1.0f && back >= 0.0f && back <= 1.0f))
                    fail_msg("point %d: %g, %g", i, (double)front, (double)back);
            }
        zr_arena_reset(&arena, 1 << 16);
    }
    zr_arena_free(&arena);
}

/* A lamp that gives no light beside directional ones changes nothing. */
static void directional_lights_are_as_without_lamps(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    struct random r = random_seeded(74);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 16);
    make_camera(1.0f);
    make_points(&r);
    for (int l = 0; l < LIGHTS; l++)
        lights[l] = (struct zr_light){.direction = any_unit(&r), .color = any3(&r, 0, 0.5)};
    struct zr_lights lighting = make_lighting(&arena, LIGHTS - 1);
    assert_int_equal(lighting.placed_count, 0);
    zr_light_of(isa)(&lighting, &as_they_are, normals, bases, POINTS, fronts[0], backs[0]);
    lights[LIGHTS - 1] = (struct zr_light){.type = ZR_LIGHT_POINT};
    lighting = make_lighting(&arena, LIGHTS);
    assert_int_equal(lighting.placed_count, 1);
    light_all(isa, &lighting, 1);
    assert_same_light(0, 1);
    zr_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(vertices_have_the_light_of_the_formulas),
        TEST_EACH_ISA(samples_have_the_light_of_the_formulas),
        cmocka_unit_test(a_point_lamp_falls_off_by_the_square),
        cmocka_unit_test(nothing_arrives_at_the_range_and_behind),
        cmocka_unit_test(a_spot_ends_at_its_outer_angle),
        TEST_EACH_ISA(every_instruction_set_gives_the_same_bytes),
        TEST_EACH_ISA(directional_lights_are_as_without_lamps),
    };
    return cmocka_run_group_tests_name("lamps", tests, NULL, NULL);
}
