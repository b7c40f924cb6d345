/* cap_hull.h - geometry: corners around most of a cap.
 *
 * Space:  object space, projected along the axis that is nearest to the normal; in double.
 * Why:    every triangle in the plane of a cap has its depth and attributes, and edges of rings decide coverage. Few
 *         large triangles therefore serve nearly all samples, however many corners the cap has. */
#ifndef ZR_CAP_HULL_H
#define ZR_CAP_HULL_H

#include "scene/scene.h"

enum { ZR_CAP_HULL_MAX = 16 };

/* Finds the corners that are farthest in ZR_CAP_HULL_MAX directions, in the order of these, without repetitions. Writes
 * slots of mesh->indices. Ties go to the lower slot. Returns their number. */
uint32_t zr_cap_hull_find(const struct zr_mesh *mesh, const struct zr_rings *rings, uint32_t slots[ZR_CAP_HULL_MAX]);

#endif
