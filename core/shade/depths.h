/* depths.h - shade: a tile's owners -> how far they lie in front of the camera.
 *
 * How:  what is the same for all samples of a triangle is made once for it, of many triangles at once, and kept while
 *       the tile has more of its samples; then rows are computed, many samples at once.
 */
#ifndef ZR_DEPTHS_H
#define ZR_DEPTHS_H

#include "geometry/geometry.h"
#include "raster/tile.h"
#include "shade/eye_depth.h"

/* The tile's depths become scene units, and INFINITY where nobody owns the sample; owners stay as they are. `ends`: as
 * in struct zr_paint. Width and height are the window's. Returns the greatest depth that is not infinite, or 0. */
float zr_depths_tile(const struct zr_geometry *geometry, const struct zr_eye_depths *kernel,
                     uint64_t (*ends)(const uint32_t *owners, int32_t width), uint32_t width, uint32_t height,
                     struct zr_tile *tile);

#endif
