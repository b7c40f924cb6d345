/* edge_marks.h - effects: data shared by the files of edges.h: marks of samples, and the steps that process them.
 *
 * Layout: two bit planes, one bit per sample; a tile's row of samples is one word, so tiles share no words. Row 0 is
 * the lowest, bit 0 the leftmost. Bits beyond the picture are 0 until lines are widened. */
#ifndef ZR_EDGE_MARKS_H
#define ZR_EDGE_MARKS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/isa.h"
#include "base/run.h"
#include "base/team.h"
#include "effects/occlusion.h"
#include "effects/sample_pairs.h"
#include "raster/tile.h"
#include "shade/draw_attributes.h"
#include "shade/lights/gbuffer.h"

_Static_assert(ZR_TILE_SIZE == 64, "a row of a tile is a word");

/* ---- comparison of neighbours: edges_kernel.c ---- */

/* The triangles themselves: shading normals do not define their planes. The pointers must stay valid until
 * zr_edges_finish returns. */
struct zr_edge_faces {
    const struct zr_geometry *geometry;
    const struct zr_draw_attributes *of_draw; /* with points (zr_draw_has_points) */
};

/* Silhouette: each point is farther than limit * w from the plane of the other; w is that of `scale`, the larger value
 * of the two points. Crease: no silhouette, and the dot product of the normals is below `cosine`. */
struct zr_edge_rule {
    struct zr_pixel_scale scale;
    float limit;
    float cosine;
    const struct zr_edge_faces *faces; /* NULL: the normals alone define the planes */
    const uint32_t *caps;              /* of zr_edge_caps_list; NULL: the scene has none */
};

/* A row or column of neighbouring samples. */
struct zr_edge_line {
    const uint32_t *owner;
    const float *normal[3], *point[3];
};

/* One bit per sample, or per pair of neighbours; up to 64. */
struct zr_edge_bits {
    uint64_t silhouettes, creases;
};

/* Returns those bits of `pairs` whose points lie on no common surface; bit i is the pair of samples first + i. A common
 * surface is one triangle, or two triangles that share a corner if one point is within `limit` of the plane of the
 * other's triangle. This matters for coarse meshes with smooth normals: in a triangle at a grazing angle, points are
 * far from the planes of their normals. */
uint32_t zr_edge_faces_apart(const struct zr_edge_rule *rule, const struct zr_edge_line *a,
                             const struct zr_edge_line *b, int32_t first, uint32_t pairs);

/* Returns those bits of `pairs` of which one sample shows a cap and the other does not show the same one. */
uint32_t zr_edge_caps_apart(const struct zr_edge_rule *rule, const struct zr_edge_line *a, const struct zr_edge_line *b,
                            int32_t first, uint32_t pairs);

/* Lists the face id of the cap of each primitive; 0: of no cap. Sets *caps to NULL if the geometry has no caps. False:
 * the arena has no memory. */
bool zr_edge_caps_list(struct zr_arena *arena, const struct zr_geometry *geometry, const uint32_t **caps);

/* Compares sample i of both lines for i < count <= 64 and returns the marks as bit i. The result is symmetric in `a`
 * and `b`; nothing beyond `count` is read. A kernel. */
typedef struct zr_edge_bits zr_edge_pairs_fn(const struct zr_edge_rule *rule, const struct zr_edge_line *a,
                                             const struct zr_edge_line *b, int32_t count);

/* Marks edges between neighbours within a tile, row by row. A kernel. */
typedef void zr_edge_tile_fn(const struct zr_edge_rule *rule, const struct zr_gbuffer *tile,
                             const struct zr_sample_pairs *pairs, struct zr_edge_bits *rows);

ZR_KERNEL_TABLE(zr_edge_pairs_fn, zr_edge_pairs)
ZR_KERNEL_TABLE(zr_edge_tile_fn, zr_edge_tile)

/* ---- marks of the picture ---- */

/* The samples along one side of a tile. */
struct zr_edge_side {
    uint32_t owner[ZR_TILE_SIZE];
    float normal[3][ZR_TILE_SIZE], point[3][ZR_TILE_SIZE];
};

enum { ZR_EDGE_BOTTOM, ZR_EDGE_TOP, ZR_EDGE_LEFT, ZR_EDGE_RIGHT, ZR_EDGE_SIDES };

struct zr_edge_tile {
    bool is_empty; /* uncovered; its sides are not written */
    struct zr_edge_side sides[ZR_EDGE_SIDES];
};

struct zr_edge_marks {
    uint32_t width, height, side; /* pixels, and samples per pixel in either direction */
    uint32_t columns, rows;       /* samples */
    uint32_t words;               /* per row; equals the number of tiles per row */
    float line_width;             /* pixels */
    float silhouette_opacity, crease_opacity;
    uint32_t speck_pixels; /* connected creases are dropped if their box, measured between pixel centres, is smaller */
    struct zr_edge_rule rule;
    struct zr_edge_faces faces;
    uint64_t *silhouettes, *creases; /* [row * words + column of tiles] */
    struct zr_edge_tile *tiles;
};

/* ---- steps of zr_edges_finish ---- */

/* edge_specks.c. Drops connected creases whose box is smaller than speck_pixels. Works on whole pixels, however many of
 * their samples are marked, since the marks of a crease at a grazing angle are an interrupted line. Touching corners
 * connect. Returns false if the arena failed; if cancelled, returns early. */
bool zr_edge_specks_drop(const struct zr_run *run, struct zr_edge_marks *marks);

/* edge_width.c: widens the marks and writes the opacity of each pixel. Returns false if the arena failed; if cancelled,
 * returns early. */
bool zr_edge_width_cover(const struct zr_run *run, const struct zr_edge_marks *marks, float *opacity);

#endif
