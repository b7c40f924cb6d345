/* base_depth.h - scene: the z-buffer of a base that has eye-space depth only.
 *
 * Space:  eye-space depth along the view axis -> window depth, by the z and w rows of the projection.
 * Exact:  each depth is computed in double and rounded once. A rasterised z-buffer is interpolated from rounded
 * vertices, so coincident surfaces of the base and the scene may differ by some steps. For exact ties, the client gives
 * windowDepth.
 */
#ifndef ZR_BASE_DEPTH_H
#define ZR_BASE_DEPTH_H

#include "base/arena.h"
#include "scene/camera.h"

/* Sets *placed to the scene's base, NULL if it has none. A base with depth but without window_depth is copied, and the
 * copy gets a window_depth. Depth in front of the near plane becomes 0, depth beyond the far plane 1. The base has the
 * size of the window of `view`; `camera` is the resolved `view`.
 * Errors: ZR_BAD_SCENE if the z or w of the projection depends on x or y (an oblique near plane), ZR_NO_MEMORY,
 *         ZR_CANCELLED (by arena->cancel). */
enum zr_status zr_base_place(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_view *view,
                             const struct zr_camera *camera, const struct zr_base **placed, struct zr_error *error);

#endif
