#include "scene/camera/resolved_view.h"

#include <math.h>
#include <stdio.h>

#include "base/cancel.h"
#include "base/run.h"
#include "scene/camera/flow.h"
#include "scene/camera/lens_plan.h"
#include "scene/output.h"
#include "scene/picture.h"

enum zr_status zr_whole_view_find(const struct zr_run *run, const struct zr_scene *scene, struct zr_resolved_view **out)
{
    const struct zr_view *view = &scene->views[0];
    struct zr_resolved_view *resolved = zr_arena_zero(run->arena, 1, sizeof *resolved);
    *out = resolved;
    if (!resolved) return ZR_NO_MEMORY;
    resolved->view = view;
    if (zr_view_needs_bounds(view) || zr_view_wants(view, ZR_CHANNEL_INFO) || zr_view_annotates(view) || scene->picture->is_linear ||
        scene->sections.count > 0)
        resolved->bounds = zr_bounds_of(scene, run->team, run->cancel);
    const enum zr_status status = zr_camera_resolve(run, scene, view, &resolved->bounds, &resolved->camera);
    if (status != ZR_OK) return status;
    if (view->lens.model != ZR_LENS_NONE) return zr_lens_plan_make(run, view, &resolved->lens);
    if (!zr_view_wants(view, ZR_CHANNEL_FLOW)) return ZR_OK;
    return zr_flow_camera_find(run, scene, &resolved->camera, &resolved->flow_camera);
}

enum { PIXELS_PER_CANCEL_CHECK = 1 << 16 };

/* Tolerance of window depth: rounding may move a depth on the near or far plane beyond it. */
static const double rounding = 1e-5;

/* Entries of the projection's rows z and w for a point (0, 0, -depth). */
struct rows {
    double z_slope, z, w_slope, w;
};

/* Returns the window depth, clamped to 0..1, and counts clamped values. */
static float window_depth(const struct rows *rows, float depth, uint64_t *clamped)
{
    if (depth == INFINITY) return 1.0f;
    double w = rows->w - rows->w_slope * (double)depth;
    double z = rows->z - rows->z_slope * (double)depth;
    double window = w > 0.0 ? 0.5 * (z / w) + 0.5 : -1.0; /* behind the eye */
    *clamped += window < -rounding || window > 1.0 + rounding;
    return window > 0.0 ? window < 1.0 ? (float)window : 1.0f : 0.0f;
}

enum zr_status zr_base_place(const struct zr_run *run, const struct zr_scene *scene, const struct zr_view *view,
                             const struct zr_camera *camera, const struct zr_base **placed)
{
    *placed = scene->base;
    if (!scene->base || scene->base->window_depth || !scene->base->depth) return ZR_OK;
    const float *m = camera->projection.m;
    if (m[2] != 0.0f || m[6] != 0.0f || m[3] != 0.0f || m[7] != 0.0f)
        return zr_error_add(run->error, ZR_BAD_SCENE, "/base/depth",
                            "cannot be converted, since the z of this projectionMatrix depends on x and y: "
                            "give windowDepth");
    size_t pixels = (size_t)view->width * view->height;
    struct zr_base *base = zr_arena_alloc(run->arena, 1, sizeof *base);
    float *made = zr_arena_alloc(run->arena, pixels, sizeof *made);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    uint64_t clamped = 0;
    const struct rows rows = {(double)m[10], (double)m[14], (double)m[11], (double)m[15]};
    for (size_t i = 0; i < pixels; i++) {
        if (i % PIXELS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->arena->cancel)) return ZR_CANCELLED;
        made[i] = window_depth(&rows, scene->base->depth[i], &clamped);
    }
    *base = *scene->base;
    base->clamped_depths = clamped;
    base->window_depth = made;
    *placed = base;
    return ZR_OK;
}
