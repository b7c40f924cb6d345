/* The channel texcoord. */
#include "json_check.h"

#include <math.h>

#include "shade/frame.h"
#include "support/scenes.h"

/* Each corner's texture coordinates are its x and y: so are those of all points, in perspective and cut off, too. A
 * second mesh has none, and a line none either. */
static const char scene[] =
    "{\"window\": {\"width\": 90, \"height\": 70}, \"view\": {\"eye\": [0.3, -1.2, 1.1], \"target\": [0, 0, 0], "
    "\"up\": "
    "[0, 0, 1], \"perspective\": {\"yfovDegrees\": 70}, \"znear\": 0.5, \"zfar\": 9}, "
    "\"meshes\": [{\"positions\": [[-2,-2,0],[2,-2,0.2],[2,2,0],[-2,2,0.1],[-1,0,0.4],[1,0,0.4]], \"faces\": "
    "[[0,1,2],[0,2,3]], \"lines\": [[4,5]], \"texcoords\": [[-2,-2],[2,-2],[2,2],[-2,2],[0,0],[0,0]]}, "
    "{\"positions\": [[-0.2,-0.2,0.3],[0.2,-0.2,0.3],[0,0.2,0.3]], \"faces\": [[0,1,2]]}]}";

static void texcoords_are_those_of_the_point_that_is_seen(void **state)
{
    (void)state;
    static const struct zr_output outputs[] = {
        {.channel = ZR_CHANNEL_TEXCOORD, .encoding = ZR_ENCODING_NPY},
        {.channel = ZR_CHANNEL_POSITION, .encoding = ZR_ENCODING_NPY, .space = ZR_SPACE_OBJECT},
        {.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY}};
    struct reading *reading = read_scene(scene);
    struct zr_scene read = *reading->scene;
    read.views[0].outputs = outputs;
    read.views[0].output_count = 3;
    struct zr_team *team = zr_team_create(1);
    const struct zr_frame *frame = scene_render(&reading->arena, team, &read);
    const float *texcoords = frame->channels[ZR_CHANNEL_TEXCOORD], *positions = frame->channels[ZR_CHANNEL_POSITION];
    const uint32_t *ids = frame->channels[ZR_CHANNEL_FACE_ID];
    uint32_t seen[5] = {0};
    for (uint32_t i = 0; i < frame->width * frame->height; i++) {
        const float u = texcoords[2 * i], v = texcoords[2 * i + 1];
        seen[ids[i]]++;
        if (ids[i] == 1 || ids[i] == 2)
            assert_true(fabsf(u - positions[3 * i]) <= 1e-6f && fabsf(v - positions[3 * i + 1]) <= 1e-6f);
        else
            assert_true(u == 0.0f && v == 0.0f);
    }
    for (int id = 0; id < 5; id++)
        assert_true(seen[id] > 20);
    zr_team_destroy(team);
    reading_free(reading);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(texcoords_are_those_of_the_point_that_is_seen)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
