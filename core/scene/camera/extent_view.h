/* extent_view.h - scene: angles of an orbiting camera, chosen by the extent of the scene. */
#ifndef ZR_EXTENT_VIEW_H
#define ZR_EXTENT_VIEW_H

#include "scene/camera/camera.h"

/* Changes the angles of a view with suits_extent; other views stay. With D, the diagonal of the bounds, and h, their
 * extent along the scene's up: if an extent is below D / 1000, the camera looks along that axis: from the front, from
 * the right or from above. Else the elevation rises by 14 degrees times clamp(1 - 8 h / D): plates are seen from higher
 * up. `bounds`: of the fitted geometry. */
void zr_view_suit_extent(struct zr_view *view, const struct zr_bounds *bounds, bool z_is_up);

#endif
