/* shape.h - geometry: turns a polygon that is not convex into a shape: its edges, and triangles inside it.
 *
 * Space:  edges on the snapped grid, clipped to the view volume. Each ring is a fan of triangles that are clipped one
 *         by one; samples covered by an odd number of them are inside. The odd-even rule therefore holds for clipped
 *         polygons too, and equals the reference's (GL_INVERT on a stencil bit, tests/reference/RULES.md).
 * Thin:   a triangle about as narrow as the grid has no meaningful plane, so it is dropped if other triangles remain:
 *         its samples take depth and colour from the nearest triangle.
 * Why:    edges decide coverage exactly, even if the polygon crosses itself. Triangles between its own corners decide
 *         depth and colour. */
#ifndef ZR_SHAPE_H
#define ZR_SHAPE_H

#include "geometry/place.h"

/* Appends the face as a shape and its triangles, unless it is culled or outside. Sets the kind, shape and side of its
 * own copy of `common`. On failure, the arena has failed. */
void zr_shape_place(struct zr_builder *builder, uint32_t face, const struct zr_common *common);

/* Returns true if the back of the face is visible, by the winding of its outer ring in the window. */
bool zr_shape_shows_back(const struct zr_builder *builder, uint32_t face);

#endif
