#include <math.h>
#include <string.h>

#include "base/run.h"
#include "scene/camera/camera.h"
#include "scene/camera/resolved_view.h"
#include "support/scenes.h"
#include "support/tests.h"

/* A box from (-1, -2, -3) to (3, 2, 1), as 4 triangles that touch all its corners. */
static const zr_vec4 BOX[] = {{-1, -2, -3, 1}, {3, -2, -3, 1}, {3, 2, -3, 1}, {-1, 2, -3, 1},
                              {-1, -2, 1, 1},  {3, -2, 1, 1},  {3, 2, 1, 1},  {-1, 2, 1, 1},
                              {3, 2, 1, 1},    {-1, 2, -3, 1}, {3, -2, 1, 1}, {3, -2, -3, 1}};

static struct test_scene *box_scene(void)
{
    static struct test_scene test;
    scene_of_triangles(&test, 400, 200, BOX, 4);
    scene_look(&test.scene, (struct zr_view){.pose = ZR_POSE_PRESET,
                                             .preset = ZR_PRESET_FRONT,
                                             .up = {0, 1, 0},
                                             .projection = ZR_PROJECTION_ORTHOGRAPHIC,
                                             .yfov_radians = 0.8f,
                                             .fit_padding = 0.05f});
    return &test;
}

static struct zr_camera resolve(const struct test_scene *test)
{
    struct zr_camera camera;
    struct zr_error error = {.count = 0};
    struct zr_bounds bounds = zr_bounds_of(&test->scene, NULL, NULL);
    assert_int_equal(
        zr_camera_resolve(&(struct zr_run){.error = &error}, &test->scene, &test->scene.views[0], &bounds, &camera),
        ZR_OK);
    return camera;
}

static zr_vec4 to_clip(const struct zr_camera *camera, zr_vec4 p)
{
    return zr_mat4_apply(&camera->projection, zr_mat4_apply(&camera->world_to_eye, p));
}

TEST(bounds_hold_every_point_but_those_at_infinity)
{
    zr_vec4 points[3] = {{2, 4, 6, 2}, {5, 5, 5, 0}, {-1, 0, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 10, 10, points, 1);
    struct zr_bounds bounds = zr_bounds_of(&test.scene, NULL, NULL);
    assert_true(bounds.valid);
    assert_true(bounds.min.x == -1 && bounds.max.x == 1 && bounds.max.y == 2 && bounds.max.z == 3);
}

TEST(look_at_without_direction_or_up_is_refused)
{
    struct test_scene *test = box_scene();
    struct zr_view *view = &test->scene.views[0];
    struct zr_bounds bounds = zr_bounds_of(&test->scene, NULL, NULL);
    struct zr_camera camera;
    struct zr_error error = {.count = 0};
    view->pose = ZR_POSE_LOOK_AT;
    view->eye = view->target = (zr_vec3){1, 2, 3};
    assert_int_equal(
        zr_camera_resolve(&(struct zr_run){.error = &error}, &test->scene, &test->scene.views[0], &bounds, &camera),
        ZR_BAD_SCENE);
    assert_string_equal(error.items[0].pointer, "/view/eye");
    error.count = 0;
    view->eye = (zr_vec3){1, 9, 3};
    assert_int_equal(
        zr_camera_resolve(&(struct zr_run){.error = &error}, &test->scene, &test->scene.views[0], &bounds, &camera),
        ZR_BAD_SCENE);
    assert_string_equal(error.items[0].pointer, "/view/up");
}

TEST(depth_range_given_is_kept_and_one_turned_round_is_refused)
{
    struct test_scene *test = box_scene();
    struct zr_view *view = &test->scene.views[0];
    view->has_znear = view->has_zfar = true;
    view->znear = 0.5f;
    view->zfar = 100.0f;
    struct zr_camera camera = resolve(test);
    assert_true(camera.znear == 0.5f && camera.zfar == 100.0f);
    view->znear = 200.0f;
    struct zr_bounds bounds = zr_bounds_of(&test->scene, NULL, NULL);
    struct zr_error error = {.count = 0};
    assert_int_equal(
        zr_camera_resolve(&(struct zr_run){.error = &error}, &test->scene, &test->scene.views[0], &bounds, &camera),
        ZR_BAD_SCENE);
}

TEST(eye_inside_or_before_the_geometry_still_gives_a_camera)
{
    struct test_scene *test = box_scene();
    struct zr_view *view = &test->scene.views[0];
    view->pose = ZR_POSE_LOOK_AT;
    view->projection = ZR_PROJECTION_PERSPECTIVE;
    view->target = (zr_vec3){1, 0, -9};
    const float eyes[] = {0.0f, -8.0f, -3.0f, 1.0f};
    for (int i = 0; i < 4; i++) {
        view->eye = (zr_vec3){1, 0, eyes[i]};
        struct zr_camera camera = resolve(test);
        assert_true(camera.znear > 0.0f && camera.zfar > camera.znear);
        for (int k = 0; k < 16; k++)
            assert_true(isfinite(camera.projection.m[k]));
    }
}

TEST(view_beyond_the_range_of_numbers_is_refused)
{
    struct test_scene *test = box_scene();
    struct zr_view *view = &test->scene.views[0];
    struct zr_bounds bounds = zr_bounds_of(&test->scene, NULL, NULL);
    for (int i = 0; i < 2; i++) {
        struct zr_camera camera;
        struct zr_error error = {.count = 0};
        view->projection = i ? ZR_PROJECTION_PERSPECTIVE : ZR_PROJECTION_ORTHOGRAPHIC;
        view->xmag = view->ymag = 1e-40f;
        view->yfov_radians = 1e-42f;
        assert_int_equal(
            zr_camera_resolve(&(struct zr_run){.error = &error}, &test->scene, &test->scene.views[0], &bounds, &camera),
            ZR_BAD_SCENE);
        assert_string_equal(error.items[0].pointer, "/view");
    }
}

TEST(point_as_good_as_at_infinity_leaves_the_bounds_finite)
{
    const zr_vec4 points[3] = {{1, 2, 3, 1}, {1, 1, 1, 1e-40f}, {-1, 0, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 10, 10, points, 1);
    struct zr_bounds bounds = zr_bounds_of(&test.scene, NULL, NULL);
    assert_true(bounds.max.x == 1 && bounds.max.y == 2 && bounds.max.z == 3);
}

/* Rounding to float moves what is far from the origin: a fitted view must still show it. */
TEST(fit_shows_small_flat_things_far_from_the_origin)
{
    const float places[][2] = {{30000, 10},     {30411, 10}, {308220, 100}, {1027.4f, 0.1f},
                               {1041.1f, 0.1f}, {10000, 1},  {999000, 100}};
    static struct test_scene test;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        for (int preset = 0; preset < ZR_PRESET_COUNT; preset++)
            for (int projection = 0; projection < 3; projection++) {
                float o = places[i][0], s = places[i][1];
                /* Square to the axis that the preset looks along; for isometric, to z. */
                bool along_x = preset == ZR_PRESET_LEFT || preset == ZR_PRESET_RIGHT;
                bool along_y = preset == ZR_PRESET_TOP || preset == ZR_PRESET_BOTTOM;
                zr_vec4 p[6];
                const float corners[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
                for (int k = 0; k < 6; k++) {
                    float u = o + s * corners[k][0], v = o + s * corners[k][1];
                    p[k] = along_x ? (zr_vec4){o, u, v, 1} : along_y ? (zr_vec4){u, o, v, 1} : (zr_vec4){u, v, o, 1};
                }
                scene_of_triangles(&test, 64, 64, p, 2);
                scene_look(&test.scene, (struct zr_view){.pose = ZR_POSE_PRESET,
                                                         .preset = (enum zr_preset)preset,
                                                         .yfov_radians = 0.8f,
                                                         .fit_padding = 0.05f,
                                                         .intrinsics = {100, 90, 10, true, true, -20, 40},
                                                         .projection = (enum zr_projection)projection});
                const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
                assert_int_equal(frame->counts.outside, 0);
                assert_true(frame->covered_pixels > 1000); /* of 4096; a square seen askew fills the least */
                zr_arena_reset(&arena, 1 << 24);
            }
    zr_arena_free(&arena);
}

TEST(up_may_be_of_any_length)
{
    struct test_scene *test = box_scene();
    struct zr_view *view = &test->scene.views[0];
    view->pose = ZR_POSE_LOOK_AT;
    view->eye = (zr_vec3){5, 6, 7};
    struct zr_camera want = resolve(test);
    view->up = (zr_vec3){0, 1e-30f, 0};
    struct zr_camera got = resolve(test);
    for (int i = 0; i < 16; i++)
        assert_true(fabsf(want.world_to_eye.m[i] - got.world_to_eye.m[i]) < 1e-6f);
}

TEST(one_single_point_still_gives_a_camera)
{
    const zr_vec4 points[3] = {{7, 7, 7, 1}, {7, 7, 7, 1}, {7, 7, 7, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 10, 10, points, 1);
    for (int projection = 0; projection < 2; projection++) {
        scene_look(&test.scene,
                   (struct zr_view){.pose = ZR_POSE_PRESET,
                                    .preset = ZR_PRESET_ISOMETRIC,
                                    .yfov_radians = 0.7f,
                                    .projection = projection ? ZR_PROJECTION_PERSPECTIVE : ZR_PROJECTION_ORTHOGRAPHIC});
        struct zr_camera camera = resolve(&test);
        zr_vec4 p = to_clip(&camera, points[0]);
        assert_true(p.w > 0.0f && fabsf(p.x) < 1e-5f && fabsf(p.z) <= p.w);
    }
}

RUN_TESTS(NULL, NULL)
