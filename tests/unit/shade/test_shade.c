/* From visibility to channels, and the pipeline as a whole. */
#include <math.h>
#include <string.h>

#include "base/run.h"
#include "geometry/build.h"
#include "raster/binned_scene.h"
#include "scene/camera/resolved_view.h"
#include "shade/paint.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/tests.h"

TEST(depth_of_slivers_stays_between_their_vertices)
{
    static zr_vec4 p[300];
    for (int i = 0; i < 100; i++) {
        float y = -1.0f + 0.02f * (float)i;
        p[3 * i] = (zr_vec4){-1, y, -0.5f, 1};
        p[3 * i + 1] = (zr_vec4){1, y + 1e-3f * (float)(i % 7), -0.2f, 1};
        p[3 * i + 2] = (zr_vec4){0.1f, y + 6e-4f * (float)(i % 7), -0.9f, 1};
    }
    static struct test_scene test;
    scene_of_triangles(&test, 1000, 1000, p, 100);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 27);
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    int seen = 0;
    for (int i = 0; i < 1000 * 1000; i++) {
        if (frame->face_id[i] == 0) continue;
        assert_true(frame->depth[i] >= 0.2f && frame->depth[i] <= 0.9f);
        seen++;
    }
    assert_true(seen > 100);
    zr_arena_free(&arena);
}

/* Of a view that is fitted, from a resolved that was found before or while it is drawn; the resolved is what decides.
 */
TEST(picture_is_that_of_its_view)
{
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {3, -1, 1, 1}, {-1, 3, 2, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 64, 48, p, 1);
    scene_look(&test.scene, (struct zr_view){.pose = ZR_POSE_PRESET, .preset = ZR_PRESET_FRONT, .yfov_radians = 0.5f});
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    struct zr_error error = {.count = 0};
    const struct zr_resolved_view *resolved;
    const struct zr_frame *found_before, *found_by_it, *narrow;
    assert_int_equal(zr_resolved_view_find(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, &resolved),
                     ZR_OK);
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, resolved, &found_before), ZR_OK);
    assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, NULL, &found_by_it),
                     ZR_OK);
    assert_memory_equal(found_before->color, found_by_it->color, 64 * 48 * 4);
    assert_memory_equal(&found_before->camera, &found_by_it->camera, sizeof resolved->camera);
    assert_memory_equal(&found_before->bounds.min, &found_by_it->bounds.min, sizeof(zr_vec3));
    assert_true(found_by_it->bounds.valid && found_by_it->covered_pixels > 200);
    struct zr_resolved_view narrowed = *resolved;
    narrowed.camera.projection.m[0] *= 0.5f;
    assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, &narrowed, &narrow),
                     ZR_OK);
    assert_true(narrow->covered_pixels < found_by_it->covered_pixels * 3 / 4);
    /* Requested bounds are returned even if the view needs none. */
    const struct zr_output info = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    scene_look(&test.scene, (struct zr_view){.pose = ZR_POSE_MATRIX,
                                             .world_to_camera = zr_mat4_identity(),
                                             .projection = ZR_PROJECTION_MATRIX,
                                             .projection_matrix = zr_mat4_identity()});
    assert_int_equal(zr_resolved_view_find(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, &resolved),
                     ZR_OK);
    assert_false(resolved->bounds.valid);
    test.scene.views[0].outputs = &info;
    test.scene.views[0].output_count = 1;
    assert_int_equal(zr_resolved_view_find(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, &resolved),
                     ZR_OK);
    assert_true(resolved->bounds.valid && resolved->bounds.max.x == 3.0f && resolved->bounds.max.z == 2.0f);
    zr_arena_free(&arena);
}

TEST(render_that_is_cancelled_says_so)
{
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
    static struct test_scene test;
    scene_of_triangles(&test, 64, 64, p, 1);
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 24);
    struct zr_cancel cancel = {.raised = true};
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    assert_int_equal(
        zr_render(&(struct zr_run){.arena = &arena, .cancel = &cancel, .error = &error}, &test.scene, NULL, &frame),
        ZR_CANCELLED);
    assert_int_equal(error.count, 1);
    zr_arena_free(&arena);
}

TEST(render_under_every_memory_ceiling_fails_cleanly_or_gives_the_picture)
{
    static zr_vec4 p[3 * 500];
    for (int i = 0; i < 1500; i++)
        p[i] = (zr_vec4){(float)(i % 7) - 3, (float)(i % 5) - 2, 0, (float)(i % 3 + 1)};
    static struct test_scene test;
    scene_of_triangles(&test, 64, 64, p, 500);
    test.material.shading = ZR_SHADING_GOURAUD;
    int failures = 0, successes = 0;
    for (size_t ceiling = 0; ceiling < 2000000; ceiling += 4000) {
        struct zr_arena arena;
        zr_arena_init(&arena, ceiling);
        struct zr_error error = {.count = 0};
        const struct zr_frame *frame;
        enum zr_status status =
            zr_render(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, NULL, &frame);
        if (status == ZR_OK) {
            assert_int_equal(frame->counts.polygons, 500);
            successes++;
        } else {
            assert_int_equal(status, ZR_NO_MEMORY);
            assert_int_equal(error.count, 1);
            assert_int_equal(successes, 0);
            failures++;
        }
        zr_arena_free(&arena);
    }
    assert_true(failures > 10 && successes > 10);
}

RUN_TESTS(NULL, NULL)
