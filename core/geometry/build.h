/* build.h - geometry, the whole floor: a scene, seen by a camera -> what is drawn in the window (geometry.h). */
#ifndef ZR_BUILD_H
#define ZR_BUILD_H

#include "base/team.h"
#include "geometry/geometry.h"

/* Everything points into the arena, and to the scene. Vertices are placed by the team's threads and instruction set;
 * the draws are made by the calling thread. singly: all primitives are placed one by one, and `counted`. ZR_OK,
 * ZR_CANCELLED, or ZR_NO_MEMORY where the arena failed or there would be too much of something. */
enum zr_status zr_geometry_build(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                 const struct zr_camera *camera, const struct zr_window *window,
                                 const struct zr_cancel *cancel, bool singly, struct zr_geometry *geometry);

#endif
