/* edges.h - effects: silhouettes and creases, found between neighbouring samples and widened to lines.
 *
 * In:     tile by tile, the G-buffer of samples (owner, normal, point). Out: the share of each pixel that edges cover.
 * How:    a silhouette is where one of two horizontal or vertical neighbours is empty, or where both points are
 *         more than 1.5 sample widths (at the one further away) from the other's plane and are on no common surface
 *         (zr_edges_know_faces); a crease is where normals differ by more than an angle and there is no silhouette.
 *         Samples without a normal, of lines, have silhouettes against nothing only. Both neighbours are marked;
 *         creases whose pixels connect, and fill a box of 12 pixels at most in both directions, are dropped; marks are
 *         widened by a disc.
 * Exact:  every instruction set, thread count and order of tiles gives the same bytes.
 * Memory: two bits a sample, and 7 KiB a tile: the rows and columns at its sides, which are compared when all are
 *         drawn.
 */
#ifndef ZR_EDGES_H
#define ZR_EDGES_H

#include "base/arena.h"
#include "base/isa.h"
#include "base/team.h"
#include "effects/occlusion.h"
#include "scene/picture.h"
#include "shade/draw_attributes.h"
#include "shade/gbuffer.h"
#include "zraster.h"

/* Marks of a picture of width x height pixels with side x side samples each. Tiles are squares of ZR_TILE_SIZE samples
 * (raster/tile.h), tile 0 at the lower left, numbered along the row. */
struct zr_edge_marks;

struct zr_edge_marks *zr_edge_marks_make(struct zr_arena *arena, uint32_t width, uint32_t height, uint32_t side,
                                         const struct zr_edges *edges, const struct zr_pixel_scale *scale);

/* Before the first tile, of the triangles that owners are numbers of: with these, parts of one surface have no
 * silhouette between them, whatever their normals are. What both point to lives until zr_edges_finish is done. */
void zr_edges_know_faces(struct zr_edge_marks *marks, const struct zr_geometry *geometry,
                         const struct zr_scene_attributes *surfaces);

/* Marks what is found inside of tile `number`, and keeps its sides for zr_edges_finish. One thread a tile. */
void zr_edges_mark_tile(struct zr_edge_marks *marks, enum zr_isa isa, uint32_t number, const struct zr_gbuffer *tile);

/* A tile in which nobody is seen. */
void zr_edges_mark_empty(struct zr_edge_marks *marks, uint32_t number);

/* What is behind the last pixel's opacity: 0, for vectors that are loaded whole. */
enum { ZR_EDGE_ROOM = 15 };

/* When each tile was marked, once: compares tiles' sides, drops specks, widens. Of each pixel the opacity of ink, 0..1:
 * (share of samples that are within width / 2 of a silhouette, or else 0.85 of those of a crease); row 0 is the lowest,
 * rows of `width`. NULL where the arena has failed; cancelled, it returns early. */
const float *zr_edges_finish(struct zr_edge_marks *marks, struct zr_arena *arena, struct zr_team *team,
                             const struct zr_cancel *cancel);

#endif
