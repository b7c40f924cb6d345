/* draw_views.c - api: draws the views of a request, and hands them on one by one. */
#include <stdio.h>

#include "api/cancel.h"
#include "api/error.h"
#include "api/renderer.h"
#include "api/request.h"
#include "base/run.h"
#include "views/views.h"

enum { NAME_SIZE = 160 };

struct taking {
    zraster_take_view take;
    void *context;
    uint32_t count;
    struct zr_arena *arena; /* of names and lists of one view */
};

static enum zr_status hand_on(void *context, const struct zr_drawn_view *view, struct zr_error *error)
{
    const struct taking *t = context;
    const struct zr_files *files = view->files;
    struct zraster_file *list = zr_arena_alloc(t->arena, files->count, sizeof *list);
    char(*names)[NAME_SIZE] = zr_arena_alloc(t->arena, files->count, sizeof *names);
    (void)error;
    if (!list || !names) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < files->count; i++) {
        const struct zr_zip_entry *entry = &files->entries[i];
        snprintf(names[i], NAME_SIZE, "%s.%s", view->name, entry->name);
        list[i] = (struct zraster_file){names[i], entry->bytes, entry->size, files->types[i]};
    }
    const struct zraster_view made = {sizeof made,           view->number,         t->count, files->count, list,
                                      files->warnings.count, files->warnings.texts};
    const bool is_ended = t->take(t->context, &made) != 0;
    zr_arena_trim(t->arena, names, files->count, 0, sizeof *names);
    zr_arena_trim(t->arena, list, files->count, 0, sizeof *list);
    return is_ended ? ZR_CANCELLED : ZR_OK;
}

static enum zr_status draw_all(zraster *renderer, struct zr_arena *arena, const struct zraster_request *request,
                               struct taking *taking, struct zr_error *error)
{
    struct zr_run run = {.arena = arena, .team = zr_renderer_team(renderer), .error = error};
    struct zr_taken_request taken;
    struct zr_views views = {.set = NULL};
    enum zr_status status = zr_request_take(arena, request, false, &taken, error);
    if (status == ZR_OK) status = zr_views_read(&run, &taken.request, &renderer->limits, &views);
    if (status != ZR_OK) return status;
    if (!views.set) return zr_error_add(error, ZR_BAD_SCENE, NULL, "one view; give views, turntable, orbit or animate");
    if (views.scene->sheet.is_on)
        return zr_error_add(error, ZR_BAD_SCENE, "/sheet", "one picture of all views, which are not drawn one by one");
    run.cancel = zr_cancel_flag(taken.cancel);
    status = zr_views_plan(&run, &views);
    if (status != ZR_OK) return status;
    taking->count = views.set->count;
    taking->arena = arena;
    return zr_views_draw_each(&run, &views, (struct zr_views_taker){hand_on, taking, 0});
}

zraster_status zraster_draw_views(zraster *renderer, const struct zraster_request *request, zraster_take_view take,
                                  void *context, zraster_error **error)
{
    struct zr_error faults = {0};
    struct taking taking = {.take = take, .context = context};
    const locale_t before = zr_renderer_enter(renderer);
    struct zr_arena *arena = zr_renderer_take(renderer, ZR_ARENA_SCRATCH, 0);
    const enum zr_status status = arena ? draw_all(renderer, arena, request, &taking, &faults) : ZR_NO_MEMORY;
    zr_renderer_give(renderer, arena, ZR_ARENA_SCRATCH);
    zr_renderer_leave(before);
    return zr_error_give(status, &faults, error);
}
