/* box_dimensions.h - overlay: dimensions of the bounds along the axes of the file, and given dimensions. */
#ifndef ZR_BOX_DIMENSIONS_H
#define ZR_BOX_DIMENSIONS_H

#include "overlay/annotate/layout.h"

/* Returns the size of the bounds along each axis of the file; *largest: of all. */
zr_dvec3 zr_box_size(const struct zr_layout *layout, double *largest);

/* Draws a dimension per axis at an edge of the box that is an outline: the lower right ones first. `unit` follows the
 * numbers. Thin lines lead from corners of the box that are away from the model to it. */
void zr_box_dimensions_place(struct zr_layout *layout, const char *unit);

#endif
