/* The depth channel against the analytic depth: 4 ulp of a float are promised, 1 is kept.
 *
 * The truth is where the sample's ray meets the plane of the triangle that owns it, in double from
 * the very floats of corners, matrices and camera. Samples are covered on a grid of 1/256 pixel, so
 * the ray of a few misses its triangle by less than that: their depth must be one that the triangle has. */
#include <math.h>
#include <string.h>

#include "geometry/triangulate.h"
#include "support/cmocka_all.h"
#include "support/scenes.h"

enum { BALL_GRID = 18, BALL_TRIANGLES = 6 * BALL_GRID * BALL_GRID * 2 };

static const double SUBPIXEL = 1.0 / 256.0;

/* ---- the truth ---- */

struct place {
    double eye[3];    /* eye space */
    double window[3]; /* x, y in pixels with row 0 on top, and 1, all times w of clip space */
};

struct ray {
    double from[3], along[3]; /* eye space; along z it goes -1, so that its parameter is the depth */
};

static void apply(const zr_mat4 *matrix, const double in[4], double out[4])
{
    for (int r = 0; r < 4; r++) {
        out[r] = 0.0;
        for (int c = 0; c < 4; c++)
            out[r] += (double)matrix->m[4 * c + r] * in[c];
    }
}

static struct place place_of(const struct zr_frame *frame, const zr_mat4 *object_to_world, zr_vec4 corner)
{
    const double object[4] = {(double)corner.x, (double)corner.y, (double)corner.z, (double)corner.w};
    double world[4], eye[4], clip[4];
    apply(object_to_world, object, world);
    apply(&frame->camera.world_to_eye, world, eye);
    apply(&frame->camera.projection, eye, clip);
    return (struct place){
        {eye[0] / eye[3], eye[1] / eye[3], eye[2] / eye[3]},
        {0.5 * (double)frame->width * (clip[3] + clip[0]), 0.5 * (double)frame->height * (clip[3] - clip[1]), clip[3]}};
}

/* Through the centre of a pixel, row 0 on top: the projection matrix turned round. */
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

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* To the plane of three corners. */
static double analytic_depth(const struct place corners[3], const struct ray *ray)
{
    double side[2][3], normal[3], way[3];
    for (int r = 0; r < 3; r++) {
        side[0][r] = corners[1].eye[r] - corners[0].eye[r];
        side[1][r] = corners[2].eye[r] - corners[0].eye[r];
        way[r] = corners[0].eye[r] - ray->from[r];
    }
    cross(side[0], side[1], normal);
    return dot(normal, way) / dot(normal, ray->along);
}

/* How far inside the triangle the centre of a pixel lies, in pixels; below 0 how far beyond a side. Corners
 * may be behind the eye. */
static double margin_of(const struct place corners[3], uint32_t column, uint32_t row)
{
    const double sample[3] = {(double)column + 0.5, (double)row + 0.5, 1.0};
    double least = HUGE_VAL, side[3];
    for (int k = 0; k < 3; k++) {
        cross(corners[k].window, corners[(k + 1) % 3].window, side);
        double turn = dot(side, corners[(k + 2) % 3].window);
        least = fmin(least, copysign(1.0, turn) * dot(side, sample) / hypot(side[0], side[1]));
    }
    return least;
}

static double ulp(double value)
{
    float f = fabsf((float)value);
    return (double)nextafterf(f, INFINITY) - (double)f;
}

/* ---- a picture against the truth ---- */

/* What is drawn: triangles, each a face of its own or all of them the parts of one plane face. */
struct body {
    const zr_vec4 *corners;
    uint32_t triangles;
    bool one_face;
    const struct zr_instance *instances; /* those of the scene that have faces */
};

static void assert_among_corners(double depth, const struct place corners[3])
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        if (!(corners[k].window[2] > 0.0)) return;
        low = fmin(low, -corners[k].eye[2]);
        high = fmax(high, -corners[k].eye[2]);
    }
    assert_true(depth >= low - ulp(low) && depth <= high + ulp(high));
}

/* Whether the ray meets the triangle that owns the pixel. */
static bool check_pixel(const struct zr_frame *frame, const struct body *body, uint32_t pixel)
{
    uint32_t column = pixel % frame->width, row = pixel / frame->width;
    uint32_t faces = body->one_face ? 1 : body->triangles, number = frame->face_id[pixel] - 1;
    uint32_t first = body->one_face ? 0 : number % faces, end = body->one_face ? body->triangles : first + 1;
    const zr_mat4 *object_to_world = &body->instances[number / faces].object_to_world;
    struct place owner[3] = {{{0}, {0}}}, corners[3];
    double margin = -HUGE_VAL;
    for (uint32_t t = first; t < end; t++) {
        for (int k = 0; k < 3; k++)
            corners[k] = place_of(frame, object_to_world, body->corners[3 * t + (uint32_t)k]);
        double m = margin_of(corners, column, row);
        if (m < margin) continue;
        margin = m;
        memcpy(owner, corners, sizeof owner);
    }
    double depth = (double)frame->depth[pixel];
    /* Of one face's triangles, the owner is known only away from its sides. */
    if (margin < (body->one_face ? SUBPIXEL : 0.0)) {
        if (margin < -SUBPIXEL)
            fail_msg("%u, %u: %g pixels beyond its triangle", (unsigned)column, (unsigned)row, -margin);
        if (!body->one_face) assert_among_corners(depth, owner);
        return false;
    }
    struct ray ray = ray_through(frame, column, row);
    double want = analytic_depth(owner, &ray), off = fabs(depth - want) / ulp(want);
    if (!(off <= 1.0))
        fail_msg("%u, %u: %.9g is %.2f ulp from %.12g", (unsigned)column, (unsigned)row, depth, off, want);
    return true;
}

/* ---- from all cameras ---- */

struct look {
    zr_vec3 eye, target;
    float half_height; /* of the orthographic camera's window */
    float znear;       /* 0: fitted */
    bool clips;
};

static struct zr_view view_of(const struct look *look, enum zr_projection projection, double side)
{
    return (struct zr_view){.pose = ZR_POSE_LOOK_AT,
                            .eye = look->eye,
                            .target = look->target,
                            .up = {0, 1, 0},
                            .projection = projection,
                            .xmag = look->half_height * 1.3f,
                            .ymag = look->half_height,
                            .yfov_radians = 0.75f,
                            .has_znear = look->znear > 0.0f,
                            .znear = look->znear,
                            .intrinsics = {side * 0.9, side * 0.95, side * 0.01, true, true, side * 0.45, side * 0.4}};
}

/* In each of three cameras and two windows. */
static void assert_depths(struct test_scene *test, const struct body *body, const struct look *look)
{
    static const uint32_t windows[][2] = {{97, 71}, {480, 360}};
    static const enum zr_projection projections[] = {ZR_PROJECTION_ORTHOGRAPHIC, ZR_PROJECTION_PERSPECTIVE,
                                                     ZR_PROJECTION_INTRINSICS};
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 27);
    for (int i = 0; i < 6; i++) {
        uint32_t seen = 0, met = 0;
        test->scene.views[0].width = windows[i / 3][0];
        test->scene.views[0].height = windows[i / 3][1];
        scene_look(&test->scene, view_of(look, projections[i % 3], (double)test->scene.views[0].width));
        const struct zr_frame *frame = scene_render(&arena, NULL, &test->scene);
        for (uint32_t pixel = 0; pixel < frame->width * frame->height; pixel++) {
            if (frame->face_id[pixel] == 0) continue;
            met += check_pixel(frame, body, pixel);
            seen++;
        }
        assert_true(seen > frame->width * frame->height / 8);
        assert_true((seen - met) * 50 < seen);
        if (look->clips) assert_true(frame->counts.drawn_pieces > 0);
        zr_arena_reset(&arena, 1 << 27);
    }
    zr_arena_free(&arena);
}

static void assert_depths_of_triangles(const zr_vec4 *corners, uint32_t triangles, const struct look *look)
{
    static struct test_scene test;
    const struct body body = {corners, triangles, false, &test.instance};
    scene_of_triangles(&test, 1, 1, corners, triangles);
    assert_depths(&test, &body, look);
}

/* ---- planes ---- */

/* Two triangles between four points. */
static void quad(const zr_vec4 points[4], zr_vec4 *corners)
{
    static const int order[6] = {0, 1, 2, 0, 2, 3};
    for (int k = 0; k < 6; k++)
        corners[k] = points[order[k]];
}

static void depth_of_a_tilted_quad_is_analytic(void **state)
{
    (void)state;
    zr_vec4 corners[6];
    const struct look look = {.eye = {0.4f, 0.3f, 2.9f}, .half_height = 1.2f};
    quad((const zr_vec4[4]){{-1, -1, -0.95f, 1}, {1, -1, -0.25f, 1}, {1, 1, 0.95f, 1}, {-1, 1, 0.25f, 1}}, corners);
    assert_depths_of_triangles(corners, 2, &look);
}

/* The laths of a blind, at 85 degrees from facing the camera. */
static void depth_of_grazing_planes_is_analytic(void **state)
{
    (void)state;
    enum { LATHS = 8 };
    zr_vec4 corners[6 * LATHS];
    const struct look look = {.eye = {0.1f, 0.07f, 4}, .half_height = 1.2f};
    const float half = 0.125f, deep = half * 11.430052f; /* times tan 85 degrees */
    for (int i = 0; i < LATHS; i++) {
        float y = -1 + half * (float)(2 * i + 1);
        const zr_vec4 points[4] = {
            {-1, y - half, -deep, 1}, {1, y - half, -deep, 1}, {1, y + half, deep, 1}, {-1, y + half, deep, 1}};
        quad(points, corners + 6 * i);
    }
    assert_depths_of_triangles(corners, 2 * LATHS, &look);
}

static void depth_of_a_floor_that_goes_on_behind_the_camera_is_analytic(void **state)
{
    (void)state;
    zr_vec4 corners[6];
    const struct look look = {
        .eye = {0, 0.3f, 0.1f}, .target = {0.2f, -0.7f, -2}, .half_height = 0.8f, .znear = 0.05f, .clips = true};
    quad((const zr_vec4[4]){{-20, 0, 15, 1}, {20, 0.1f, 15, 1}, {20, -0.1f, -30, 1}, {-20, 0, -30, 1}}, corners);
    assert_depths_of_triangles(corners, 2, &look);
}

/* ---- balls ---- */

/* Of the unit sphere, a point of one side of the cube around it. Points count as well in multiples. */
static zr_vec4 ball_point(int side, int column, int row, float w)
{
    double c[3], x = 2.0 * column / BALL_GRID - 1.0, y = 2.0 * row / BALL_GRID - 1.0;
    double length = sqrt(x * x + y * y + 1.0), way = side < 3 ? 1.0 : -1.0;
    c[side % 3] = way / length;
    c[(side + 1) % 3] = way * x / length;
    c[(side + 2) % 3] = y / length;
    return (zr_vec4){(float)c[0] * w, (float)c[1] * w, (float)c[2] * w, w};
}

/* All around; every other cell has its corners at w. */
static const zr_vec4 *make_ball(float w)
{
    static zr_vec4 corners[3 * BALL_TRIANGLES];
    zr_vec4 *next = corners;
    for (int cell = 0; cell < 6 * BALL_GRID * BALL_GRID; cell++, next += 6) {
        int side = cell / (BALL_GRID * BALL_GRID), row = cell / BALL_GRID % BALL_GRID, column = cell % BALL_GRID;
        float factor = cell % 2 ? w : 1.0f;
        const zr_vec4 points[4] = {ball_point(side, column, row, factor), ball_point(side, column + 1, row, factor),
                                   ball_point(side, column + 1, row + 1, factor),
                                   ball_point(side, column, row + 1, factor)};
        quad(points, next);
    }
    return corners;
}

static void depth_of_a_whole_sphere_is_analytic_up_to_its_silhouette(void **state)
{
    (void)state;
    const struct look look = {.eye = {0.3f, 0.2f, 3.1f}, .half_height = 1.2f};
    assert_depths_of_triangles(make_ball(1), BALL_TRIANGLES, &look);
}

/* ---- a face that is not convex ---- */

/* An L with a window in it, in the plane z = x / 2 - y / 4, in which its corners are exactly. */
static void depth_of_a_tilted_face_with_a_dent_and_a_hole_is_analytic(void **state)
{
    (void)state;
    enum { CORNERS = 10, RINGS = 2 };
    static const float places[CORNERS][2] = {{-1.25f, -1}, {1, -1},      {1, 0.25f}, {-0.25f, 0.25f}, {-0.25f, 1},
                                             {-1.25f, 1},  {-1, -0.75f}, {-1, 0.5f}, {-0.5f, 0.5f},   {-0.5f, -0.75f}};
    static const uint32_t face_rings[] = {0, RINGS}, face_offsets[] = {0, CORNERS}, rings[] = {0, 6, CORNERS};
    static struct test_scene test;
    struct zr_triangulator scratch = {.node_capacity = 0};
    struct zr_arena arena;
    zr_vec4 points[CORNERS], corners[3 * CORNERS];
    uint32_t triangles[CORNERS][3];
    zr_arena_init(&arena, 1 << 20);
    for (int i = 0; i < CORNERS; i++)
        points[i] = (zr_vec4){places[i][0], places[i][1], 0.5f * places[i][0] - 0.25f * places[i][1], 1};
    assert_true(zr_triangulator_reserve(&arena, &scratch, CORNERS, RINGS));
    uint32_t count = zr_triangulate(&scratch, points, rings, RINGS, triangles);
    for (uint32_t i = 0; i < 3 * count; i++)
        corners[i] = points[triangles[i / 3][i % 3]];
    zr_arena_free(&arena);

    const struct body body = {corners, count, true, &test.instance};
    const struct look looks[2] = {{.eye = {0.3f, 0.2f, 3.1f}, .half_height = 1.2f},
                                  {.eye = {0.1f, 0.9f, 1.1f}, .half_height = 0.6f, .znear = 0.9f, .clips = true}};
    scene_of_triangles(&test, 1, 1, points, (CORNERS + 2) / 3); /* for the indices */
    test.mesh.position_count = CORNERS;
    test.mesh.face_count = 1;
    test.mesh.face_offsets = face_offsets;
    test.mesh.face_rings = face_rings;
    test.mesh.ring_offsets = rings;
    test.instance.object_to_world =
        (zr_mat4){{0.8f, 0.3f, -0.2f, 0, -0.35f, 0.9f, 0.5f, 0, 0.1f, -0.3f, 1.1f, 0, 0.05f, -0.1f, 0.2f, 1}};
    for (int i = 0; i < 2; i++)
        assert_depths(&test, &body, &looks[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(depth_of_a_tilted_quad_is_analytic),
        cmocka_unit_test(depth_of_grazing_planes_is_analytic),
        cmocka_unit_test(depth_of_a_floor_that_goes_on_behind_the_camera_is_analytic),
        cmocka_unit_test(depth_of_a_whole_sphere_is_analytic_up_to_its_silhouette),
        cmocka_unit_test(depth_of_a_tilted_face_with_a_dent_and_a_hole_is_analytic),
    };
    return cmocka_run_group_tests_name("depth", tests, NULL, NULL);
}
