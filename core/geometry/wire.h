/* wire.h - geometry: outlines of faces, lines, and points.
 *
 * Exact:  as the reference draws glPolygonMode(GL_LINE), GL_LINES and GL_POINTS: an outline is clipped with
 *         the polygon that it belongs to, a line by itself, and neither gets an edge along
 *         the view volume. A point is drawn whole where its middle is inside, and else not at all.
 */
#ifndef ZR_WIRE_H
#define ZR_WIRE_H

#include "geometry/builder.h"

/* The edges of a face's rings, as its material wants them. Failure is the arena's. */
void zr_wire_outline(struct zr_builder *builder, uint32_t face);

/* The lines of the mesh under way, and its points. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_wire_lines(struct zr_builder *builder);
enum zr_status zr_wire_points(struct zr_builder *builder);

#endif
