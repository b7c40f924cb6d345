/* render.c - the pipeline, from top to bottom: each STAGE of run_pipeline is one. */
#include "zraster.h"

#include "geometry/build.h"
#include "raster/visibility.h"
#include "scene/base_depth.h"
#include "scene/resolved_view.h"
#include "scene/scene.h"
#include "shade/frame.h"
#include "shade/paint.h"
#include "shade/surfaces.h"
#include "shade/tiles.h"

/* Goes on only where the stage before went well. */
#define STAGE(call)                                                                                                    \
    if (status == ZR_OK) status = (call)

static enum zr_status run_pipeline(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                   const struct zr_resolved_view *resolved, const struct zr_cancel *cancel,
                                   struct zr_frame *frame, struct zr_error *error)
{
    const struct zr_view *view = &scene->views[0];
    const uint32_t width = view->width, height = view->height;
    zr_visibility_fn *window_at_once = zr_visibility_of(scene->algorithm); /* else tile by tile */
    enum zr_status status = ZR_OK;
    struct zr_geometry geometry;
    struct zr_surfaces surfaces;
    const struct zr_payload *payloads = NULL;
    struct zr_visible visible;
    struct zr_samples samples;
    struct zr_tiles tiles = {scene, &geometry, &surfaces, &visible, window_at_once ? &samples : NULL};

    if (!resolved) status = zr_resolved_view_find(arena, team, scene, cancel, &resolved, error);
    STAGE(zr_frame_make(arena, view, resolved, frame));
    STAGE(zr_base_place(arena, scene, &frame->camera, &frame->base, error));
    STAGE(zr_geometry_build(arena, team, scene, &frame->camera, cancel, window_at_once != NULL, &geometry));
    STAGE(zr_surfaces_make(arena, team, scene, &frame->camera, &geometry, cancel, &surfaces));
    if (window_at_once) {
        STAGE(zr_visibility_window(arena, &geometry, window_at_once, width, height, frame->base, cancel, &samples));
    } else {
        if (frame->color)
            STAGE(zr_paint_prepare(arena, team, &geometry, &surfaces, (uint64_t)width * height, &payloads));
        STAGE(zr_visible_make(arena, team, &geometry, payloads, width, height, cancel, &visible));
    }
    STAGE(zr_tiles_draw(arena, team, &tiles, cancel, frame));
    if (status != ZR_OK) return status;
    frame->counts = geometry.counts;
    if (!window_at_once) zr_counts_add(&frame->counts, &visible.bins.counts);
    return ZR_OK;
}

enum zr_status zr_render(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                         const struct zr_resolved_view *resolved, const struct zr_cancel *cancel,
                         const struct zr_frame **out, struct zr_error *error)
{
    struct zr_frame *frame = zr_arena_zero(arena, 1, sizeof *frame);
    enum zr_status status = frame ? run_pipeline(arena, team, scene, resolved, cancel, frame, error) : ZR_NO_MEMORY;
    if (status == ZR_NO_MEMORY)
        zr_error_add(error, status, NULL, "rendering needs more than the %zu bytes a request may use", arena->ceiling);
    if (status == ZR_CANCELLED) zr_error_add(error, status, NULL, "rendering was stopped before it was done");
    if (status == ZR_INTERNAL) zr_error_add(error, status, NULL, "the algorithm failed");
    *out = frame;
    return status;
}
