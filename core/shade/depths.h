/* depths.h - shade: converts a tile's owners to depths along the view axis, or to visible points.
 *
 * How: planes are made once per triangle, for many triangles at a time, and cached within the tile. Rows are then
 *      computed many samples at a time.
 */
#ifndef ZR_DEPTHS_H
#define ZR_DEPTHS_H

#include "geometry/geometry.h"
#include "raster/tile.h"
#include "shade/eye/eye_depth.h"
#include "shade/eye/eye_points.h"

/* Overwrites the tile's depths with depths in scene units; uncovered samples get INFINITY. Owners are unchanged.
 * `ends`: as in struct zr_paint. Width and height are the window's. Returns the greatest finite depth, or 0. */
float zr_depths_tile(const struct zr_geometry *geometry, const struct zr_eye_depths *kernel,
                     uint64_t (*ends)(const uint32_t *owners, int32_t width), uint32_t width, uint32_t height,
                     struct zr_tile *tile);

/* A geometry, the kernels, and `ends` of struct zr_paint. */
struct zr_depths_of {
    const struct zr_geometry *geometry;
    const struct zr_eye_depths *kernel;
    const struct zr_eye_points *points;
    uint64_t (*ends)(const uint32_t *owners, int32_t width);
};

/* Writes the tile's part of channels of visible points. All samples of the tile are written. */
void zr_depths_fill_points(const struct zr_depths_of *of, const struct zr_eye_rays *rays, const struct zr_tile *tile,
                           const struct zr_eye_targets *to);

#endif
