#include "api/scene.h"

#include <stdlib.h>

#include "api/error.h"
#include "api/request.h"
#include "base/run.h"

static enum zr_status read_into(zraster_scene *scene, const struct zraster_request *given, struct zr_error *error)
{
    const struct zr_run run = {.arena = scene->arena, .team = zr_renderer_team(scene->renderer), .error = error};
    struct zr_taken_request taken;
    struct zr_kept *kept = NULL;
    enum zr_status status = zr_request_take(scene->arena, given, true, &taken, error);
    if (status == ZR_OK) status = zr_scene_keep(&run, &taken.request, &scene->renderer->limits, &kept);
    scene->kept = kept;
    return status;
}

zraster_status zraster_scene_read(zraster *renderer, const struct zraster_request *request, zraster_scene **out,
                                  zraster_error **error)
{
    struct zr_error faults = {0};
    zraster_scene *scene = calloc(1, sizeof *scene);
    *out = NULL;
    if (!scene) return zr_error_give(ZR_NO_MEMORY, &faults, error);
    const locale_t before = zr_renderer_enter(renderer);
    scene->renderer = zr_renderer_use(renderer);
    scene->arena = zr_renderer_take(renderer, ZR_ARENA_RESULT, 0);
    const enum zr_status status = scene->arena ? read_into(scene, request, &faults) : ZR_NO_MEMORY;
    if (status == ZR_OK)
        *out = scene;
    else
        zraster_scene_free(scene);
    zr_renderer_leave(before);
    return zr_error_give(status, &faults, error);
}

size_t zraster_scene_memory(const zraster_scene *scene)
{
    return scene ? scene->arena->held + scene->arena->spare_bytes : 0;
}

void zraster_scene_free(zraster_scene *scene)
{
    if (!scene) return;
    zr_renderer_give(scene->renderer, scene->arena, ZR_ARENA_RESULT);
    zraster_close(scene->renderer);
    free(scene);
}
