/* Bounds of the channel trace: a scene at a bound is drawn, and a scene beyond it is refused.
 * tests/property/test_trace.c checks the steps themselves. */
#include "raster/textbook/trace.h"

#include <stdio.h>
#include <string.h>

#include "base/run.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

enum { SIDE = ZR_TRACE_SIDE_MAX, CORNERS = 6000 };

TEST_ARENA(1 << 28)

static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY},
                                           {.channel = ZR_CHANNEL_TRACE, .encoding = ZR_ENCODING_JSON}};
static struct test_scene test;
static struct zr_error error;
static zr_vec4 positions[CORNERS];

/* Draws the trace beside another channel. */
static enum zr_status draw(enum zr_algorithm algorithm, const struct zr_frame **frame)
{
    error.count = 0;
    test.scene.algorithm = algorithm;
    test.scene.views[0].outputs = outputs;
    test.scene.views[0].output_count = 2;
    return zr_render(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, NULL, frame);
}

static void assert_refused(enum zr_algorithm algorithm, const char *reason)
{
    const struct zr_frame *frame;
    assert_int_equal(draw(algorithm, &frame), ZR_BAD_SCENE);
    assert_int_equal(error.count, 1);
    assert_string_equal(error.items[0].pointer, "/outputs/1");
    if (!strstr(error.items[0].detail, reason)) fail_msg("%s", error.items[0].detail);
}

/* Makes large triangles, one in front of the other. The first `outside` of them lie left of the window. */
static void make_triangles(uint32_t count, uint32_t outside)
{
    for (uint32_t i = 0; i < count; i++) {
        const float x = i < outside ? -9.0f : 0.0f, z = 0.9f - 0.02f * (float)i;
        positions[3 * i] = (zr_vec4){x - 1, -1, z, 1};
        positions[3 * i + 1] = (zr_vec4){x + 1, -1, z, 1};
        positions[3 * i + 2] = (zr_vec4){x, 1, z, 1};
    }
    scene_of_triangles(&test, SIDE, SIDE, positions, count);
}

/* Makes one polygon whose edges cross one another in all rows. */
static void make_tangle(void)
{
    struct random random = random_seeded(5);
    for (uint32_t i = 0; i < CORNERS; i++) {
        const float x = (float)random_range(&random, -0.95, 0.95), y = (float)random_range(&random, -0.95, 0.95);
        positions[i] = (zr_vec4){x, y, 0.5f, 1};
    }
    scene_of_polygon(&test, SIDE, SIDE, positions, CORNERS);
}

TEST_AROUND(sixty_five_primitives_are_refused_and_those_outside_do_not_count, open_arena, close_arena)
{
    const struct zr_frame *frame;
    for (int a = 0; a < ZR_ALGORITHM_COUNT; a++) {
        make_triangles(65, 0);
        assert_refused((enum zr_algorithm)a, "limited to 64 primitives in the window; these are 65");
        make_triangles(80, 16);
        assert_int_equal(draw((enum zr_algorithm)a, &frame), ZR_OK);
        assert_int_equal(frame->trace->primitive_count, 64);
        zr_arena_reset(&arena, 1 << 28);
    }
}

/* The painter takes most steps for triangles that cut one another. */
TEST_AROUND(more_than_20000_steps_are_refused, open_arena, close_arena)
{
    struct random random = random_seeded(3);
    for (uint32_t i = 0; i < 3 * 60; i++)
        positions[i] = (zr_vec4){(float)random_range(&random, -1, 1), (float)random_range(&random, -1, 1),
                                 (float)random_range(&random, -1, 1), 1};
    scene_of_triangles(&test, SIDE, SIDE, positions, 60);
    assert_refused(ZR_ALGORITHM_PAINTER, "limited to 20000 steps,");
}

TEST_AROUND(the_last_step_within_the_bound_is_recorded, open_arena, close_arena)
{
    struct zr_trace trace = {.arena = &arena};
    for (int i = 0; i < ZR_TRACE_STEPS_MAX; i++) {
        zr_trace_step(&trace);
        zr_trace_end(&trace, '}');
    }
    assert_true(!trace.is_beyond && !zr_is_cancelled(&trace.cancel));
    zr_trace_step(&trace);
    assert_true(trace.is_beyond && zr_is_cancelled(&trace.cancel));
}

TEST_AROUND(more_values_than_the_bound_are_refused, open_arena, close_arena)
{
    make_tangle();
    assert_refused(ZR_ALGORITHM_TRAPEZOID, "limited to 1048576 values,");
}

RUN_TESTS(NULL, NULL)
