/* tiles.h - render: all tiles of a window, one after the other by each thread: visibility in it, and its pixels in
 * every channel. Nothing of a tile is kept.
 */
#ifndef ZR_TILES_H
#define ZR_TILES_H

#include "render/tile_source.h"
#include "shade/frame.h"

/* Tile `number`, ready to be shaded: opaque and masked surfaces. One thread a tile. False where it
 * was cancelled, or there was no memory. */
bool zr_tile_find_visible(const struct zr_tile_source *tiles, uint32_t number, const struct zr_cancel *cancel,
                          struct zr_tile *tile);

/* Writes all channels of the frame, and what of it is known then: reaches, covered_pixels, deepest. ZR_OK, ZR_CANCELLED
 * or ZR_NO_MEMORY. */
enum zr_status zr_tiles_draw(struct zr_arena *arena, struct zr_team *team, const struct zr_tile_source *tiles,
                             const struct zr_cancel *cancel, struct zr_frame *frame);

#endif
