/* shape.h - geometry: a polygon that is no convex one -> a shape: its edges, and triangles in it.
 *
 * Space:  edges on the snapped grid, of what the view volume leaves. Each ring is a fan of
 *         triangles, each of them clipped by itself; what an odd number of them covers is
 *         inside. So the odd-even rule also holds for what is cut, and is the reference's
 *         (GL_INVERT on a stencil bit, tests/reference/RULES.md).
 * Thin:   a triangle next to no wider than the grid has no plane worth the name, so it tells nothing
 *         where others can: its samples are told by the triangle that they are nearest to.
 * Why:    edges decide what is covered, exactly and whatever the polygon does to itself.
 *         Triangles between its own corners decide depth and colour.
 */
#ifndef ZR_SHAPE_H
#define ZR_SHAPE_H

#include "geometry/place.h"

/* Appends the face as a shape and its triangles, unless it is turned away or outside.
 * The kind, the shape and the side need not be filled in. Failure is the arena's. */
void zr_shape_place(struct zr_builder *builder, uint32_t face, const struct zr_common *common);

/* Which side of the face is seen, by the winding of its outer ring in the window: true for the back. */
bool zr_shape_shows_back(const struct zr_builder *builder, uint32_t face);

#endif
