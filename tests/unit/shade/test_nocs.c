/* The channel position in the space nocs, beside doubles. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/json_check.h"
#include "unit/common/ray_check.h"

#define OUTPUTS(NAMES) "\"window\": {\"width\": 96, \"height\": 80}, \"outputs\": [" NAMES "], "
#define NOCS           "{\"channel\": \"position\", \"space\": \"nocs\"}"

/* A skewed tetrahedron far from its origin, placed twice. */
#define BODY                                                                                                           \
    "\"meshes\": [{\"name\": \"body\", \"positions\": [[10, 20, 30], [14, 20.5, 31], [11, 23, 30], [12, 21, 35]], "    \
    "\"faces\": [[0,2,1],[0,1,3],[1,2,3],[2,0,3]]}], \"nodes\": [{\"mesh\": \"body\", \"translation\": [-10, -20, "    \
    "-30]}, {\"mesh\": \"body\", \"translation\": [-11, -3, -22], \"rotation\": [0.1, 0.7, 0.2, 0.6], \"scale\": "     \
    "[0.5, 0.2, 0.4]}]"

/* Box of a mesh, in doubles. */
static void box_of(const struct zr_mesh *mesh, double middle[3], double *diagonal)
{
    double square = 0.0;
    for (int k = 0; k < 3; k++) {
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (uint32_t i = 0; i < mesh->position_count; i++) {
            const double at = (double)(&mesh->positions[i].x)[k] / (double)mesh->positions[i].w;
            least = fmin(least, at);
            most = fmax(most, at);
        }
        middle[k] = (least + most) / 2.0;
        square += (most - least) * (most - least);
    }
    *diagonal = sqrt(square);
}

TEST(coordinates_of_faces_are_those_of_doubles)
{
    struct reading *reading = read_scene("{" OUTPUTS(
        "{\"channel\": \"faceId\"}, {\"channel\": \"instanceId\"}, " NOCS) "\"view\": {\"azimuthDegrees\": 30, "
                                                                           "\"elevationDegrees\": 25}, " BODY "}");
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    const uint32_t *instances = frame->channels[ZR_CHANNEL_INSTANCE_ID];
    const float *nocs = frame->channels[ZR_CHANNEL_POSITION];
    int checked[2] = {0, 0}, borders = 0;
    for (uint32_t i = 0; i < frame->width * frame->height; i++) {
        const float *got = &nocs[3 * i];
        if (instances[i] == 0) {
            assert_true(got[0] == 0.0f && got[1] == 0.0f && got[2] == 0.0f);
            continue;
        }
        const uint32_t instance = instances[i] - 1, face = (frame->face_id[i] - 1) % 4;
        const struct zr_mesh *mesh = &reading->scene->meshes[reading->scene->instances[instance].mesh];
        double shares[3], middle[3], diagonal;
        find_shares(frame, reading->scene, instance, face, i % frame->width, i / frame->width, shares);
        if (fmin(shares[0], fmin(shares[1], shares[2])) < 0.0) { /* coverage is decided on a grid */
            borders++;
            continue;
        }
        box_of(mesh, middle, &diagonal);
        for (int k = 0; k < 3; k++) {
            double point = 0.0;
            for (int c = 0; c < 3; c++)
                point +=
                    shares[c] * (double)(&mesh->positions[mesh->indices[mesh->face_offsets[face] + (uint32_t)c]].x)[k];
            const double want = (point - middle[k]) / diagonal + 0.5;
            if (fabs((double)got[k] - want) > 1e-6)
                fail_msg("pixel %u, %d: %.9g, not %.9g", i, k, (double)got[k], want);
        }
        checked[instance]++;
    }
    assert_true(checked[0] > 100 && checked[1] > 20 && borders < 20);
    reading_free(reading);
}

/* Lines and points, beside their positions in object space. */
TEST(coordinates_of_lines_and_points_are_those_of_their_positions)
{
    static const char *const texts[] = {OUTPUTS("{\"channel\": \"position\", \"space\": \"object\"}"), OUTPUTS(NOCS)};
    const struct zr_frame *frames[2];
    struct reading *readings[2];
    double middle[3], diagonal;
    int checked = 0;
    for (int i = 0; i < 2; i++) {
        char text[1024];
        snprintf(
            text, sizeof text,
            "{%s\"view\": {\"azimuthDegrees\": 30}, \"meshes\": [{\"positions\": [[1,2,3],[2,2,2],[3,4,7],[2,2,5]], "
            "\"lines\": [[0,1],[1,2]], \"points\": [3], \"pointSize\": 9, \"name\": \"m\"}], \"nodes\": [{\"mesh\": "
            "\"m\", \"scale\": [1, 2, 0.5]}]}",
            texts[i]);
        readings[i] = read_scene(text);
        frames[i] = scene_render(&readings[i]->arena, NULL, readings[i]->scene);
    }
    box_of(&readings[0]->scene->meshes[0], middle, &diagonal);
    const float *object = frames[0]->channels[ZR_CHANNEL_POSITION], *nocs = frames[1]->channels[ZR_CHANNEL_POSITION];
    for (uint32_t i = 0; i < 3 * frames[0]->width * frames[0]->height; i++) {
        if (nocs[i] == 0.0f) {
            assert_true(object[i] == 0.0f);
            continue;
        }
        assert_true(fabs((double)nocs[i] - (((double)object[i] - middle[i % 3]) / diagonal + 0.5)) <= 1e-6);
        checked++;
    }
    assert_true(checked > 3 * 150);
    reading_free(readings[0]);
    reading_free(readings[1]);
}

/* A box without a diagonal. */
TEST(a_single_point_is_the_middle)
{
    struct reading *reading =
        read_scene("{" OUTPUTS(NOCS) "\"meshes\": [{\"positions\": [[1,2,3]], \"points\": [0], \"pointSize\": 5}]}");
    const struct zr_frame *frame = scene_render(&reading->arena, NULL, reading->scene);
    const float *nocs = frame->channels[ZR_CHANNEL_POSITION];
    int covered = 0;
    for (uint32_t i = 0; i < 3 * frame->width * frame->height; i++) {
        assert_true(nocs[i] == 0.0f || nocs[i] == 0.5f);
        covered += nocs[i] == 0.5f;
    }
    assert_int_equal(covered, 3 * 25);
    reading_free(reading);
}

/* Pixels that stay have the same coordinates, but for the rounding of the cut's corners. */
TEST(a_section_keeps_the_box)
{
    static const char *const cuts[] = {"", "\"sections\": {\"planes\": [{\"axis\": \"x\", \"fraction\": 0.3}]}, "};
    struct reading *readings[2];
    const struct zr_frame *frames[2];
    int same = 0;
    for (int i = 0; i < 2; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "{" OUTPUTS("{\"channel\": \"faceId\"}, " NOCS) "%s\"view\": {\"R\": [[1,0,0],[0,-1,0],[0,0,-1]], "
                                                                 "\"t\": [-2, 2, 14], "
                                                                 "\"K\": [[200,0,48],[0,200,40],[0,0,1]]}, " BODY "}",
                 cuts[i]);
        readings[i] = read_scene(text);
        frames[i] = scene_render(&readings[i]->arena, NULL, readings[i]->scene);
    }
    const float *whole = frames[0]->channels[ZR_CHANNEL_POSITION], *cut = frames[1]->channels[ZR_CHANNEL_POSITION];
    for (uint32_t i = 0; i < frames[0]->width * frames[0]->height; i++) {
        if (frames[1]->face_id[i] == 0 || frames[0]->face_id[i] != frames[1]->face_id[i]) continue;
        for (int k = 0; k < 3; k++)
            assert_true(fabsf(whole[3 * i + (uint32_t)k] - cut[3 * i + (uint32_t)k]) < 1e-5f);
        same++;
    }
    assert_true(same > 100);
    reading_free(readings[0]);
    reading_free(readings[1]);
}

RUN_TESTS(NULL, NULL)
