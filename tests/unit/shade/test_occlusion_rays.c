/* Ambient occlusion beside rays: their share of light that arrives from within the radius, 1 here. */
#include <stdio.h>
#include <stdlib.h>

#include "base/run.h"
#include "effects/occlusion.h"
#include "support/rays.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/occlusion_scenes.h"

TEST_ARENA(1 << 26)

#define V(...)                                                                                                         \
    (const double[3])                                                                                                  \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }

static struct rays_scene scene;

/* ---- shapes ---- */

/* A prism of 24 sides along a vector; of a rod, or if it is the wall of a hole, from inside. */
static void add_tube(const double from[3], const double along[3], double radius)
{
    const int axis = fabs(along[0]) > fabs(along[2]) ? 0 : 2, i = (axis + 1) % 3, j = (axis + 2) % 3;
    for (int k = 0; k < 24; k++) {
        const double a = k * acos(-1.0) / 12, b = (k + 1) * acos(-1.0) / 12;
        double corner[3] = {from[0], from[1], from[2]}, side[3] = {0};
        corner[i] += radius * cos(a), corner[j] += radius * sin(a);
        side[i] = radius * (cos(b) - cos(a)), side[j] = radius * (sin(b) - sin(a));
        rays_add_quad(&scene, corner, side, along);
    }
}

static void add_floor(double side)
{
    rays_add_quad(&scene, V(-side, -side, 0), V(2 * side, 0, 0), V(0, 2 * side, 0));
}

/* A floor with a hole of 2 a x 2 b and this depth. */
static void add_well(double side, double a, double b, double depth)
{
    rays_add_quad(&scene, V(-side, -side, 0), V(side - a, 0, 0), V(0, 2 * side, 0));
    rays_add_quad(&scene, V(a, -side, 0), V(side - a, 0, 0), V(0, 2 * side, 0));
    if (b < side) {
        rays_add_quad(&scene, V(-a, -side, 0), V(2 * a, 0, 0), V(0, side - b, 0));
        rays_add_quad(&scene, V(-a, b, 0), V(2 * a, 0, 0), V(0, side - b, 0));
    }
    rays_add_quad(&scene, V(-a, -b, -depth), V(2 * a, 0, 0), V(0, 2 * b, 0));
    rays_add_quad(&scene, V(-a, -b, -depth), V(0, 0, depth), V(0, 2 * b, 0));
    rays_add_quad(&scene, V(a, -b, -depth), V(0, 0, depth), V(0, 2 * b, 0));
    if (b == side) return;
    rays_add_quad(&scene, V(-a, -b, -depth), V(0, 0, depth), V(2 * a, 0, 0));
    rays_add_quad(&scene, V(-a, b, -depth), V(0, 0, depth), V(2 * a, 0, 0));
}

/* ---- scenes ---- */

static void hole_shallow(void)
{
    add_well(1.5, 0.4, 0.4, 0.2);
}

static void hole_even(void)
{
    add_well(1.5, 0.4, 0.4, 0.8);
}

static void hole_deep(void)
{
    add_well(1.5, 0.5, 0.5, 2.5);
}

static void hole_wide(void)
{
    add_well(2, 1.2, 1.2, 1);
}

static void slot(void)
{
    add_well(1.5, 0.2, 0.9, 0.5);
}

static void groove(void)
{
    add_well(1.5, 0.3, 1.5, 0.5);
}

static void groove_wide(void)
{
    add_well(2, 1, 2, 0.8);
}

static void valley(void)
{
    rays_add_quad(&scene, V(-1.5, -1.5, 1.5), V(1.5, 0, -1.5), V(0, 3, 0));
    rays_add_quad(&scene, V(1.5, -1.5, 1.5), V(-1.5, 0, -1.5), V(0, 3, 0));
}

static void valley_steep(void)
{
    rays_add_quad(&scene, V(-0.75, -1.5, 1.5), V(0.75, 0, -1.5), V(0, 3, 0));
    rays_add_quad(&scene, V(0.75, -1.5, 1.5), V(-0.75, 0, -1.5), V(0, 3, 0));
}

static void room(void)
{
    rays_add_quad(&scene, V(0, 0, 0), V(2, 0, 0), V(0, 2, 0));
    rays_add_quad(&scene, V(0, 0, 0), V(0, 2, 0), V(0, 0, 2));
    rays_add_quad(&scene, V(0, 0, 0), V(0, 0, 2), V(2, 0, 0));
}

static void step(void)
{
    add_floor(1.5);
    rays_add_box(&scene, V(-1.5, -1.5, 0), V(0, 1.5, 0.3));
}

static void wall(void)
{
    add_floor(1.5);
    rays_add_box(&scene, V(-1.5, 0.5, 0), V(1.5, 1.5, 1.5));
}

static void stairs(void)
{
    for (int i = 0; i < 6; i++)
        rays_add_box(&scene, V(-1.5, -1.5 + 0.5 * i, -0.2), V(1.5, -1.0 + 0.5 * i, 0.25 * i));
}

static void block(void)
{
    add_floor(1.5);
    rays_add_box(&scene, V(-0.6, -0.6, 0), V(0.6, 0.6, 0.7));
}

static void blocks(void)
{
    add_floor(1.5);
    rays_add_box(&scene, V(-1.1, -0.7, 0), V(-0.2, 0.7, 0.6));
    rays_add_box(&scene, V(0.2, -0.7, 0), V(1.1, 0.7, 0.6));
}

static void ball(void)
{
    add_floor(1.5);
    rays_add_sphere(&scene, V(0, 0, 0.6), 0.6);
}

static void balls(void)
{
    for (int i = 0; i < 9; i++)
        rays_add_sphere(&scene, V(i % 3 - 1.0, i / 3 - 1.0, 0), 0.5);
}

static void ball_in_hole(void)
{
    add_well(1.5, 0.7, 0.7, 0.7);
    rays_add_sphere(&scene, V(0, 0, -0.3), 0.4);
}

static void rod(void)
{
    add_floor(1.5);
    add_tube(V(-1.5, 0, 0.2), V(3, 0, 0), 0.2);
}

static void pins(void)
{
    add_floor(1.5);
    for (int i = 0; i < 9; i++) {
        const double x = i % 3 - 1.0, y = i / 3 - 1.0;
        rays_add_box(&scene, V(x - 0.15, y - 0.15, 0), V(x + 0.15, y + 0.15, 0.5));
    }
}

static void rod_in_the_air(void)
{
    add_floor(1.5);
    add_tube(V(-1.5, 0, 1), V(3, 0, 0), 0.1);
}

static void pipes(void)
{
    for (int i = 0; i < 5; i++)
        add_tube(V(-1.5, 0.6 * i - 1.2, 0), V(3, 0, 0), 0.3);
}

/* ---- pictures ---- */

enum { SIDE = 208 };

struct view {
    double elevation, extent; /* degrees; half of the window, in radii */
    double eye;               /* distance of the eye from the origin; 0: rays are parallel */
};

struct axes {
    double right[3], up[3], back[3];
};

static struct axes axes_of(const struct view *view)
{
    const double e = view->elevation * acos(-1.0) / 180, a = view->elevation < 90 ? 0.5 : 0.0;
    return (struct axes){
        {cos(a), sin(a), 0}, {-sin(e) * sin(a), sin(e) * cos(a), cos(e)}, {cos(e) * sin(a), -cos(e) * cos(a), sin(e)}};
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static struct ray ray_at(const struct view *view, const struct axes *axes, double x, double y)
{
    const double far = view->eye > 0 ? view->eye : 20;
    struct ray ray = {.nearest = 0, .farthest = 1e9};
    for (int k = 0; k < 3; k++) {
        const double at = axes->right[k] * x + axes->up[k] * y;
        ray.from[k] = axes->back[k] * far + (view->eye > 0 ? 0 : at);
        ray.along[k] = -axes->back[k] * far + (view->eye > 0 ? at : 0);
    }
    const double length = sqrt(dot(ray.along, ray.along));
    for (int k = 0; k < 3; k++)
        ray.along[k] /= length;
    return ray;
}

/* Finds the point of the scene at a pixel. */
static bool meet(const struct view *view, const struct axes *axes, int pixel, double point[3], double normal[3])
{
    const double scale = 2 * view->extent / SIDE;
    const struct ray ray =
        ray_at(view, axes, (pixel % SIDE + 0.5 - 0.5 * SIDE) * scale, (pixel / SIDE + 0.5 - 0.5 * SIDE) * scale);
    const double distance = rays_first(&scene, &ray, normal);
    for (int k = 0; k < 3; k++)
        point[k] = ray.from[k] + distance * ray.along[k];
    return distance < HUGE_VAL;
}

static void to_eye(const struct axes *axes, const double v[3], double out[3])
{
    out[0] = dot(axes->right, v), out[1] = dot(axes->up, v), out[2] = dot(axes->back, v);
}

static void draw_scene(struct buffer *b, const struct view *view, const struct axes *axes)
{
    for (int i = 0; i < SIDE * SIDE; i++) {
        double point[3], normal[3], eye_point[3], eye_normal[3];
        const bool is_seen = meet(view, axes, i, point, normal);
        to_eye(axes, point, eye_point);
        to_eye(axes, normal, eye_normal);
        eye_point[2] -= view->eye;
        buffer_set(&b->g, i / SIDE * b->g.stride + i % SIDE, is_seen, eye_point, eye_normal);
    }
}

static const float *find(const struct buffer *b, const struct view *view)
{
    static const struct zr_occlusion usual = {true, 0.15f, 1.7f}; /* as in looks */
    const float pixels = (float)(SIDE / (2 * view->extent));
    const struct zr_pixel_scale parallel = {pixels, {0, 0, 0}, 1},
                                from_eye = {pixels * (float)view->eye, {0, 0, -1}, 0};
    const float *light = zr_occlusion_make(&(struct zr_run){.arena = &arena}, &b->g, &usual,
                                           view->eye > 0 ? &from_eye : &parallel, 1.0f / usual.radius);
    assert_non_null(light);
    return light;
}

/* ---- comparison ---- */

static const struct {
    const char *name;
    void (*make)(void);
    struct view view;
    double most; /* root of the mean square difference */
} scenes[] = {
    {"hole_shallow", hole_shallow, {90, 1.8, 0}, 0.004},
    {"hole_even", hole_even, {90, 1.8, 9}, 0.006},
    {"hole_deep", hole_deep, {90, 1.8, 0}, 0.052},
    {"hole_wide", hole_wide, {70, 2.4, 12}, 0.040},
    {"slot", slot, {90, 1.8, 9}, 0.037},
    {"groove", groove, {90, 1.8, 0}, 0.034},
    {"groove_wide", groove_wide, {60, 2.4, 0}, 0.036},
    {"valley", valley, {90, 1.8, 0}, 0.015},
    {"valley_steep", valley_steep, {90, 1.8, 9}, 0.090},
    {"room", room, {35, 2.6, 12}, 0.014},
    {"step", step, {50, 2, 0}, 0.023},
    {"wall", wall, {35, 2.3, 9}, 0.018},
    {"stairs", stairs, {45, 2.3, 0}, 0.032},
    {"block", block, {40, 2.2, 9}, 0.035},
    {"blocks", blocks, {60, 2.2, 0}, 0.060},
    {"ball", ball, {35, 2.2, 9}, 0.041},
    {"balls", balls, {60, 2, 0}, 0.062},
    {"ball_in_hole", ball_in_hole, {75, 2, 9}, 0.054},
    {"rod", rod, {45, 2.2, 0}, 0.046},
    {"pins", pins, {60, 2.2, 9}, 0.067},
    {"rod_in_the_air", rod_in_the_air, {60, 2.2, 9}, 0.066},
    {"pipes", pipes, {60, 2.2, 0}, 0.078},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

/* Compares every 7th pixel along and across. */
static double difference(const struct view *view)
{
    const struct axes axes = axes_of(view);
    struct buffer b = buffer_make(SIDE, SIDE);
    double sum = 0;
    int count = 0;
    draw_scene(&b, view, &axes);
    const float *light = find(&b, view);
    for (int y = 3; y < SIDE; y += 7)
        for (int x = 3; x < SIDE; x += 7) {
            double point[3], normal[3];
            if (!meet(view, &axes, y * SIDE + x, point, normal)) continue;
            const double d = (double)light[y * b.g.stride + x] - rays_open(&scene, point, normal, 1, 12);
            sum += d * d;
            count++;
        }
    buffer_free(&b);
    zr_arena_reset(&arena, SIZE_MAX);
    assert_true(count > 100);
    return sqrt(sum / count);
}

TEST(light_is_that_of_rays)
{
    double sum = 0;
    for (int i = 0; i < SCENES; i++) {
        scene.triangle_count = scene.sphere_count = 0;
        scenes[i].make();
        const double rms = difference(&scenes[i].view);
        print_message("%-16s %.4f\n", scenes[i].name, rms);
        if (!(rms <= scenes[i].most)) fail_msg("%s: %f", scenes[i].name, rms);
        sum += rms;
    }
    print_message("mean %.4f\n", sum / SCENES);
    assert_true(sum <= 0.041 * SCENES);
}

static float light_at_the_bottom(double depth)
{
    const struct view view = {90, 1.8, 0};
    const struct axes axes = axes_of(&view);
    struct buffer b = buffer_make(SIDE, SIDE);
    scene.triangle_count = scene.sphere_count = 0;
    add_well(1.5, 0.2, 0.2, depth);
    draw_scene(&b, &view, &axes);
    const float light = find(&b, &view)[SIDE / 2 * b.g.stride + SIDE / 2];
    buffer_free(&b);
    zr_arena_reset(&arena, SIZE_MAX);
    return light;
}

/* From 0.05 to 3 radii. */
TEST(deeper_holes_are_as_dark_or_darker)
{
    const double up[3] = {0, 0, 1};
    float before = 1;
    for (int i = 1; i <= 60; i++) {
        const double depth = 0.05 * i;
        const float light = light_at_the_bottom(depth);
        const double want = rays_open(&scene, V(0, 0, -depth), up, 1, 40);
        assert_true(light <= before + 0.005f);
        if (!(fabs((double)light - want) <= 0.1)) fail_msg("depth %.2f: %f, rays %f", depth, (double)light, want);
        if (light < before) before = light;
    }
    assert_true(before < 0.15f);
}

/* Convex surfaces hide nothing of themselves. */
TEST(a_lone_sphere_is_light_everywhere)
{
    for (int i = 0; i < 8; i++) {
        const struct view view = {10.0 * i, 1.2, i % 2 ? 5 : 0};
        const struct axes axes = axes_of(&view);
        struct buffer b = buffer_make(SIDE, SIDE);
        scene.triangle_count = scene.sphere_count = 0;
        rays_add_sphere(&scene, V(0, 0, 0), i < 4 ? 1 : 0.2);
        draw_scene(&b, &view, &axes);
        const float *light = find(&b, &view);
        for (int at = 0; at < SIDE * b.g.stride; at++)
            if (at % b.g.stride < SIDE) assert_true(light[at] == 1.0f);
        buffer_free(&b);
        zr_arena_reset(&arena, SIZE_MAX);
    }
}

RUN_TESTS(open_arena, close_arena)
