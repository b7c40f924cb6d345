/* flow.h - scene: the target of the channel flow: the same meshes in another view, or with other matrices.
 *
 * Camera: a target without a view of its own has the camera of the scene's view, fitted to the scene's matrices. Only
 *         its near and far plane, unless given, enclose the moved geometry.
 */
#ifndef ZR_FLOW_H
#define ZR_FLOW_H

#include "base/run.h"
#include "scene/camera/view_camera.h"

/* Copies the scene with the matrices of its target. The copy keeps the view. False without memory. */
bool zr_flow_scene(struct zr_arena *arena, const struct zr_scene *scene, struct zr_scene *out);

/* Finds the camera of the scene's target; that of the view if the scene has none. Errors: those of zr_camera_resolve,
 * at the output's key `to`. */
enum zr_status zr_flow_camera_find(const struct zr_run *run, const struct zr_scene *scene, const struct zr_camera *own,
                                   struct zr_camera *camera);

#endif
