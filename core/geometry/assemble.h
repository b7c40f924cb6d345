/* assemble.h - geometry: faces of placed vertices -> triangles in the window.
 *
 * Cuts polygons to fans, drops what is outside, clips what sticks out, and drops
 * what has no area or is turned away.
 */
#ifndef ZR_ASSEMBLE_H
#define ZR_ASSEMBLE_H

#include "geometry/builder.h"
#include "geometry/colors.h"

/* Appends the triangles of the instance under way. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_assemble_mesh(struct zr_builder *builder, const struct zr_scene *scene, const struct zr_mesh *mesh,
                                enum zr_color_layout layout, uint32_t first_face_id);

#endif
