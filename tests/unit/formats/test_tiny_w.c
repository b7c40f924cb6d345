/* Depth, distance and position where a corner has a w that is tiny beside those of the others. */
#include "support/isas.h"
#include "support/scenes.h"
#include "unit/common/input_check.h"
#include <math.h>
#include <stdio.h>

/* The plane z = 0, three units in front of the camera, with a corner whose w is tiny beside those of the others: none
 * of the three may be lost, whichever it is. */
TEST_EACH_ISA(depth_of_a_corner_with_a_tiny_w_is_that_of_its_plane)
{
    static const char *const corners[3] = {"[-1,-1,0,1]", "[1,-1,0,1]", "[0,0,0,1e-20]"};
    struct zr_team *team = zr_team_create_for(2, isa_under_test(state));
    for (int turn = 0; turn < 3; turn++) {
        char text[1024];
        snprintf(
            text, sizeof text,
            "{\"window\":{\"width\":16,\"height\":16},\"meshes\":[{\"positions\":[%s,%s,%s],\"faces\":[[0,1,2]]}],"
            "\"view\":{\"eye\":[0,-0.4,3],\"target\":[0,-0.4,0],\"perspective\":{\"yfovDegrees\":50},\"znear\":1,"
            "\"zfar\":9},\"outputs\":[{\"channel\":\"position\"},{\"channel\":\"depth\"},{\"channel\":\"distance\"}]}",
            corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]);
        struct reading *reading = read_text(ZR_FORMAT_JSON, text);
        assert_read(reading);
        const struct zr_frame *frame = scene_render(&reading->arena, team, reading->scene);
        const float *positions = frame->channels[ZR_CHANNEL_POSITION],
                    *distances = frame->channels[ZR_CHANNEL_DISTANCE];
        int covered = 0;
        for (int i = 0; i < 16 * 16; i++) {
            if (isinf(frame->depth[i])) continue;
            covered++;
            if (frame->depth[i] != 3.0f || positions[3 * i + 2] != -3.0f || !(fabsf(positions[3 * i]) < 1.0f) ||
                !(distances[i] >= 3.0f && distances[i] < 3.4f))
                fail_msg("turn %d, pixel %d: depth %g, distance %g", turn, i, (double)frame->depth[i],
                         (double)distances[i]);
        }
        assert_int_equal(covered, 30);
        reading_free(reading);
    }
    zr_team_destroy(team);
}

RUN_TESTS(NULL, NULL)
