/* counts.h - geometry: numbers of polygons, triangles, lines and points that were drawn, clipped, culled or dropped.
 *
 * Every triangle is counted in exactly one of outside, clipped, culled, zero_area and drawn_whole; the pieces of
 * clipped triangles have counters of their own. Lines, points and outlines are counted likewise; a line is drawn if it
 * has a length and is not outside. A primitive without a window position, such as the corner (0, 0, 0, 0), is counted
 * in its class and in `unplaced` as well. Draws that are not `counted` (draw.h) only count as polygons and triangles
 * until they are binned (raster/visibility.h), which fills in the other counters. */
#ifndef ZR_COUNTS_H
#define ZR_COUNTS_H

#include <stdint.h>

struct zr_counts {
    uint64_t polygons;            /* input */
    uint64_t degenerate_polygons; /* without three distinct corners: dropped */
    uint64_t concave_polygons;    /* filled by the odd-even rule: dents, crossings, holes */
    uint64_t triangles;           /* made from polygons, by fans or by ear clipping */
    uint64_t outside;             /* wholly outside the view volume */
    uint64_t clipped;             /* cut by the view volume */
    uint64_t culled;              /* one-sided and facing away */
    uint64_t zero_area;           /* no area on the subpixel grid, or no window position */
    uint64_t drawn_whole;         /* handed to the rasterizer uncut */
    uint64_t drawn_pieces;        /* pieces of clipped triangles, handed to the rasterizer */
    uint64_t culled_pieces;       /* pieces of clipped triangles, facing away */
    uint64_t lines;               /* input; outlines are not counted */
    uint64_t degenerate_lines;    /* both ends at one position: dropped */
    uint64_t outside_lines;       /* wholly outside the view volume, or without a window position */
    uint64_t clipped_lines;       /* cut by the view volume */
    uint64_t points;              /* input */
    uint64_t outside_points;      /* centre outside the view volume, or without a window position */
    uint64_t unplaced;            /* triangles, pieces of them, lines and points that have a corner without a window
                                   * position */
    uint64_t clipped_outlines;    /* triangles of outlined faces that were cut */
    uint64_t masked_tiles;        /* tiles in which masked fragments were dropped and none became visible */
};

/* Adds modulo 2^64, so that a wrapped negative count subtracts. */
static inline void zr_counts_add(struct zr_counts *sum, const struct zr_counts *counts)
{
    sum->polygons += counts->polygons;
    sum->degenerate_polygons += counts->degenerate_polygons;
    sum->concave_polygons += counts->concave_polygons;
    sum->triangles += counts->triangles;
    sum->outside += counts->outside;
    sum->clipped += counts->clipped;
    sum->culled += counts->culled;
    sum->zero_area += counts->zero_area;
    sum->drawn_whole += counts->drawn_whole;
    sum->drawn_pieces += counts->drawn_pieces;
    sum->culled_pieces += counts->culled_pieces;
    sum->lines += counts->lines;
    sum->degenerate_lines += counts->degenerate_lines;
    sum->outside_lines += counts->outside_lines;
    sum->clipped_lines += counts->clipped_lines;
    sum->points += counts->points;
    sum->outside_points += counts->outside_points;
    sum->unplaced += counts->unplaced;
    sum->clipped_outlines += counts->clipped_outlines;
    sum->masked_tiles += counts->masked_tiles;
}

#endif
