/* The depth channel of triangles for which a plane is not enough: those that reach behind the camera or to
 * infinity, and slivers, whose samples lie on the subpixel grid but beside the triangle itself. */
#include <math.h>

#include "support/random.h"
#include "support/scenes.h"
#include "support/tests.h"

enum { WIDTH = 320, HEIGHT = 240, PIXELS = WIDTH * HEIGHT };

static struct zr_arena arena;

static const struct zr_frame *render(const zr_vec4 *corners, uint32_t triangles, zr_vec3 eye, zr_vec3 target)
{
    static struct test_scene test;
    scene_of_triangles(&test, WIDTH, HEIGHT, corners, triangles);
    scene_look(&test.scene, (struct zr_view){.pose = ZR_POSE_LOOK_AT,
                                             .eye = eye,
                                             .target = target,
                                             .up = {0, 1, 0},
                                             .projection = ZR_PROJECTION_PERSPECTIVE,
                                             .yfov_radians = 0.75f,
                                             .has_znear = true,
                                             .znear = 0.05f,
                                             .has_zfar = true,
                                             .zfar = 100});
    return scene_render(&arena, NULL, &test.scene);
}

static float ulp(float value)
{
    return nextafterf(value, INFINITY) - value;
}

/* Of two floors in one plane, one ends at infinity. */
TEST(depth_of_a_triangle_with_a_corner_at_infinity_is_that_of_its_plane)
{
    static const zr_vec4 finite[3] = {{-9, 0, 1, 1}, {9, 0, 1, 1}, {0.5f, 0, -90, 1}};
    static const zr_vec4 endless[3] = {{-9, 0, 1, 1}, {9, 0, 1, 1}, {0, 0, -1, 0}};
    const zr_vec3 eye = {0, 0.3f, 0.1f}, target = {0.2f, -0.7f, -2};
    zr_arena_init(&arena, 1 << 25);
    const struct zr_frame *a = render(finite, 1, eye, target), *b = render(endless, 1, eye, target);
    uint32_t both = 0;
    for (uint32_t i = 0; i < PIXELS; i++) {
        if (a->face_id[i] == 0 || b->face_id[i] == 0) continue;
        assert_true(fabsf(a->depth[i] - b->depth[i]) <= ulp(a->depth[i]));
        both++;
    }
    assert_true(both > PIXELS / 2);
    zr_arena_free(&arena);
}

/* Triangles nearly in a plane through the eye, all around its axis. */
static void make_slivers(struct random *random, double nearest, double farthest, zr_vec4 *corners, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double x = random_range(random, -1, 1), y = random_range(random, -1, 1);
        for (int k = 0; k < 3; k++) {
            double along = random_range(random, -1, 1), aside = random_range(random, -1e-5, 1e-5);
            corners[3 * i + (uint32_t)k] = (zr_vec4){(float)(along * x + aside * y), (float)(along * y - aside * x),
                                                     (float)-random_range(random, nearest, farthest), 1};
        }
    }
}

static void assert_slivers_stay(double nearest, double farthest, float low, float high)
{
    enum { SLIVERS = 4000 };
    struct random random = random_seeded(5);
    static zr_vec4 corners[3 * SLIVERS];
    zr_arena_init(&arena, 1 << 25);
    make_slivers(&random, nearest, farthest, corners, SLIVERS);
    const struct zr_frame *frame = render(corners, SLIVERS, (zr_vec3){0, 0, 0}, (zr_vec3){0, 0, -1});
    uint32_t seen = 0;
    for (uint32_t i = 0; i < PIXELS; i++) {
        if (frame->face_id[i] == 0) continue;
        if (!(frame->depth[i] >= low && frame->depth[i] <= high)) fail_msg("depth %.9g", (double)frame->depth[i]);
        seen++;
    }
    if (seen < 400) fail_msg("only %u pixels seen", (unsigned)seen);
    zr_arena_free(&arena);
}

TEST(depth_of_slivers_stays_between_their_corners)
{
    assert_slivers_stay(0.5, 3.0, 0.5f, 3.0f);
}

/* The part behind the camera is no part of what is seen: half the distance of the near plane is the least. */
TEST(depth_of_slivers_that_go_on_behind_the_camera_stays_in_front_of_it)
{
    assert_slivers_stay(-2.0, 3.0, 0.0249f, 4.5f);
}

RUN_TESTS(NULL, NULL)
