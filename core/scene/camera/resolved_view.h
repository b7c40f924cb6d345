/* resolved_view.h - scene, last step: resolves a view (pose, projection, fit) into a camera.
 *
 * Fit:    a pose without an eye shows the whole geometry, or one mesh. Near and far plane enclose the whole geometry,
 *         unless given.
 */
#ifndef ZR_RESOLVED_VIEW_H
#define ZR_RESOLVED_VIEW_H

#include "base/arena.h"
#include "base/run.h"
#include "base/status.h"
#include "core.h"
#include "scene/camera/view_camera.h"

/* Result of zr_resolved_view_find (core.h). */
struct zr_resolved_view {
    const struct zr_view *view;
    struct zr_bounds
        bounds; /* of the geometry; not valid if neither the view, the picture, a section nor an output needs them */
    struct zr_camera camera;         /* of the view, without its lens */
    const struct zr_lens_plan *lens; /* scene/camera/lens_plan.h; NULL: none */
    struct zr_camera flow_camera;    /* of the target of the channel flow, if that is an output */
};

/* Resolves the view as if the scene were not cut open, as zr_resolved_view_find does for one that is not. */
enum zr_status zr_whole_view_find(const struct zr_run *run, const struct zr_scene *scene,
                                  struct zr_resolved_view **out);

/* ---- the z-buffer of a base that has eye-space depth only ----
 *
 * Space:  eye-space depth along the view axis -> window depth, by the z and w rows of the projection.
 * Exact:  each depth is computed in double and rounded once. A rasterised z-buffer is interpolated from rounded
 * vertices, so coincident surfaces of the base and the scene may differ by some steps. For exact ties, the client gives
 * windowDepth.
 */

/* Sets *placed to the scene's base, NULL if it has none. A base with depth but without window_depth is copied, and the
 * copy gets a window_depth. Depth in front of the near plane becomes 0, depth beyond the far plane 1. The base has the
 * size of the window of `view`; `camera` is the resolved `view`.
 * Errors: ZR_BAD_SCENE if the z or w of the projection depends on x or y (an oblique near plane), ZR_NO_MEMORY,
 *         ZR_CANCELLED (by arena->cancel). */
enum zr_status zr_base_place(const struct zr_run *run, const struct zr_scene *scene, const struct zr_view *view,
                             const struct zr_camera *camera, const struct zr_base **placed);

#endif
