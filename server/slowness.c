#include "slowness.h"

#include <math.h>
#include <string.h>

#include "clock.h"
#include "zraster.h"

enum { ROUNDS = 5, ARENA_BYTES = 64 << 20 };
static const double REFERENCE_MS = 5.0, BUDGET_MS = 100.0; /* a slow machine draws fewer than ROUNDS */

static const char SCENE[] =
    "{\"look\":\"studio\",\"window\":{\"width\":160,\"height\":120},\"meshes\":[{\"heights\":[[0,1,0,1,0],[1,2,1,2,1],"
    "[0,1,3,1,0],[1,2,1,2,1],[0,1,0,1,0]]}]}";

/* Returns the processor time of one picture, in ms; infinity on failure. The process must do nothing else meanwhile. */
static double measure_ms(struct zr_arena *arena, struct zr_team *team)
{
    const struct zr_limits limits = zr_limits_default();
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = SCENE, .size = sizeof SCENE - 1};
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    struct zr_answer answer;
    struct zr_error error = {.count = 0};
    const int64_t begin_us = clock_process_us();
    zr_arena_reset(arena, ARENA_BYTES);
    if (zr_scene_read(arena, team, &request, &limits, &scene, &error) != ZR_OK ||
        zr_render(arena, team, scene, NULL, NULL, &frame, &error) != ZR_OK ||
        zr_encode(arena, team, scene, frame, NULL, &answer, &error) != ZR_OK)
        return HUGE_VAL;
    return 1e-3 * (double)(clock_process_us() - begin_us);
}

double slowness_measure(enum zr_isa isa)
{
    struct zr_arena arena;
    struct zr_team *team = zr_team_create_for(1, isa);
    double least_ms = HUGE_VAL, total_ms = 0.0;
    zr_arena_init(&arena, ARENA_BYTES);
    for (int i = 0; team && i < ROUNDS && total_ms < BUDGET_MS; i++) {
        const double ms = measure_ms(&arena, team);
        least_ms = fmin(least_ms, ms);
        total_ms += ms;
    }
    zr_arena_free(&arena);
    if (team) zr_team_destroy(team);
    return least_ms < HUGE_VAL ? least_ms / REFERENCE_MS : 1.0;
}
