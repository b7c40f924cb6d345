/* meshes.h - bench: geometry made for measuring. Each fills a drawing, which must be
 * zero or freed; `failed` of the drawing tells whether memory sufficed.
 */
#ifndef ZR_BENCH_MESHES_H
#define ZR_BENCH_MESHES_H

#include "reference/drawing.h"

/* 16 triangles over nearly the whole window, each with its own depth at each corner, none through another. */
void meshes_fill(struct drawing *drawing, uint32_t width, uint32_t height, bool front_first);

/* 12 triangles, 8 corners of 8 colours, seen from a corner. */
void meshes_cube(struct drawing *drawing, uint32_t width, uint32_t height);

/* A closed surface of 4 * rings * (rings - 1) triangles, bumpy as an animal is, coloured by its normals. */
void meshes_ball(struct drawing *drawing, uint32_t rings);

/* Convex polygons of 3 to 12 corners, each with one colour or with one a corner, of random size, place and depth. */
void meshes_polygons(struct drawing *drawing, uint32_t width, uint32_t height, uint32_t count);

/* Each triangle into 4, new corners in the middles of edges, shared. */
void meshes_subdivide(const struct drawing *coarse, struct drawing *fine);

/* models_look from the front or from a corner, nearer: what is seen is `zoom` times as large. */
void meshes_look(struct drawing *drawing, bool from_corner, float zoom, uint32_t width, uint32_t height);

#endif
