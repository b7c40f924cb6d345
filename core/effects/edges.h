/* edges.h - effects: finds silhouettes and creases between neighbouring samples and widens them to lines.
 *
 * In:     tile by tile, the G-buffer of samples (owner, normal, point). Out: the share of each pixel that edges cover.
 * How:    horizontal and vertical neighbours are compared. They form a silhouette if one is uncovered. They also form
 *         one if both points are more than 1.5 sample widths (at the farther one) from the other's plane and lie on no
 *         common surface (zr_edges_set_faces). Otherwise they form a crease if their normals differ by more than an
 *         angle. Samples without a normal, of lines, form silhouettes with uncovered samples only. A cap of a section
 *         forms one with all other faces, for any normals. Both neighbours are marked. Connected creases that fit in a
 * square are dropped; its sides are a fiftieth of the window's smaller side, 5 to 64 pixels. Marks are widened by a
 * disc. Exact:  every instruction set, thread count and order of tiles gives the same bytes. Memory:
 * two bits per sample, and 7 KiB per tile for the rows and columns at its sides, which are compared when all tiles are
 * drawn. */
#ifndef ZR_EDGES_H
#define ZR_EDGES_H

#include "base/arena.h"
#include "base/isa.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "effects/occlusion.h"
#include "effects/sample_pairs.h"
#include "scene/effects.h"
#include "shade/draw_attributes.h"
#include "shade/lights/gbuffer.h"

/* Marks of a picture of width x height pixels with side x side samples per pixel. Tiles are squares of ZR_TILE_SIZE
 * samples (raster/tile.h), numbered row by row from the lower left. */
struct zr_edge_marks;

struct zr_edge_marks *zr_edge_marks_make(struct zr_arena *arena, uint32_t width, uint32_t height, uint32_t side,
                                         const struct zr_edges *edges, const struct zr_pixel_scale *scale);

/* Returns the width of lines in a window of these pixels. Without keeps_width, edges->width is that of a window
 * whose smaller side is 600: the width grows with the root of that side, from 0.6 to 2.5 times edges->width. */
float zr_edges_width_in(const struct zr_edges *edges, uint32_t width, uint32_t height);

/* Sets the triangles that owner ids refer to, before the first tile: parts of one surface then have no silhouette
 * between them, for any normals. Both pointers must stay valid until zr_edges_finish returns. False: the arena has no
 * memory. */
bool zr_edges_set_faces(struct zr_edge_marks *marks, struct zr_arena *arena, const struct zr_geometry *geometry,
                        const struct zr_scene_attributes *attributes);

/* Marks the edges within tile `number`, and keeps its sides for zr_edges_finish. All owners must be known. `pairs`:
 * those that may form edges if both are covered; NULL: all. The values of their samples must be known, and of those at
 * the tile's sides. Several threads may mark different tiles. */
void zr_edges_mark_tile(struct zr_edge_marks *marks, enum zr_isa isa, uint32_t number, const struct zr_gbuffer *tile,
                        const struct zr_sample_pairs *pairs);

/* Marks a tile without covered samples. */
void zr_edges_mark_empty(struct zr_edge_marks *marks, uint32_t number);

/* Zeros after the last pixel's opacity, for whole-vector loads. */
enum { ZR_EDGE_ROOM = 15 };

/* Compares the sides of tiles, drops specks and widens. Each tile must have been marked once. Returns the opacity of
 * the ink per pixel, 0..1: silhouette_opacity times the share of samples within width / 2 of a silhouette, plus
 * crease_opacity times the share of other samples within width / 2 of a crease. Row 0 is the lowest; rows have `width`
 * values. Returns NULL if the arena failed; if cancelled, returns early. */
const float *zr_edges_finish(const struct zr_run *run, struct zr_edge_marks *marks);

#endif
