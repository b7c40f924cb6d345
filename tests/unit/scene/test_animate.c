/* Animations: each frame equals the scene drawn alone with its matrices written out; keys are interpolated, held and
 * clamped; a fitted camera stands still and sees all frames. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/run.h"
#include "render_request.h"
#include "request/change.h"
#include "scene/parts/animation.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "views/view_scene.h"
#include "views/views.h"

TEST_ARENA((size_t)1 << 28)

#define MESH                                                                                                           \
    "\"meshes\": [{\"name\": \"a\", \"positions\": [[0,0,0],[3,0,0],[0,2,0],[0,0,1]], "                                \
    "\"faces\": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}]"
#define WINDOW "\"window\": {\"width\": 80, \"height\": 60}"
#define OUTPUTS                                                                                                        \
    "\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\", \"encoding\": \"png16\", \"scale\": 0.01}]"
#define EYE "\"view\": {\"eye\": [9,7,12], \"target\": [1,1,0]}"
#define NODE(matrix)                                                                                                   \
    "\"nodes\": [{\"name\": \"n\", \"mesh\": \"a\", " matrix ", \"children\": [\"m\"]}, {\"name\": \"m\", \"mesh\": "  \
    "\"a\", \"translation\": [0,0,3]}]"

static struct zr_limits limits;

static void open_scene(const char *text, struct zr_views *views)
{
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = text, .size = strlen(text)};
    struct zr_error error = {0};
    limits = zr_limits_default();
    enum zr_status status = zr_views_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, views);
    if (status == ZR_OK) status = zr_views_plan(&(struct zr_run){.arena = &arena, .error = &error}, views);
    if (status != ZR_OK) fail_msg("%s: %s: %s", text, error.items[0].pointer, error.items[0].detail);
}

static struct zr_files draw(struct zr_views *views)
{
    struct zr_files files;
    struct zr_error error = {0};
    if (zr_views_draw(&(struct zr_run){.arena = &arena, .error = &error}, views, &files) != ZR_OK)
        fail_msg("%s: %s", error.items[0].pointer, error.items[0].detail);
    return files;
}

static struct zr_files draw_alone(const char *text)
{
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = text, .size = strlen(text)};
    const struct zr_scene *scene;
    const struct zr_frame *frame = NULL;
    struct zr_files files = {.count = 0};
    struct zr_error error = {0};
    enum zr_status status =
        zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene);
    if (status == ZR_OK) status = zr_render(&(struct zr_run){.arena = &arena, .error = &error}, scene, NULL, &frame);
    if (status == ZR_OK)
        status = zr_encode_files(&(struct zr_run){.arena = &arena, .error = &error}, scene, frame, NULL, &files);
    if (status != ZR_OK) fail_msg("%s: %s: %s", text, error.items[0].pointer, error.items[0].detail);
    return files;
}

/* Checks the files of frame `number`, color and depth. */
static void assert_frame(const struct zr_files *files, uint32_t number, const struct zr_files *alone)
{
    for (uint32_t k = 0; k < alone->count; k++) {
        const struct zr_zip_entry *got = &files->entries[number * alone->count + k], *want = &alone->entries[k];
        char name[64];
        snprintf(name, sizeof name, "%04u.%s", number + 1, want->name);
        assert_string_equal(got->name, name);
        if (got->size != want->size || memcmp(got->bytes, want->bytes, got->size) != 0)
            fail_msg("%s: other bytes than those of the scene alone", name);
    }
}

static void write_matrix(const char *key, const zr_mat4 *matrix, char text[512])
{
    int used = snprintf(text, 512, "\"%s\": [", key);
    for (int i = 0; i < 16; i++)
        used += snprintf(text + used, 512 - (size_t)used, "%s%.9g", i ? "," : "", (double)matrix->m[i]);
    snprintf(text + used, 512 - (size_t)used, "]");
}

/* Matrix of the node "n", which has no parent, in a frame. */
static zr_mat4 matrix_in(const struct zr_views *views, uint32_t number)
{
    const struct zr_scene *scene;
    struct zr_error error = {0};
    assert_int_equal(zr_scene_frame(&(struct zr_run){.arena = &arena, .error = &error}, views->kept, number, &scene),
                     ZR_OK);
    return scene->instances[0].object_to_world;
}

/* ---- turns ---- */

/* A translated and scaled node in four quarters of a turn about its own z axis. */
TEST_AROUND(turned_nodes_equal_nodes_with_the_matrices, open_arena, close_arena)
{
    static const char *const quarters[] = {
        "2,0,0,0, 0,1,0,0, 0,0,1,0, 1,0,-1,1", "0,1,0,0, -2,0,0,0, 0,0,1,0, 1,0,-1,1",
        "-2,0,0,0, 0,-1,0,0, 0,0,1,0, 1,0,-1,1", "0,-1,0,0, 2,0,0,0, 0,0,1,0, 1,0,-1,1"};
    struct zr_views views;
    char text[2048];
    open_scene("{" MESH "," WINDOW "," OUTPUTS "," EYE
               "," NODE("\"translation\": [1,0,-1], \"scale\": [2,1,1]") ","
                                                                         "\"animate\": {\"frames\": 4, \"nodes\": "
                                                                         "{\"n\": {\"rotate\": {\"axis\": \"z\"}}}}}",
               &views);
    assert_true(views.set->seconds == 4.0);
    const struct zr_files files = draw(&views);
    assert_int_equal(files.count, 8);
    for (uint32_t i = 0; i < 4; i++) {
        snprintf(text, sizeof text, "{%s,%s,%s,%s," NODE("\"matrix\": [%s]") "}", MESH, WINDOW, OUTPUTS, EYE,
                 quarters[i]);
        const struct zr_files alone = draw_alone(text);
        assert_frame(&files, i, &alone);
    }
}

/* Twelfths of a turn about a diagonal are turns of exact angles: three of 120 degrees permute the axes. */
TEST_AROUND(axes_may_have_any_length_and_direction, open_arena, close_arena)
{
    static const float third[] = {0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1};
    struct zr_views views;
    open_scene("{" MESH "," NODE("\"scale\": [1,1,1]") ",\"animate\": {\"frames\": 12, \"nodes\": {\"n\": "
                                                       "{\"rotate\": {\"axis\": [7,7,7], \"degrees\": 360}}, \"m\": "
                                                       "{\"rotate\": {\"axis\": \"x\"}}}}}",
               &views);
    const zr_mat4 turned = matrix_in(&views, 4), back = matrix_in(&views, 8);
    for (int i = 0; i < 16; i++) {
        assert_true(fabsf(turned.m[i] - third[i]) < 1e-6f);
        assert_true(fabsf(back.m[i] - third[4 * (i % 4) + i / 4]) < 1e-6f);
    }
}

/* ---- keys ---- */

TEST_AROUND(keys_are_interpolated_held_and_clamped, open_arena, close_arena)
{
    static const struct {
        const char *interpolation;
        float x[8], sine[8]; /* translation, and rotation about z at 0, 0.5, ... seconds; keys at 1, 2 and 3 */
    } cases[] = {{"linear", {0, 0, 0, 1, 2, 5, 8, 8}, {0, 0, 0, 0.70710678f, 1, 0.70710678f, 0, 0}},
                 {"step", {0, 0, 0, 0, 2, 2, 8, 8}, {0, 0, 0, 0, 1, 1, 0, 0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct zr_views views;
        char text[2048];
        snprintf(text, sizeof text,
                 "{%s, %s, \"animate\": {\"frames\": 8, \"seconds\": 4, \"nodes\": {\"n\": {\"times\": [1,2,3], "
                 "\"translation\": [[0,0,0],[2,0,0],[8,0,0]], \"rotation\": [[0,0,0,1],[0,0,1,1],[0,0,0,-2]], "
                 "\"interpolation\": \"%s\"}}}}",
                 MESH, NODE("\"translation\": [9,9,9], \"scale\": [1,1,3]"), cases[i].interpolation);
        open_scene(text, &views);
        for (uint32_t k = 0; k < 8; k++) {
            const zr_mat4 matrix = matrix_in(&views, k);
            if (!(fabsf(matrix.m[12] - cases[i].x[k]) < 1e-6f && fabsf(matrix.m[1] - cases[i].sine[k]) < 1e-6f))
                fail_msg("%s: frame %u: %g and %g", cases[i].interpolation, k, (double)matrix.m[12],
                         (double)matrix.m[1]);
            assert_true(matrix.m[10] == 3.0f); /* the node's own scale */
        }
    }
}

TEST_AROUND(keys_come_before_a_turn_and_set_the_time, open_arena, close_arena)
{
    struct zr_views views;
    open_scene("{" MESH
               "," NODE("\"scale\": [1,1,1]") ",\"animate\": {\"frames\": 4, \"nodes\": {\"n\": {\"times\": [0,8],"
                                              "\"scale\": [[1,1,1],[9,1,1]], \"rotate\": {\"axis\": \"z\"}}}}}",
               &views);
    assert_true(views.set->seconds == 8.0);
    const zr_mat4 matrix = matrix_in(&views, 1); /* scaled along x by 3, after a quarter of a turn */
    assert_true(matrix.m[0] == 0.0f && matrix.m[1] == 1.0f && matrix.m[4] == -3.0f && matrix.m[5] == 0.0f);
}

/* ---- the camera ---- */

/* The camera of a fitted view is the same in each frame, and each vertex is in the window. A frame equals the scene
 * with this camera. */
TEST_AROUND(a_fitted_camera_stands_still_and_sees_all_frames, open_arena, close_arena)
{
    static const struct {
        const char *look, *projection; /* written out; NULL: that of the look */
    } cases[] = {{"\"look\": \"studio\"", NULL},
                 {"\"view\": {\"preset\": \"top\", \"perspective\": {\"yfovDegrees\": 40}}",
                  "\"perspective\": {\"yfovDegrees\": 40}"},
                 {"\"view\": {\"azimuthDegrees\": 20, \"elevationDegrees\": 10, \"orthographic\": {}}",
                  "\"orthographic\": {\"xmag\": %.9g, \"ymag\": %.9g}"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct zr_views views;
        char text[2048], matrix[512], camera[512], projection[128];
        snprintf(text, sizeof text,
                 "{%s,%s,%s,%s,%s,\"animate\": {\"frames\": 5, \"nodes\": {\"n\": {\"rotate\": {\"axis\": \"y\"}}}}}",
                 MESH, WINDOW, OUTPUTS, NODE("\"translation\": [4,0,0]"), cases[i].look);
        open_scene(text, &views);
        const struct zr_files files = draw(&views);
        for (uint32_t k = 0; k < 5; k++) {
            const struct zr_scene *scene;
            const struct zr_resolved_view *view;
            struct zr_error error = {0};
            assert_int_equal(zr_view_scene(&(struct zr_run){.arena = &arena, .error = &error}, &views, k, &scene),
                             ZR_OK);
            assert_int_equal(zr_resolved_view_find(&(struct zr_run){.arena = &arena, .error = &error}, scene, &view),
                             ZR_OK);
            assert_memory_equal(&view->camera.world_to_eye, &views.camera.world_to_eye, sizeof(zr_mat4));
            const zr_mat4 to_clip = zr_mat4_mul(&view->camera.projection, &view->camera.world_to_eye);
            for (uint32_t n = 0; n < scene->instance_count; n++) {
                const struct zr_mesh *mesh = &scene->meshes[scene->instances[n].mesh];
                const zr_mat4 all = zr_mat4_mul(&to_clip, &scene->instances[n].object_to_world);
                for (uint32_t p = 0; p < mesh->position_count; p++) {
                    const zr_vec4 at = zr_mat4_apply(&all, mesh->positions[p]);
                    assert_true(fabsf(at.x) < at.w && fabsf(at.y) < at.w);
                }
            }
        }
        if (!cases[i].projection) continue;
        snprintf(projection, sizeof projection, cases[i].projection, (double)views.camera.xmag,
                 (double)views.camera.ymag);
        write_matrix("worldToCamera", &views.camera.world_to_eye, camera);
        const zr_mat4 turned = matrix_in(&views, 2);
        write_matrix("matrix", &turned, matrix);
        snprintf(
            text, sizeof text,
            "{%s,%s,%s,\"view\": {%s, %s}, \"nodes\": [{\"name\": \"n\", \"mesh\": \"a\", %s, \"children\": [\"m\"]}, "
            "{\"name\": \"m\", \"mesh\": \"a\", \"translation\": [0,0,3]}]}",
            MESH, WINDOW, OUTPUTS, camera, projection, matrix);
        const struct zr_files alone = draw_alone(text);
        assert_frame(&files, 2, &alone);
    }
}

/* ---- images ---- */

#define PIXEL                                                                                                          \
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5Erk" \
    "Jggg=="

TEST_AROUND(frames_share_the_images_of_the_scene, open_arena, close_arena)
{
    struct zr_views views;
    const struct zr_scene *frame;
    struct zr_error error = {0};
    open_scene("{\"materials\": [{\"name\": \"t\", \"baseColorTexture\": {\"uri\": \"" PIXEL "\"}}], \"meshes\": [{"
               "\"name\": \"a\", \"material\": \"t\", \"positions\": [[0,0,0],[3,0,0],[0,2,0]], \"texcoords\": "
               "[[0,0],[1,0],[0,1]], \"faces\": [[0,1,2]]}], \"nodes\": [{\"name\": \"n\", \"mesh\": \"a\"}], "
               "\"animate\": {\"frames\": 3, \"nodes\": {\"n\": {\"rotate\": {\"axis\": \"y\"}}}}}",
               &views);
    assert_int_equal(zr_scene_frame(&(struct zr_run){.arena = &arena, .error = &error}, views.kept, 1, &frame), ZR_OK);
    assert_int_equal(frame->image_count, 1);
    assert_ptr_equal(frame->images[0].texels, views.scene->images[0].texels);
}

RUN_TESTS(NULL, NULL)
