/* depths.h - shade: converts a tile's owners to depths along the view axis.
 *
 * How: planes are made once per triangle, for many triangles at a time, and cached within the tile. Rows are then
 *      computed many samples at a time.
 */
#ifndef ZR_DEPTHS_H
#define ZR_DEPTHS_H

#include "geometry/geometry.h"
#include "raster/tile.h"
#include "shade/eye_depth.h"

/* Overwrites the tile's depths with depths in scene units; uncovered samples get INFINITY. Owners are unchanged.
 * `ends`: as in struct zr_paint. Width and height are the window's. Returns the greatest finite depth, or 0. */
float zr_depths_tile(const struct zr_geometry *geometry, const struct zr_eye_depths *kernel,
                     uint64_t (*ends)(const uint32_t *owners, int32_t width), uint32_t width, uint32_t height,
                     struct zr_tile *tile);

#endif
