/* drawing.c - api: technical drawings of a scene that was read. */
#include <stdlib.h>

#include "api/cancel.h"
#include "api/error.h"
#include "api/scene.h"
#include "base/run.h"
#include "request/drawing_file.h"

struct zraster_drawing {
    zraster *renderer;
    struct zr_arena *arena;
    struct zr_drawing_file file;
};

static zraster_drawing *open_drawing(zraster *renderer)
{
    zraster_drawing *drawing = calloc(1, sizeof *drawing);
    if (!drawing) return NULL;
    drawing->renderer = zr_renderer_use(renderer);
    drawing->arena = zr_renderer_take(renderer, ZR_ARENA_RESULT, 0);
    if (drawing->arena) return drawing;
    zraster_drawing_free(drawing);
    return NULL;
}

static enum zr_status make(const zraster_scene *scene, const char *query, zraster_cancel *cancel,
                           zraster_drawing *drawing, struct zr_error *faults)
{
    struct zr_arena *scratch = zr_renderer_take(scene->renderer, ZR_ARENA_SCRATCH, scene->arena->held);
    if (!scratch) return ZR_NO_MEMORY;
    const struct zr_run run = {.arena = drawing->arena,
                               .scratch = scratch,
                               .team = zr_renderer_team(scene->renderer),
                               .cancel = zr_cancel_flag(cancel),
                               .error = faults};
    scratch->cancel = drawing->arena->cancel = run.cancel;
    const enum zr_status status = zr_drawing_file_make(&run, zr_kept_scene(scene->kept), query, &drawing->file);
    scratch->cancel = drawing->arena->cancel = NULL;
    zr_renderer_give(scene->renderer, scratch, ZR_ARENA_SCRATCH);
    return status;
}

zraster_status zraster_drawing_make(const zraster_scene *scene, const char *query, zraster_cancel *cancel,
                                    zraster_drawing **out, zraster_error **error)
{
    struct zr_error faults = {0};
    *out = NULL;
    const locale_t before = zr_renderer_enter(scene->renderer);
    zraster_drawing *drawing = open_drawing(scene->renderer);
    const enum zr_status status = drawing ? make(scene, query, cancel, drawing, &faults) : ZR_NO_MEMORY;
    if (status == ZR_OK)
        *out = drawing;
    else
        zraster_drawing_free(drawing);
    zr_renderer_leave(before);
    return zr_error_give(status, &faults, error);
}

struct zraster_bytes zraster_drawing_file(const zraster_drawing *drawing)
{
    return (struct zraster_bytes){
        .data = drawing->file.bytes, .size = drawing->file.size, .type = drawing->file.content_type};
}

const char *zraster_drawing_json(const zraster_drawing *drawing)
{
    return drawing->file.json;
}

const char *zraster_drawing_warning(const zraster_drawing *drawing, size_t i)
{
    return i < drawing->file.warnings.count ? drawing->file.warnings.texts[i] : NULL;
}

void zraster_drawing_free(zraster_drawing *drawing)
{
    if (!drawing) return;
    zr_renderer_give(drawing->renderer, drawing->arena, ZR_ARENA_RESULT);
    zraster_close(drawing->renderer);
    free(drawing);
}
