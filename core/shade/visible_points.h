/* visible_points.h - shade: a tile's owners -> the points of the mesh that its samples see: channels distance,
 * position, barycentrics and texcoord.
 *
 * Space:  as the channel has it; eye space is the camera's.
 * Exact:  in double, on the plane that the channel depth uses (eye_depth.h), so that -z of a point in eye space is its
 *         depth. Shares of corners are linear on the mesh's own triangle, whatever clipping made of it.
 */
#ifndef ZR_VISIBLE_POINTS_H
#define ZR_VISIBLE_POINTS_H

#include "geometry/geometry.h"
#include "raster/tile.h"
#include "shade/eye_depth.h"
#include "shade/frame.h"

/* True where the frame has one of the channels. */
bool zr_visible_points_are_wanted(const struct zr_frame *frame);

/* Writes the tile's part of those of the channels that the frame has. All samples of the tile are written. `ends`: as
 * in struct zr_paint. position: in which space. */
void zr_visible_points_tile(const struct zr_geometry *geometry, const struct zr_eye_depths *kernel,
                            uint64_t (*ends)(const uint32_t *owners, int32_t width), enum zr_space position,
                            const struct zr_tile *tile, const struct zr_frame *frame);

/* Where the sample x, y (from the window's lower left) sees primitive `owner` - 1, whether that covers it or not: its
 * depth in scene units, and the point in world space. */
void zr_visible_point_find(const struct zr_geometry *geometry, const struct zr_eye_depths *kernel,
                           const struct zr_frame *frame, uint32_t owner, int32_t x, int32_t y, float *depth,
                           float position[3]);

#endif
