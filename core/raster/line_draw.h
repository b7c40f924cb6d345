/* line_draw.h - raster: lines into tiles: the columns (rows) that pass through a tile, a pixel each.
 *
 * Gives the bytes that oddeven.h gives for the line's four edges, in the time of its pixels.
 */
#ifndef ZR_LINE_DRAW_H
#define ZR_LINE_DRAW_H

#include "raster/depth.h"
#include "raster/tile.h"

/* Where the line is seen (zr_tile_put), writes its depth and `owner`. */
void zr_line_draw(const struct zr_geometry *geometry, const struct zr_triangle *line, uint32_t owner,
                  struct zr_tile *tile);

/* Calls visit(context, tile column, tile row) once for each tile of a window that the line may have pixels
 * in, and for hardly any other. */
void zr_line_tiles(const struct zr_line_corners *line, uint32_t width, uint32_t height,
                   void (*visit)(void *context, uint32_t column, uint32_t row), void *context);

#endif
