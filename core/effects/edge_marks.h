/* edge_marks.h - effects: what the files of edges.h share: marks of samples, and the steps that they go through.
 *
 * Layout: a bit a sample, two planes; a tile's row of samples is one word, so no two tiles have a word in common. Row 0
 *         is the lowest, bit 0 the leftmost. Bits beyond the picture are 0, until lines are widened.
 */
#ifndef ZR_EDGE_MARKS_H
#define ZR_EDGE_MARKS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/isa.h"
#include "base/team.h"
#include "raster/tile.h"
#include "shade/draw_attributes.h"
#include "shade/gbuffer.h"

_Static_assert(ZR_TILE_SIZE == 64, "a row of a tile is a word");

/* ---- comparisons of neighbours: edges_kernel.c ---- */

/* Where faces lie, which shading normals do not say. What they point to lives until zr_edges_finish is done. */
struct zr_edge_faces {
    const struct zr_geometry *geometry;
    const struct zr_draw_attributes *of_draw; /* with points */
};

/* A silhouette: both points are further from the other's plane than limit * w, w = slope . point + offset being the
 * larger one of both points. A crease: no silhouette, and the dot product of normals is below `cosine`. */
struct zr_edge_rule {
    float slope[3], offset;
    float limit;
    float cosine;
    const struct zr_edge_faces *faces; /* NULL: they are as normals say */
};

/* Samples side by side, or above each other. */
struct zr_edge_line {
    const uint32_t *owner;
    const float *normal[3], *point[3];
};

/* Of up to 64 samples, or pairs of them. */
struct zr_edge_bits {
    uint64_t silhouettes, creases;
};

/* Of the bits of `pairs`, of which bit i is that of samples first + i: those whose points are on no common surface.
 * Such a one is a triangle, or two that have a corner in common where one point is no further than `limit` from the
 * plane of the other's triangle. Of coarse meshes with smooth normals, points of a triangle that is seen from aside are
 * far from the planes that normals make. */
uint32_t zr_edge_faces_apart(const struct zr_edge_rule *rule, const struct zr_edge_line *a,
                             const struct zr_edge_line *b, int32_t first, uint32_t pairs);

/* Bit i: what is between samples i of both lines, of `count` <= 64. It does not matter which one comes first, and
 * nothing beyond is read. A kernel. */
typedef struct zr_edge_bits zr_edge_pairs_fn(const struct zr_edge_rule *rule, const struct zr_edge_line *a,
                                             const struct zr_edge_line *b, int32_t count);

/* Marks within a tile, for each of its rows. A kernel. */
typedef void zr_edge_tile_fn(const struct zr_edge_rule *rule, const struct zr_gbuffer *tile, struct zr_edge_bits *rows);

zr_edge_pairs_fn zr_edge_pairs_scalar, zr_edge_pairs_sse2, zr_edge_pairs_avx2, zr_edge_pairs_avx512, zr_edge_pairs_neon;
zr_edge_tile_fn zr_edge_tile_scalar, zr_edge_tile_sse2, zr_edge_tile_avx2, zr_edge_tile_avx512, zr_edge_tile_neon;

/* ---- marks of the picture ---- */

/* One side of a tile. */
struct zr_edge_side {
    uint32_t owner[ZR_TILE_SIZE];
    float normal[3][ZR_TILE_SIZE], point[3][ZR_TILE_SIZE];
};

enum { ZR_EDGE_BOTTOM, ZR_EDGE_TOP, ZR_EDGE_LEFT, ZR_EDGE_RIGHT, ZR_EDGE_SIDES };

struct zr_edge_tile {
    bool is_empty; /* and its sides are not written */
    struct zr_edge_side sides[ZR_EDGE_SIDES];
};

struct zr_edge_marks {
    uint32_t width, height, side; /* pixels, and samples along one of them */
    uint32_t columns, rows;       /* samples */
    uint32_t words;               /* a row; as many tiles are side by side */
    float line_width;             /* pixels */
    struct zr_edge_rule rule;
    struct zr_edge_faces faces;
    uint64_t *silhouettes, *creases; /* [row * words + column of tiles] */
    struct zr_edge_tile *tiles;
};

/* ---- steps of zr_edges_finish ---- */

/* edge_specks.c: connected creases are dropped where their box, from the middle of its first pixel to that of its last
 * one, is smaller than this. */
enum { ZR_EDGE_SPECK_PIXELS = 12 };

/* Pixels count, whatever share of them is marked: of a crease seen from aside, marked samples are no unbroken line.
 * Touching corners connect. False where the arena has failed; cancelled, it returns early. */
bool zr_edge_specks_drop(struct zr_edge_marks *marks, struct zr_arena *arena, struct zr_team *team,
                         const struct zr_cancel *cancel);

/* edge_width.c: widens marks, and writes each pixel's opacity. False and cancelled as above. */
bool zr_edge_width_cover(const struct zr_edge_marks *marks, struct zr_arena *arena, struct zr_team *team,
                         const struct zr_cancel *cancel, float *opacity);

#endif
