/* assemble.h - geometry: turns the vertices of one instance into draws: filled faces, then outlines, lines and
 * points. */
#ifndef ZR_ASSEMBLE_H
#define ZR_ASSEMBLE_H

#include "geometry/builder.h"

/* Appends the draws of the builder's current instance. Returns ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_assemble_mesh(struct zr_builder *builder);

#endif
