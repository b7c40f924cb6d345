/* draw.c - library: draws a request, or a kept scene with changes. */
#include <stdlib.h>

#include "library/cancel.h"
#include "library/error.h"
#include "library/picture.h"
#include "library/request.h"
#include "library/scene.h"

/* A call that makes a scene in scratch memory and draws it. */
struct drawing {
    zraster *renderer;
    const struct zr_kept *kept; /* NULL: the request has a scene of its own */
    const struct zraster_request *request;
    struct zr_arena *arena;
};

static enum zr_status read(const struct drawing *d, const struct zr_request *request, const struct zr_scene **scene,
                           struct zr_error *error)
{
    struct zr_team *team = zr_renderer_team(d->renderer);
    return d->kept ? zr_scene_change(d->arena, team, d->kept, request, scene, error)
                   : zr_scene_read(d->arena, team, request, &d->renderer->limits, scene, error);
}

static enum zr_status run(const struct drawing *d, zraster_picture **picture, struct zr_error *error)
{
    struct zr_taken_request taken;
    const struct zr_scene *scene;
    if (!d->request && d->kept) return zr_picture_make(d->renderer, zr_kept_scene(d->kept), NULL, picture, error);
    enum zr_status status = zr_request_take(d->arena, d->request, false, &taken, error);
    if (status == ZR_OK) status = read(d, &taken.request, &scene, error);
    return status == ZR_OK ? zr_picture_make(d->renderer, scene, taken.cancel, picture, error) : status;
}

static zraster_status draw(struct drawing *d, zraster_picture **picture, zraster_error **error)
{
    struct zr_error faults = {0};
    *picture = NULL;
    const locale_t before = zr_renderer_enter(d->renderer);
    d->arena = zr_renderer_take(d->renderer, ZR_ARENA_SCRATCH);
    const enum zr_status status = d->arena ? run(d, picture, &faults) : ZR_NO_MEMORY;
    zr_renderer_give(d->renderer, d->arena, ZR_ARENA_SCRATCH);
    zr_renderer_leave(before);
    return zr_error_give(status, &faults, error);
}

zraster_status zraster_draw(zraster *renderer, const struct zraster_request *request, zraster_picture **picture,
                            zraster_error **error)
{
    struct drawing drawing = {.renderer = renderer, .request = request};
    return draw(&drawing, picture, error);
}

zraster_status zraster_scene_draw(const zraster_scene *scene, const struct zraster_request *change,
                                  zraster_picture **picture, zraster_error **error)
{
    struct drawing drawing = {.renderer = scene->renderer, .kept = scene->kept, .request = change};
    return draw(&drawing, picture, error);
}
