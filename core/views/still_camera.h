/* still_camera.h - views: one camera that sees all frames of an animation. */
#ifndef ZR_STILL_CAMERA_H
#define ZR_STILL_CAMERA_H

#include "base/run.h"
#include "views/views.h"

/* Fits the view of the scene to the geometry of all frames together, so that it does not move with them; a view that is
 * not fitted stays as it is. `arena` has the result of each frame until the call ends. Errors are those of
 * zr_view_scene and of the view. */
enum zr_status zr_still_camera_find(const struct zr_run *run, struct zr_views *views);

#endif
