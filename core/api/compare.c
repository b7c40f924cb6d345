/* compare.c - api: compares two scenes that were read. */
#include <stdlib.h>
#include <string.h>

#include "api/cancel.h"
#include "api/error.h"
#include "api/scene.h"
#include "base/run.h"
#include "request/compare.h"

struct zraster_comparison {
    bool is_same;
    char json[];
};

/* Copies the answer, whose arena is given back. */
static enum zr_status take(const struct zr_compare_answer *answer, zraster_comparison **out)
{
    zraster_comparison *comparison = malloc(sizeof *comparison + answer->size + 1);
    if (!comparison) return ZR_NO_MEMORY;
    comparison->is_same = answer->is_same;
    memcpy(comparison->json, answer->json, answer->size + 1);
    *out = comparison;
    return ZR_OK;
}

zraster_status zraster_compare(const zraster_scene *a, const zraster_scene *b, const char *query,
                               zraster_cancel *cancel, zraster_comparison **comparison, zraster_error **error)
{
    struct zr_error faults = {0};
    struct zr_compare_answer answer;
    enum zr_status status = ZR_NO_MEMORY;
    zraster *renderer = a->renderer;
    *comparison = NULL;
    const locale_t before = zr_renderer_enter(renderer);
    struct zr_arena *arena = zr_renderer_take(renderer, ZR_ARENA_SCRATCH, a->arena->held + b->arena->held);
    if (arena) {
        const struct zr_run run = {
            .arena = arena, .team = zr_renderer_team(renderer), .cancel = zr_cancel_flag(cancel), .error = &faults};
        arena->cancel = run.cancel;
        status = zr_compare(&run, zr_kept_scene(a->kept), zr_kept_scene(b->kept), query, &answer);
        arena->cancel = NULL;
    }
    if (status == ZR_OK) status = take(&answer, comparison);
    zr_renderer_give(renderer, arena, ZR_ARENA_SCRATCH);
    zr_renderer_leave(before);
    return zr_error_give(status, &faults, error);
}

const char *zraster_comparison_json(const zraster_comparison *comparison)
{
    return comparison->json;
}

int zraster_comparison_same(const zraster_comparison *comparison)
{
    return comparison->is_same;
}

void zraster_comparison_free(zraster_comparison *comparison)
{
    free(comparison);
}
