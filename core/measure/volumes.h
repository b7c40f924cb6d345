/* volumes.h - measure: volumes that two closed solids share, and that only one of them has.
 *
 * Inside: where the winding number is not 0, so overlapping shells count once, and a solid that is inside out counts.
 * Rays:   three oblique directions (mesh/facts/ray_grid.h); the result is their mean. Grids along the axes of a model
 *         are worse at every size, since flat faces line up with their cells.
 * Thin:   intervals of one solid alone whose thickness is at most a millionth of the diagonal count as none. So equal
 *         solids whose faces are cut into other triangles are equal. Their volume is added to the error.
 * Error:  the spread of the directions, and a fiftieth of the changes between neighbouring rays. It held for all of
 *         200 random pairs (make judge-compare); it is an estimate, not a bound.
 *         Errors of volumes have the difference of the rays from the exact volumes of `a` and `b`, too.
 * Whole:  volumes of `a` and `b` themselves are exact sums over their triangles, unless their shells overlap or are
 *         turned against one another; then they are measured along the rays, too.
 * Exact:  rows have separate sums, which are added in order: the same for all numbers of threads.
 */
#ifndef ZR_VOLUMES_H
#define ZR_VOLUMES_H

#include "measure/regions.h"

enum { ZR_VOLUME_RAYS = 256 };

struct zr_own_volume {
    double volume, error; /* error: 0 if the volume is an exact sum */
    bool has_overlap;     /* shells overlap, or are turned against one another */
    bool is_inside_out;
};

struct zr_volumes {
    struct zr_own_volume a, b;
    double both, only_a, only_b;
    double iou, error;   /* both / (both + only_a + only_b), and its error */
    double volume_error; /* of both, only_a and only_b */
    uint32_t rays;       /* of all directions */
};

/* Measures two closed solids, whose places are relative to the same middle, with up to `rays` along the longest side.
 * The rays of the first direction also find regions of change (regions.h), unless `regions` is NULL: `thin` is for
 * these. Takes scratch from the arena and gives it back. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_volumes_find(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                               uint32_t rays, double thin, struct zr_volumes *out, struct zr_regions *regions);

#endif
