/* The channel flow, beside doubles: motion to the same scene, read with the other view and the other matrices. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/json_check.h"
#include "unit/common/ray_check.h"

#define VIEW_HERE  "{\"eye\": [3, 2, 4], \"target\": [0.5, 0.5, 0.5], \"perspective\": {\"yfovDegrees\": 50}}"
#define VIEW_THERE "{\"eye\": [4.5, 1, 1], \"target\": [0.4, 0.5, 0.5], \"perspective\": {\"yfovDegrees\": 32}}"
#define ORTHO      "{\"azimuthDegrees\": 35, \"elevationDegrees\": 20}"
#define MOVED      "[0.8, 0.6, 0, 0, -0.6, 0.8, 0, 0, 0, 0, 1, 0, 0.3, 0.1, 0.4, 1]"
#define UNMOVED    "[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]"

/* A body of triangles, placed twice so that one hides the other, and a floor. */
#define BODIES                                                                                                         \
    "\"window\": {\"width\": 120, \"height\": 96}, \"meshes\": [{\"name\": \"a\", \"positions\": [[0,0,0],[1,0,0],"    \
    "[0,1,0],[0,0,1],[1,1,1]], \"faces\": [[0,2,1],[0,1,3],[0,3,2],[1,2,4],[1,4,3],[2,3,4]]}, {\"name\": \"floor\", "  \
    "\"doubleSided\": true, \"positions\": [[-2,-0.5,-2],[2,-0.5,-2],[2,-0.5,2],[-2,-0.5,2]], \"faces\": [[0,2,1],"    \
    "[0,3,2]]}], "

static void write_text(char text[4096], const char *view, const char *matrix, const char *outputs)
{
    snprintf(text, 4096,
             "{" BODIES
             "\"view\": %s, \"nodes\": [{\"mesh\": \"floor\"}, {\"mesh\": \"a\"}, {\"name\": \"n\", \"mesh\": "
             "\"a\", \"matrix\": %s}], \"outputs\": [{\"channel\": \"faceId\"}, {\"channel\": \"instanceId\"}%s]}",
             view, matrix, outputs);
}

/* A scene and its picture. */
struct shot {
    struct reading *reading;
    const struct zr_frame *frame;
};

static struct shot shoot(const char *view, const char *matrix, const char *outputs)
{
    char text[4096];
    write_text(text, view, matrix, outputs);
    struct shot shot = {.reading = read_scene(text)};
    shot.frame = scene_render(&shot.reading->arena, NULL, shot.reading->scene);
    return shot;
}

static const struct zr_mesh *mesh_of(const struct shot *shot, uint32_t instance)
{
    return &shot->reading->scene->meshes[shot->reading->scene->instances[instance].mesh];
}

/* Eye-space point of a face, and its place in the window: x and y from the top left, in pixels. */
static void place(const struct shot *shot, uint32_t instance, uint32_t face, const double shares[3], double *depth,
                  double at[2])
{
    const struct zr_mesh *mesh = mesh_of(shot, instance);
    const struct zr_matrix world = zr_matrix_of(&shot->reading->scene->instances[instance].object_to_world),
                           eye = zr_matrix_of(&shot->frame->camera.world_to_eye),
                           projection = zr_matrix_of(&shot->frame->camera.projection);
    double object[4] = {0, 0, 0, 1}, w[4], e[4], c[4];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            object[k] +=
                shares[i] * (double)(&mesh->positions[mesh->indices[mesh->face_offsets[face] + (uint32_t)i]].x)[k];
    zr_matrix_apply(&world, object, w);
    zr_matrix_apply(&eye, w, e);
    zr_matrix_apply(&projection, e, c);
    *depth = -e[2];
    at[0] = (c[0] / c[3] + 1.0) / 2.0 * shot->frame->width;
    at[1] = (1.0 - c[1] / c[3]) / 2.0 * shot->frame->height;
}

/* The nearest depth of a ray. */
static double nearest(const struct shot *shot, const double at[2])
{
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < shot->reading->scene->instance_count; i++)
        for (uint32_t f = 0; f < mesh_of(shot, i)->face_count; f++) {
            double shares[3], depth, back[2];
            find_shares(shot->frame, shot->reading->scene, i, f, at[0] - 0.5, at[1] - 0.5, shares);
            if (!(fmin(shares[0], fmin(shares[1], shares[2])) >= 0.0)) continue;
            place(shot, i, f, shares, &depth, back);
            least = depth > 0.0 && depth < least ? depth : least;
        }
    return least;
}

/* True if all pixels around a place show one face. */
static bool is_plain(const struct zr_frame *frame, const double at[2])
{
    const int column = (int)at[0], row = (int)at[1], width = (int)frame->width, height = (int)frame->height;
    if (column < 1 || row < 1 || column >= width - 1 || row >= height - 1) return false;
    for (int y = row - 1; y <= row + 1; y++)
        for (int x = column - 1; x <= column + 1; x++)
            if (frame->face_id[y * width + x] != frame->face_id[row * width + column]) return false;
    return true;
}

/* Compares all pixels of a flow with the picture that it leads to. */
static void check(const char *from, const char *to, const char *matrix, const char *key)
{
    char outputs[1024];
    int seen = 0, hidden = 0, outside = 0, wrong = 0;
    snprintf(outputs, sizeof outputs, ", {\"channel\": \"flow\", \"to\": %s}", key);
    struct shot here = shoot(from, UNMOVED, outputs), there = shoot(to, matrix, "");
    const uint32_t *ids = here.frame->channels[ZR_CHANNEL_FACE_ID],
                   *instances = here.frame->channels[ZR_CHANNEL_INSTANCE_ID];
    const float *flow = here.frame->channels[ZR_CHANNEL_FLOW];
    const double width = here.frame->width, height = here.frame->height;
    for (uint32_t i = 0; i < here.frame->width * here.frame->height; i++, flow += 3) {
        const double x = i % here.frame->width, y = i / here.frame->width;
        if (ids[i] == 0) {
            assert_true(isnan(flow[0]) && isnan(flow[1]) && isnan(flow[2]));
            continue;
        }
        const uint32_t instance = instances[i] - 1, face = ids[i] - 1 - (instance == 0 ? 0 : instance == 1 ? 2 : 8);
        double shares[3], depth, at[2];
        find_shares(here.frame, here.reading->scene, instance, face, x, y, shares);
        if (fmin(shares[0], fmin(shares[1], shares[2])) < 0.0) continue; /* coverage is decided on a grid */
        place(&there, instance, face, shares, &depth, at);
        if (fabs((double)flow[0] - (at[0] - x - 0.5)) > 0.01 || fabs((double)flow[1] - (at[1] - y - 0.5)) > 0.01)
            fail_msg("%s, pixel %u: %g, %g, not %g, %g", key, i, (double)flow[0], (double)flow[1], at[0] - x - 0.5,
                     at[1] - y - 0.5);
        const bool is_outside = at[0] < 0.0 || at[1] < 0.0 || at[0] >= width || at[1] >= height;
        const bool is_hidden = nearest(&there, at) < depth - 1e-6;
        const float want = is_outside ? -1.0f : is_hidden ? 0.0f : 1.0f;
        if (flow[2] != want && (is_outside || is_plain(there.frame, at)))
            fail_msg("%s, pixel %u: %g, not %g", key, i, (double)flow[2], (double)want);
        seen += want == 1.0f, hidden += want == 0.0f, outside += want == -1.0f, wrong += flow[2] != want;
    }
    assert_true(seen > 1000);
    if (wrong > (seen + hidden + outside) / 25) /* at edges of the other picture, within a pixel */
        fail_msg("%s: %d visible, %d hidden, %d outside, %d differ", key, seen, hidden, outside, wrong);
    reading_free(here.reading);
    reading_free(there.reading);
}

/* Without a motion, the flow is 0 in every pixel, and positions in both spaces are of one point: also at rims, where a
 * triangle covers a sample on the grid of coverage, and its plane meets the ray beside it. */
static void check_still(const char *view)
{
    char outputs[512];
    struct shot shots[2];
    for (int k = 0; k < 2; k++) {
        snprintf(outputs, sizeof outputs,
                 ", {\"channel\": \"flow\", \"to\": {\"view\": %s}}, {\"channel\": \"position\", \"space\": \"%s\"}",
                 view, k ? "world" : "object");
        shots[k] = shoot(view, MOVED, outputs);
    }
    const float *flow = shots[0].frame->channels[ZR_CHANNEL_FLOW],
                *object = shots[0].frame->channels[ZR_CHANNEL_POSITION],
                *world = shots[1].frame->channels[ZR_CHANNEL_POSITION];
    const uint32_t *instances = shots[0].frame->channels[ZR_CHANNEL_INSTANCE_ID];
    for (uint32_t i = 0; i < shots[0].frame->width * shots[0].frame->height; i++) {
        if (instances[i] == 0) continue;
        if (!(fabsf(flow[3 * i]) < 2e-4f && fabsf(flow[3 * i + 1]) < 2e-4f))
            fail_msg("%s, pixel %u: flow %g %g", view, i, (double)flow[3 * i], (double)flow[3 * i + 1]);
        const zr_mat4 *matrix = &shots[0].reading->scene->instances[instances[i] - 1].object_to_world;
        const float *p = &object[3 * i], *w = &world[3 * i];
        const zr_vec4 placed = zr_mat4_apply(matrix, (zr_vec4){p[0], p[1], p[2], 1});
        if (fabsf(placed.x - w[0]) + fabsf(placed.y - w[1]) + fabsf(placed.z - w[2]) > 1e-5f)
            fail_msg("%s, pixel %u: %g %g %g, not %g %g %g", view, i, (double)placed.x, (double)placed.y,
                     (double)placed.z, (double)w[0], (double)w[1], (double)w[2]);
    }
    reading_free(shots[0].reading);
    reading_free(shots[1].reading);
}

TEST(rims_show_the_point_with_the_depth_of_the_pixel)
{
    for (int i = 0; i < 40; i++) {
        char view[128];
        snprintf(view, sizeof view,
                 "{\"eye\": [%.2f, %.2f, 4], \"target\": [0.5, 0.5, 0.5], \"perspective\": {\"yfovDegrees\": 50}}",
                 3 - 0.13 * i, 2 - 0.06 * i);
        check_still(view);
    }
}

TEST(motion_is_that_of_doubles)
{
    check(VIEW_HERE, VIEW_THERE, UNMOVED, "{\"view\": " VIEW_THERE "}");
    check(VIEW_HERE, VIEW_HERE, MOVED, "{\"poses\": {\"n\": " MOVED "}}");
    check(VIEW_HERE, VIEW_THERE, MOVED, "{\"view\": " VIEW_THERE ", \"poses\": {\"n\": " MOVED "}}");
    check(ORTHO, VIEW_THERE, MOVED, "{\"view\": " VIEW_THERE ", \"poses\": {\"n\": " MOVED "}}");
    check(VIEW_THERE, ORTHO, MOVED, "{\"view\": " ORTHO ", \"poses\": {\"n\": " MOVED "}}");
}

/* To the picture itself: no pixel moves, and all are visible. */
TEST(the_same_picture_is_still)
{
    struct shot shot = shoot(ORTHO, UNMOVED, ", {\"channel\": \"flow\", \"to\": {\"poses\": {\"n\": " UNMOVED "}}}");
    const float *flow = shot.frame->channels[ZR_CHANNEL_FLOW];
    const uint32_t *ids = shot.frame->channels[ZR_CHANNEL_FACE_ID];
    uint32_t covered = 0;
    for (uint32_t i = 0; i < shot.frame->width * shot.frame->height; i++, flow += 3) {
        if (ids[i] == 0) continue;
        assert_true(fabsf(flow[0]) < 1e-2f && fabsf(flow[1]) < 1e-2f && flow[2] == 1.0f);
        covered++;
    }
    assert_true(covered > 1000);
    reading_free(shot.reading);
}

/* The other camera looks away from the scene. */
TEST(points_behind_the_camera_have_no_flow)
{
    struct shot shot = shoot(VIEW_HERE, UNMOVED,
                             ", {\"channel\": \"flow\", \"to\": {\"view\": {\"eye\": [3, 2, 4], \"target\": [6, 4, 8], "
                             "\"perspective\": {\"yfovDegrees\": 50}, \"znear\": 0.1, \"zfar\": 10}}}");
    const float *flow = shot.frame->channels[ZR_CHANNEL_FLOW];
    assert_true(shot.frame->covered_pixels > 1000);
    for (uint32_t i = 0; i < 3 * shot.frame->width * shot.frame->height; i++)
        assert_true(isnan(flow[i]));
    reading_free(shot.reading);
}

RUN_TESTS(NULL, NULL)
