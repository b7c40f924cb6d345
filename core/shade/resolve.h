/* resolve.h - shade: the visibility of a tile -> its pixels in every channel.
 *
 * Colour and depth are planes over the window (raster/plane.h), made again for the
 * records that are seen. Exact: colour follows the reference's rule 9.
 */
#ifndef ZR_RESOLVE_H
#define ZR_RESOLVE_H

#include "raster/tile.h"
#include "shade/frame.h"
#include "shade/paint.h"

/* Writes the tile's part of each channel that `frame` has, and returns how many of its
 * pixels belong to a record. The tile is used up. One writer a pixel: different tiles may be resolved at once. */
uint32_t zr_resolve_tile(const struct zr_geometry *geometry, const struct zr_paint *paint, zr_vec4 background,
                         struct zr_tile *tile, const struct zr_frame *frame);

#endif
