/* tile.h - raster: what one thread works on: a square of the window.
 *
 * Space:  window space, y up; row 0 of a tile is its lowest.
 * Why:    depth and owner of 64x64 samples stay in the first-level cache until the
 *         tile is resolved to channels, and no other thread ever sees them.
 */
#ifndef ZR_TILE_H
#define ZR_TILE_H

#include <stddef.h>
#include <stdint.h>

enum { ZR_TILE_SIZE = 64 };

struct zr_tile {
    int32_t x, y;          /* lowest pixel */
    int32_t width, height; /* smaller at the window's upper and right border */
    /* [row * ZR_TILE_SIZE + column] */
    float depth[ZR_TILE_SIZE * ZR_TILE_SIZE];    /* window depth, 1 where nothing is */
    uint32_t owner[ZR_TILE_SIZE * ZR_TILE_SIZE]; /* 1 + number of the triangle, 0 where nothing is */
};

/* Tile 0 is at the window's lower left, then along the row. */
static inline size_t zr_tile_count(uint32_t width, uint32_t height)
{
    return (size_t)((width + ZR_TILE_SIZE - 1) / ZR_TILE_SIZE) * ((height + ZR_TILE_SIZE - 1) / ZR_TILE_SIZE);
}

#endif
