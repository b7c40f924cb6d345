/* The depth channel against the analytic depth: to 4 ulp of a float.
 *
 * What is left of an error is the rounding of a corner's place in the window, by about an ulp of
 * the window's size; on a surface that the ray meets at the angle a from its normal that moves the
 * depth by about 1 + tan a ulp. So no surface here is met at more than 75 degrees, sizes and
 * distances are of order 1, and no triangle is a sliver. */
#include <math.h>

#include "support/cmocka_all.h"
#include "support/scenes.h"

enum { GRID = 24, CORNERS_MAX = GRID * GRID * 6 };

struct ray {
    double from[3], along[3]; /* eye space; along z it goes -1, so that its parameter is the depth */
};

/* Through the centre of a pixel, row 0 on top: the projection matrix turned round, in double. */
static struct ray ray_through(const struct zr_frame *frame, uint32_t column, uint32_t row)
{
    const float *p = frame->camera.projection.m;
    double x = ((double)column + 0.5) * 2.0 / (double)frame->width - 1.0;
    double y = 1.0 - ((double)row + 0.5) * 2.0 / (double)frame->height;
    if (p[11] == 0.0f)
        return (struct ray){{(x - (double)p[12]) / (double)p[0], (y - (double)p[13]) / (double)p[5], 0}, {0, 0, -1}};
    double up = (y + (double)p[9]) / (double)p[5];
    return (struct ray){{0, 0, 0}, {(x + (double)p[8] - (double)p[4] * up) / (double)p[0], up, -1}};
}

/* To the plane of three corners, in double from the very floats of the corners and the camera. */
static double analytic_depth(const struct zr_frame *frame, const zr_vec4 corners[3], const struct ray *ray)
{
    const float *m = frame->camera.world_to_eye.m;
    double e[3][3];
    for (int k = 0; k < 3; k++)
        for (int r = 0; r < 3; r++)
            e[k][r] = (double)m[r] * (double)corners[k].x + (double)m[4 + r] * (double)corners[k].y +
                      (double)m[8 + r] * (double)corners[k].z + (double)m[12 + r];
    double above = 0.0, below = 0.0;
    for (int r = 0; r < 3; r++) {
        int s = (r + 1) % 3, t = (r + 2) % 3;
        double normal = (e[1][s] - e[0][s]) * (e[2][t] - e[0][t]) - (e[1][t] - e[0][t]) * (e[2][s] - e[0][s]);
        above += normal * (e[0][r] - ray->from[r]);
        below += normal * ray->along[r];
    }
    return above / below;
}

static double ulp(double value)
{
    float f = (float)value;
    return (double)nextafterf(f, INFINITY) - (double)f;
}

static void assert_depths(const zr_vec4 *corners, uint32_t triangles, zr_vec3 eye)
{
    static const uint32_t windows[][2] = {{97, 71}, {640, 480}};
    static const enum zr_projection projections[] = {ZR_PROJECTION_ORTHOGRAPHIC, ZR_PROJECTION_PERSPECTIVE,
                                                     ZR_PROJECTION_INTRINSICS};
    static struct test_scene test;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 27);
    for (int i = 0; i < 6; i++) {
        const uint32_t *window = windows[i / 3];
        double side = (double)window[0];
        scene_of_triangles(&test, window[0], window[1], corners, triangles);
        test.scene.view = (struct zr_view){.pose = ZR_POSE_LOOK_AT,
                                           .eye = eye,
                                           .up = {0, 1, 0},
                                           .projection = projections[i % 3],
                                           .xmag = 1.6f,
                                           .ymag = 1.2f,
                                           .yfov_radians = 0.75f,
                                           .intrinsics = {.fx = side * 0.9,
                                                          .fy = side * 0.95,
                                                          .skew = side * 0.01,
                                                          .has_cx = true,
                                                          .has_cy = true,
                                                          .cx = side * 0.45,
                                                          .cy = side * 0.4}};
        const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
        uint32_t seen = 0;
        for (uint32_t pixel = 0; pixel < window[0] * window[1]; pixel++) {
            if (frame->face_id[pixel] == 0) continue;
            struct ray ray = ray_through(frame, pixel % window[0], pixel / window[0]);
            double want = analytic_depth(frame, &corners[3 * (frame->face_id[pixel] - 1)], &ray);
            double off = fabs((double)frame->depth[pixel] - want) / ulp(want);
            if (!(off <= 4.0))
                fail_msg("projection %d: %.9g is %.2f ulp from %.12g", i, (double)frame->depth[pixel], off, want);
            seen++;
        }
        assert_true(seen > window[0] * window[1] / 8);
        zr_arena_reset(&arena, 1 << 27);
    }
    zr_arena_free(&arena);
}

/* Two triangles for each cell of a grid of (count + 1) x (count + 1) points. */
static uint32_t triangles_of_grid(int count, zr_vec4 (*point)(int column, int row), zr_vec4 *corners)
{
    static const int order[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    uint32_t used = 0;
    for (int row = 0; row < count; row++)
        for (int column = 0; column < count; column++)
            for (int k = 0; k < 6; k++)
                corners[used++] = point(column + order[k][0], row + order[k][1]);
    return used / 3;
}

static zr_vec4 facing_point(int column, int row)
{
    return (zr_vec4){(float)(2 * column - 1), (float)(2 * row - 1), -0.3f, 1};
}

static zr_vec4 tilted_point(int column, int row)
{
    float x = (float)(2 * column - 1), y = (float)(2 * row - 1);
    return (zr_vec4){x, y, 0.35f * x + 0.6f * y, 1};
}

/* Of the unit sphere, the part around +z up to 48 degrees: the middle of a cube's side, blown up. */
static zr_vec4 sphere_point(int column, int row)
{
    double x = 0.8 * (2.0 * column / GRID - 1.0), y = 0.8 * (2.0 * row / GRID - 1.0),
           length = sqrt(x * x + y * y + 1.0);
    return (zr_vec4){(float)(x / length), (float)(y / length), (float)(1.0 / length), 1};
}

static void depth_of_a_plane_that_faces_the_camera_is_analytic(void **state)
{
    (void)state;
    zr_vec4 corners[6];
    assert_depths(corners, triangles_of_grid(1, facing_point, corners), (zr_vec3){0, 0, 2.7f});
}

static void depth_of_a_tilted_quad_is_analytic(void **state)
{
    (void)state;
    zr_vec4 corners[6];
    assert_depths(corners, triangles_of_grid(1, tilted_point, corners), (zr_vec3){0.4f, 0.3f, 2.9f});
}

static void depth_of_a_sphere_of_triangles_is_analytic(void **state)
{
    (void)state;
    static zr_vec4 corners[CORNERS_MAX];
    assert_depths(corners, triangles_of_grid(GRID, sphere_point, corners), (zr_vec3){0.3f, 0.2f, 3.1f});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(depth_of_a_plane_that_faces_the_camera_is_analytic),
        cmocka_unit_test(depth_of_a_tilted_quad_is_analytic),
        cmocka_unit_test(depth_of_a_sphere_of_triangles_is_analytic),
    };
    return cmocka_run_group_tests_name("depth", tests, NULL, NULL);
}
