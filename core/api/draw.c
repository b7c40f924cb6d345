/* draw.c - api: draws a request, or a kept scene with changes. */
#include <stdlib.h>

#include "api/cancel.h"
#include "api/error.h"
#include "api/picture.h"
#include "api/request.h"
#include "api/scene.h"
#include "base/run.h"
#include "views/views.h"

/* A call that makes a scene in scratch memory and draws it. */
struct drawing {
    zraster *renderer;
    const struct zr_kept *kept; /* NULL: the request has a scene of its own */
    size_t kept_bytes;          /* of its arena */
    const struct zraster_request *request;
    struct zr_arena *arena;
};

/* Reads the scene, or changes the kept one, which gives a scene with one view. */
static enum zr_status read(const struct drawing *d, const struct zr_request *request, struct zr_views *views,
                           struct zr_error *error)
{
    const struct zr_run run = {.arena = d->arena, .team = zr_renderer_team(d->renderer), .error = error};
    *views = (struct zr_views){.set = NULL};
    return d->kept ? zr_scene_change(&run, d->kept, request, &views->scene)
                   : zr_views_read(&run, request, &d->renderer->limits, views);
}

static enum zr_status make(const struct drawing *d, struct zr_views *views, zraster_cancel *cancel,
                           zraster_picture **picture, struct zr_error *error)
{
    return views->set
               ? zr_picture_make_views(d->renderer, views, cancel, picture, error)
               : zr_picture_make(d->renderer, views->scene, d->kept_bytes + d->arena->held, cancel, picture, error);
}

static enum zr_status run(const struct drawing *d, zraster_picture **picture, struct zr_error *error)
{
    struct zr_taken_request taken;
    struct zr_views views;
    if (!d->request && d->kept) {
        views = zr_views_of_kept(d->kept);
        return make(d, &views, NULL, picture, error);
    }
    enum zr_status status = zr_request_take(d->arena, d->request, false, &taken, error);
    if (status == ZR_OK) status = read(d, &taken.request, &views, error);
    views.progress = taken.progress;
    views.progress_context = taken.progress_context;
    return status == ZR_OK ? make(d, &views, taken.cancel, picture, error) : status;
}

static zraster_status draw(struct drawing *d, zraster_picture **picture, zraster_error **error)
{
    struct zr_error faults = {0};
    *picture = NULL;
    const locale_t before = zr_renderer_enter(d->renderer);
    d->arena = zr_renderer_take(d->renderer, ZR_ARENA_SCRATCH, d->kept_bytes);
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
    struct drawing drawing = {
        .renderer = scene->renderer, .kept = scene->kept, .kept_bytes = scene->arena->held, .request = change};
    return draw(&drawing, picture, error);
}
