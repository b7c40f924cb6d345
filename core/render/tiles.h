/* tiles.h - render: draws a window tile by tile, on all threads: visibility, then the pixels of every channel. */
#ifndef ZR_TILES_H
#define ZR_TILES_H

#include "base/run.h"
#include "render/layers/tile_source.h"
#include "shade/frame.h"

/* Finds the opaque and masked surfaces of tile `number`, ready for shading. One thread per tile. Returns false if
 * cancelled or out of memory. */
bool zr_tile_find_visible(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                          struct zr_tile *tile);

/* Writes all channels of the frame, and its spans, covered_pixels and deepest. Returns ZR_OK, ZR_CANCELLED or
 * ZR_NO_MEMORY. */
enum zr_status zr_tiles_draw(const struct zr_run *run, const struct zr_tile_source *tiles, struct zr_frame *frame);

#endif
