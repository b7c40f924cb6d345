/* place_dimensions.h - overlay: the dimensions of a view between given places. */
#ifndef ZR_PLACE_DIMENSIONS_H
#define ZR_PLACE_DIMENSIONS_H

#include "overlay/annotate/layout.h"

/* Draws them in rows outside of the bounds, the shorter ones inside, with crosses at the places. `unit` follows the
 * numbers. Places of a bare mesh are in coordinates of its file. */
void zr_place_dimensions_place(struct zr_layout *layout, const char *unit);

#endif
