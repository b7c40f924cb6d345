/* build.h - geometry, entry point of the room: scene and camera -> draws in window space (geometry.h). */
#ifndef ZR_BUILD_H
#define ZR_BUILD_H

#include "base/run.h"
#include "base/team.h"
#include "geometry/geometry.h"

/* Fills `geometry`, whose arrays live in the arena; draws point to the scene's meshes and materials. The team's threads
 * transform the vertices with the team's instruction set; the calling thread makes the draws. With `singly`, each
 * primitive is placed by itself and all draws are `counted`; else the points of a mesh are a cloud, which is transformed
 * and counted when it is binned (raster/cloud_bins.h). Returns ZR_OK, ZR_CANCELLED, or ZR_NO_MEMORY if the arena
 * failed or a count would exceed ZR_GEOMETRY_MAX. */
enum zr_status zr_geometry_build(const struct zr_run *run, const struct zr_scene *scene, const struct zr_camera *camera,
                                 const struct zr_window *window, bool singly, struct zr_geometry *geometry);

#endif
