/* Views of scenes with sections frame the remaining part. */
#include "base/run.h"
#include "sections/sectioned_view.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

TEST_ARENA(1 << 24)

#define SQUARE            "\"polygons\": [{\"vertices\": [[-1,-1,0], [1,-1,0], [1,1,0], [-1,1,0]]}]"
#define PLANE(axis, side) "{\"axis\": \"" axis "\", \"fraction\": 0.5, \"keep\": \"" side "\"}"
#define FRONT             "\"view\": {\"preset\": \"front\", \"orthographic\": {}, \"fit\": {\"padding\": 0}}"

TEST_AROUND(views_are_framed_by_what_is_left, open_arena, close_arena)
{
    static const struct {
        const char *rest;
        float x, y, half; /* middle and half height of the window, which is square */
    } cases[] = {
        {FRONT, 0, 0, 1},
        {FRONT ", \"sections\": {\"planes\": [" PLANE("x", "positive") "]}", 0.5f, 0, 1},
        {FRONT ", \"sections\": {\"planes\": [" PLANE("x", "negative") "]}", -0.5f, 0, 1},
        {FRONT ", \"sections\": {\"planes\": [" PLANE("x", "positive") ", " PLANE("y", "positive") "]}", 0.5f, 0.5f,
         0.5f},
        {FRONT
         ", \"sections\": {\"planes\": [" PLANE("x", "positive") ", " PLANE("y", "positive") "], \"corner\": true}",
         0, 0, 1},
        {"\"view\": {\"eye\": [0, 0, 5], \"target\": [0, 0, 0], \"orthographic\": {\"xmag\": 1, \"ymag\": 1}}, "
         "\"sections\": "
         "{\"planes\": [" PLANE("x", "positive") "]}",
         0, 0, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct zr_error error = {0};
        const struct zr_resolved_view *resolved;
        char text[1024];
        snprintf(text, sizeof text, "{\"window\": {\"width\": 60, \"height\": 60}, " SQUARE ", %s}", cases[i].rest);
        struct reading *reading = read_scene(text);
        const struct zr_run run = {.arena = &arena, .error = &error};
        assert_int_equal(zr_resolved_view_find(&run, reading->scene, &resolved), ZR_OK);
        const float *eye = resolved->camera.world_to_eye.m, *window = resolved->camera.projection.m;
        print_message("%zu: %g %g, %g\n", i, (double)-eye[12], (double)-eye[13], 1.0 / (double)window[5]);
        assert_true(fabsf(-eye[12] - cases[i].x) < 1e-3f && fabsf(-eye[13] - cases[i].y) < 1e-3f);
        assert_true(fabsf(1.0f / window[5] - cases[i].half) < 1e-3f);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
