/* path.h - overlay: a list of polylines.
 *
 * Polyline i has the points ends[i - 1] .. ends[i] - 1, the first one from 0. One of a single point is a dot. */
#ifndef ZR_PATH_H
#define ZR_PATH_H

#include <stdint.h>

struct zr_point {
    double x, y;
};

struct zr_path {
    uint32_t count; /* of polylines */
    const uint32_t *ends;
    const struct zr_point *points;
};

#endif
