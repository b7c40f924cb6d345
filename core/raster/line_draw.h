/* line_draw.h - raster: draws lines into tiles, column by column (or row by row).
 *
 * Gives the same bytes as oddeven.h for the line's four edges, in time proportional to its pixels. */
#ifndef ZR_LINE_DRAW_H
#define ZR_LINE_DRAW_H

#include "raster/depth.h"
#include "raster/tile.h"

/* Writes depth and `owner` to the samples where the line is visible (zr_tile_put). */
void zr_line_draw(const struct zr_geometry *geometry, const struct zr_triangle *line, uint32_t owner,
                  struct zr_tile *tile);

/* Calls visit(context, tile column, tile row) once for each tile of the window in which the line may have pixels, and
 * for few others. */
void zr_line_tiles(const struct zr_line_corners *line, uint32_t width, uint32_t height,
                   void (*visit)(void *context, uint32_t column, uint32_t row), void *context);

#endif
