/* Point lamps and spots: cases of KHR_lights_punctual whose light is known. */
#include <math.h>
#include <string.h>

#include "scene/picture.h"
#include "shade/lights/light.h"
#include "support/tests.h"
#include "unit/common/lit_samples.h"

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

static struct zr_lights make_lighting(struct zr_arena *arena, uint32_t count)
{
    static const struct zr_picture picture = {.side = 1};
    const struct zr_scene scene = {
        .picture = &picture, .lights = lights, .light_count = count, .ambient = {0.01f, 0.02f, 0.03f}};
    return zr_lights_make(arena, &scene, &camera);
}

static const struct zr_normal_matrix as_they_are = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

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

TEST(a_point_lamp_falls_off_by_the_square)
{
    const struct zr_light lamp = {.type = ZR_LIGHT_POINT, .color = {1, 1, 1}};
    assert_true(light_at(&lamp, 1, 0) == 1.0f);
    assert_true(light_at(&lamp, 2, 0) == 0.25f);
    assert_true(light_at(&lamp, 8, 0) == 1.0f / 64);
    assert_true(fabsf(light_at(&lamp, 4, 123) - 1.0f / 16) < 1e-8f);
}

TEST(nothing_arrives_at_the_range_and_behind)
{
    const struct zr_light lamp = {.type = ZR_LIGHT_POINT, .color = {16, 16, 16}, .range = 8};
    assert_true(light_at(&lamp, 8, 0) == 0.0f && light_at(&lamp, 9, 0) == 0.0f && light_at(&lamp, 1e6, 0) == 0.0f);
    assert_true(light_at(&lamp, 7.99, 0) > 0.0f);
    assert_true(fabsf(light_at(&lamp, 4, 0) - (1.0f - 1.0f / 16)) < 1e-6f);
}

TEST(a_spot_ends_at_its_outer_angle)
{
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

RUN_TESTS(NULL, NULL)
