/* build.h - geometry, the whole floor: polygons and lines -> what is drawn in the window (geometry.h). */
#ifndef ZR_BUILD_H
#define ZR_BUILD_H

#include "base/team.h"
#include "geometry/geometry.h"

/* Everything points into the arena, and to the scene. With `written`, every record is written out, so that
 * record i is triangles[i]: what algorithms take that know no batches. ZR_NO_MEMORY or ZR_CANCELLED, else ZR_OK. */
enum zr_status zr_geometry_build(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                 const struct zr_camera *camera, const struct zr_cancel *cancel, bool written,
                                 struct zr_geometry *geometry);

#endif
