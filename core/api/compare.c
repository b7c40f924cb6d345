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
    zraster_scene *scene; /* NULL: none was asked for */
    char json[];
};

/* Copies the answer. `result` holds its scene and becomes that of it. */
static enum zr_status take(zraster *renderer, const struct zr_compare_answer *answer, struct zr_arena **result,
                           zraster_comparison **out)
{
    zraster_comparison *comparison = malloc(sizeof *comparison + answer->size + 1);
    zraster_scene *scene = answer->scene ? malloc(sizeof *scene) : NULL;
    if (!comparison || (answer->scene && !scene)) {
        free(comparison);
        free(scene);
        return ZR_NO_MEMORY;
    }
    if (scene) {
        *scene = (zraster_scene){.renderer = zr_renderer_use(renderer), .arena = *result, .kept = answer->scene};
        *result = NULL;
    }
    comparison->scene = scene;
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
    struct zr_arena *scratch = zr_renderer_take(renderer, ZR_ARENA_SCRATCH, a->arena->held + b->arena->held),
                    *result = zr_renderer_take(renderer, ZR_ARENA_RESULT, 0);
    if (scratch && result) {
        const struct zr_run run = {.arena = result,
                                   .scratch = scratch,
                                   .team = zr_renderer_team(renderer),
                                   .cancel = zr_cancel_flag(cancel),
                                   .error = &faults};
        scratch->cancel = result->cancel = run.cancel;
        status = zr_compare(&run, zr_kept_scene(a->kept), zr_kept_scene(b->kept), query, &answer);
        scratch->cancel = result->cancel = NULL;
    }
    if (status == ZR_OK) status = take(renderer, &answer, &result, comparison);
    zr_renderer_give(renderer, result, ZR_ARENA_RESULT);
    zr_renderer_give(renderer, scratch, ZR_ARENA_SCRATCH);
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

const zraster_scene *zraster_comparison_scene(const zraster_comparison *comparison)
{
    return comparison->scene;
}

void zraster_comparison_free(zraster_comparison *comparison)
{
    if (comparison) zraster_scene_free(comparison->scene);
    free(comparison);
}
