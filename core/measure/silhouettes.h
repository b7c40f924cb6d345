/* silhouettes.h - measure: how much of the silhouettes of two solids is common, seen along the axes of the file.
 *
 * Rays:  a grid along each axis, turned in its plane, so that no edges of usual models line up with its cells. A ray is
 *        in the silhouette if it meets a triangle. Open surfaces have silhouettes, too.
 * Error: half of the cells along the border of a silhouette may be wrong by half, mostly in both directions: some 1e-4.
 */
#ifndef ZR_SILHOUETTES_H
#define ZR_SILHOUETTES_H

#include "measure/solid.h"

enum { ZR_SILHOUETTE_RAYS = 512 };

/* Sets iou[k] for the view along axis k: rays in both silhouettes by rays in one at least. Takes scratch from the arena
 * and gives it back. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_silhouettes_find(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                                   uint32_t rays, double iou[3]);

#endif
