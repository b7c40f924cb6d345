/* visible_points.h - shade: the visible points of a tile's samples: channels distance, position, barycentrics and
 * texcoord.
 *
 * Space:  the channel's; eye space is the camera's.
 * Exact:  in double, on the plane of the channel depth (eye_depth.h), so -z of a point in eye space is its depth.
 *         Barycentrics are linear on the mesh's own triangle, independent of clipping.
 *         Positions and flow are of one point, that with the pixel's depth on its ray, also at rims, where
 *         barycentrics and texture coordinates are kept within the triangle.
 */
#ifndef ZR_VISIBLE_POINTS_H
#define ZR_VISIBLE_POINTS_H

#include "geometry/geometry.h"
#include "raster/tile.h"
#include "shade/depths.h"
#include "shade/eye/eye_depth.h"
#include "shade/frame.h"

/* Returns true if the frame has one of the channels. */
bool zr_visible_points_are_wanted(const struct zr_frame *frame);

/* Writes the tile's part of those channels that the frame has. All samples of the tile are written. `position`: space
 * of the channel position. */
void zr_visible_points_tile(const struct zr_depths_of *of, enum zr_space position, const struct zr_tile *tile,
                            const struct zr_frame *frame);

/* Intersects the ray of sample x, y (from the window's lower left) with primitive `owner` - 1, covered or not. Writes
 * the depth in scene units and the point in world space. */
void zr_visible_point_find(const struct zr_geometry *geometry, const struct zr_eye_depths *kernel,
                           const struct zr_frame *frame, uint32_t owner, int32_t x, int32_t y, float *depth,
                           float position[3]);

#endif
