/* assemble.h - geometry: a mesh of placed vertices -> draws: its faces, then the
 * outlines of faces, then its lines.
 */
#ifndef ZR_ASSEMBLE_H
#define ZR_ASSEMBLE_H

#include "geometry/builder.h"

/* Appends the draws of the instance under way. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_assemble_mesh(struct zr_builder *builder);

#endif
