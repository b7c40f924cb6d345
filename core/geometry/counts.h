/* counts.h - geometry: where polygons, triangles, lines and points went. Of draws that are not `counted` (draw.h) that
 * is known once they are sorted (raster/hidden_surface.h), before which their triangles are counted as such alone.
 *
 * Every triangle handed in is counted in exactly one of outside, clipped, culled,
 * zero_area and drawn_whole; the pieces of a clipped one are counted apart. So are lines, of
 * which those that have a length and are not outside are drawn, points likewise, and outlines. What has no place in the
 * window, as the corner (0, 0, 0, 0) has none, is among these, and counted as `unplaced` besides.
 */
#ifndef ZR_COUNTS_H
#define ZR_COUNTS_H

#include <stdint.h>

struct zr_counts {
    uint64_t polygons;            /* handed in */
    uint64_t degenerate_polygons; /* without three distinct corners: dropped */
    uint64_t concave_polygons;    /* by the odd-even rule: dents, crossings, holes */
    uint64_t triangles;           /* that polygons were cut into, as fans or by their ears */
    uint64_t outside;             /* wholly outside the view volume */
    uint64_t clipped;             /* cut by the view volume */
    uint64_t culled;              /* one-sided and turned away */
    uint64_t zero_area;           /* no area on the subpixel grid, or no place in the window */
    uint64_t drawn_whole;         /* handed to the rasterizer uncut */
    uint64_t drawn_pieces;        /* of clipped triangles, handed to the rasterizer */
    uint64_t culled_pieces;       /* of clipped triangles, turned away */
    uint64_t lines;               /* handed in; outlines are not counted */
    uint64_t degenerate_lines;    /* from a place to the same one: dropped */
    uint64_t outside_lines;       /* wholly outside the view volume, or without a place in the window */
    uint64_t clipped_lines;       /* cut by the view volume */
    uint64_t points;              /* handed in */
    uint64_t outside_points;      /* whose middle is outside the view volume, or without a place in the window */
    uint64_t unplaced;            /* triangles, pieces of these, lines and points with a corner that has no place */
    uint64_t clipped_outlines;    /* triangles of outlined faces that were cut */
    uint64_t masked_tiles;        /* where masked fragments were left out, and nothing masked was seen in their place */
};

/* Modulo 2^64: what is less than none is taken away. */
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
