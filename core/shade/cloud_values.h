/* cloud_values.h - shade: colours and points of visible points of clouds, made when they are needed.
 *
 * A cloud's attributes (draw_attributes.h) are the mesh's own arrays: its positions, and its vertex colours or else the
 * material's colour. */
#ifndef ZR_CLOUD_VALUES_H
#define ZR_CLOUD_VALUES_H

#include "shade/draw_attributes.h"

/* Returns the vertex colour times the material's, or the latter. */
zr_vec4 zr_cloud_color(const struct zr_draw_attributes *of_draw, uint32_t number);

/* Returns the point as in ZR_ATTRIBUTE_POINT. */
zr_vec4 zr_cloud_point(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw, uint32_t number);

#endif
