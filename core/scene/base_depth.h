/* base_depth.h - scene: the z-buffer of a base that has eye-space depth only.
 *
 * Space:  eye-space depth along the view axis -> window depth, by the z and w rows of the
 *         projection. Correct to the last rounding, but no more: a z-buffer is interpolated
 *         from rounded vertices, so that surfaces of the base and new ones at the very same
 *         place may differ by some steps. Whoever needs ties exact gives windowDepth.
 */
#ifndef ZR_BASE_DEPTH_H
#define ZR_BASE_DEPTH_H

#include "base/arena.h"
#include "scene/camera.h"

/* The base is as large as the window of `view`, which `camera` is of. *placed becomes the scene's base with its
 * window_depth made, where it had none and has depth; NULL where the scene has no base. Depth in front of the near
 * plane becomes 0, depth beyond the far plane 1. ZR_BAD_SCENE where the projection's depth changes across the window as
 * well (an oblique near plane), else ZR_NO_MEMORY, ZR_CANCELLED (by arena->cancel) or ZR_OK. */
enum zr_status zr_base_place(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_view *view,
                             const struct zr_camera *camera, const struct zr_base **placed, struct zr_error *error);

#endif
