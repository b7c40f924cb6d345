#include "support/scenes.h"

#include <string.h>

#include "base/run.h"
#include "scene/camera/resolved_view.h"
#include "scene/looks.h"
#include "support/cmocka_all.h"

void scene_of_triangles(struct test_scene *test, uint32_t width, uint32_t height, const zr_vec4 *positions,
                        uint32_t triangles)
{
    assert_true(triangles <= TEST_TRIANGLES_MAX);
    memset(test, 0, sizeof *test);
    for (uint32_t i = 0; i <= triangles; i++)
        test->face_offsets[i] = 3 * i;
    for (uint32_t i = 0; i < 3 * triangles; i++)
        test->indices[i] = i;
    test->material =
        (struct zr_material){.base_color = {1, 1, 1, 1}, .shading = ZR_SHADING_UNLIT, .double_sided = true};
    test->mesh = (struct zr_mesh){.name = "test",
                                  .position_count = 3 * triangles,
                                  .positions = positions,
                                  .face_count = triangles,
                                  .face_offsets = test->face_offsets,
                                  .indices = test->indices};
    test->instance.object_to_world = zr_mat4_identity();
    const enum zr_channel channels[4] = {ZR_CHANNEL_COLOR, ZR_CHANNEL_DEPTH, ZR_CHANNEL_WINDOW_DEPTH,
                                         ZR_CHANNEL_FACE_ID};
    for (int i = 0; i < 4; i++)
        test->outputs[i] =
            (struct zr_output){.channel = channels[i], .encoding = i ? ZR_ENCODING_NPY : ZR_ENCODING_PNG};
    test->picture = (struct zr_picture){.side = 0};
    test->scene = (struct zr_scene){.look = zr_look_textbook(),
                                    .picture = &test->picture,
                                    .background = {0, 0, 0, 1},
                                    .material_count = 1,
                                    .mesh_count = 1,
                                    .instance_count = 1,
                                    .materials = &test->material,
                                    .meshes = &test->mesh,
                                    .instances = &test->instance};
    test->scene.views[0] = (struct zr_view){.width = width,
                                            .height = height,
                                            .output_count = 4,
                                            .outputs = test->outputs,
                                            .pose = ZR_POSE_MATRIX,
                                            .world_to_camera = zr_mat4_identity(),
                                            .projection = ZR_PROJECTION_MATRIX,
                                            .projection_matrix = zr_mat4_identity()};
}

void scene_of_polygon(struct test_scene *test, uint32_t width, uint32_t height, const zr_vec4 *positions,
                      uint32_t corners)
{
    assert_true(corners <= 3 * TEST_TRIANGLES_MAX);
    scene_of_triangles(test, width, height, positions, 1);
    for (uint32_t i = 0; i < corners; i++)
        test->indices[i] = i;
    test->mesh.position_count = test->face_offsets[1] = corners;
}

const struct zr_frame *scene_render(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene)
{
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame = NULL;
    enum zr_status status =
        zr_render(&(struct zr_run){.arena = arena, .team = team, .error = &error}, scene, NULL, &frame);
    if (status != ZR_OK) fail_msg("status %d: %s", (int)status, error.count ? error.items[0].detail : "");
    return frame;
}

struct zr_answer scene_encode(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene)
{
    struct zr_answer answer;
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame = scene_render(arena, team, scene);
    enum zr_status status =
        zr_encode(&(struct zr_run){.arena = arena, .team = team, .error = &error}, scene, frame, &answer);
    if (status != ZR_OK) fail_msg("status %d: %s", (int)status, error.count ? error.items[0].detail : "");
    return answer;
}

struct zr_cost scene_cost(const struct zr_scene *scene)
{
    struct zr_error error = {.count = 0};
    const struct zr_resolved_view *resolved = NULL;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 20);
    enum zr_status status = zr_resolved_view_find(&(struct zr_run){.arena = &arena, .error = &error}, scene, &resolved);
    if (status != ZR_OK) fail_msg("status %d: %s", (int)status, error.count ? error.items[0].detail : "");
    const struct zr_cost cost = zr_scene_cost(scene, resolved);
    zr_arena_free(&arena);
    return cost;
}
