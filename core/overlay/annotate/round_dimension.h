/* round_dimension.h - overlay: radii, diameters and angles, with their texts at leaders.
 *
 * Radius, diameter: an arrow points at the circle, and a thin line leads to its centre, or across it. For a hole, the
 *                   arrow points at its rim as notes do (overlay/annotate/hole_notes.h).
 * Angle:            an arc around the apex at half of the shorter way, with an arrow at each end. If there is no
 *                   place beside the model, the text is written over it. */
#ifndef ZR_ROUND_DIMENSION_H
#define ZR_ROUND_DIMENSION_H

#include "mesh/features/holes.h"
#include "overlay/annotate/model_map.h"

struct zr_round_dimension {
    int kind;                   /* enum zr_dimension_kind, but not a length */
    zr_dvec3 ends[3];           /* world space: centre and a place of the circle; or two ways' ends and the apex */
    const struct zr_hole *hole; /* instead of a circle; NULL: none */
    const char *label;          /* instead of the number; NULL: none */
};

/* Draws it. Returns why it has no place, or NULL. */
const char *zr_round_dimension_place(struct zr_layout *layout, const struct zr_model_map *map,
                                     const struct zr_round_dimension *dimension, const char *unit);

#endif
