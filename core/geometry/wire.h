/* wire.h - geometry: appends outlines of faces, lines and points.
 *
 * Exact:  the reference's glPolygonMode(GL_LINE), GL_LINES and GL_POINTS: an outline is clipped with its polygon, a
 *         line by itself, and neither gets an edge along the view volume. A point is drawn whole if its centre is
 *         inside, and otherwise dropped. */
#ifndef ZR_WIRE_H
#define ZR_WIRE_H

#include "geometry/builder.h"

/* Appends the edges of a face's rings in the outline mode of its material. On failure, the arena has failed. */
void zr_wire_outline(struct zr_builder *builder, uint32_t face);

/* Append the lines and the points of the current mesh. Unless primitives are placed singly, its points are one cloud.
 * Return ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_wire_lines(struct zr_builder *builder);
enum zr_status zr_wire_points(struct zr_builder *builder);

#endif
