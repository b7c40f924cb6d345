#include "slowness.h"

#include <math.h>
#include <string.h>

#include "clock.h"
#include "core.h"
#include "render_request.h"

#include "base/run.h"

enum { ROUNDS = 5, ARENA_BYTES = 64 << 20 };
static const double REFERENCE_MS = 3.6, BUDGET_MS = 100.0; /* a slow machine draws fewer than ROUNDS */

static const char SCENE[] =
    "{\"look\":\"studio\",\"window\":{\"width\":160,\"height\":120},\"meshes\":[{\"heights\":[[0,1,0,1,0],[1,2,1,2,1],"
    "[0,1,3,1,0],[1,2,1,2,1],[0,1,0,1,0]]}]}";

/* Returns this thread's processor time of one picture, in ms; infinity on failure. */
static double measure_ms(struct zr_arena *arena, struct zr_team *team)
{
    const struct zr_limits limits = zr_limits_default();
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = SCENE, .size = sizeof SCENE - 1};
    const struct zr_scene *scene;
    const struct zr_frame *frame;
    struct zr_answer answer;
    struct zr_error error = {.count = 0};
    const struct zr_run run = {.arena = arena, .team = team, .error = &error};
    const int64_t begin_us = clock_thread_us();
    zr_arena_reset(arena, ARENA_BYTES);
    if (zr_scene_read(&run, &request, &limits, &scene) != ZR_OK || zr_render(&run, scene, NULL, &frame) != ZR_OK ||
        zr_encode(&run, scene, frame, &answer) != ZR_OK)
        return HUGE_VAL;
    return 1e-3 * (double)(clock_thread_us() - begin_us);
}

static double measure(enum zr_isa isa)
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

static void *run(void *context)
{
    struct slowness *slowness = context;
    const double value = measure(slowness->isa);
    pthread_mutex_lock(&slowness->mutex);
    slowness->value = value;
    slowness->is_known = true;
    pthread_cond_broadcast(&slowness->known);
    pthread_mutex_unlock(&slowness->mutex);
    return NULL;
}

void slowness_start(struct slowness *slowness, enum zr_isa isa)
{
    *slowness = (struct slowness){.isa = isa, .value = 1.0};
    pthread_mutex_init(&slowness->mutex, NULL);
    pthread_cond_init(&slowness->known, NULL);
    slowness->has_thread = pthread_create(&slowness->thread, NULL, run, slowness) == 0;
    if (!slowness->has_thread) run(slowness);
}

double slowness_of(struct slowness *slowness, bool wait)
{
    pthread_mutex_lock(&slowness->mutex);
    while (wait && !slowness->is_known)
        pthread_cond_wait(&slowness->known, &slowness->mutex);
    const double value = slowness->value;
    pthread_mutex_unlock(&slowness->mutex);
    return value;
}

void slowness_end(struct slowness *slowness)
{
    if (slowness->has_thread) pthread_join(slowness->thread, NULL);
    pthread_cond_destroy(&slowness->known);
    pthread_mutex_destroy(&slowness->mutex);
}
