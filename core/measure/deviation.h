/* deviation.h - measure: distances of the surface of one solid from that of another one.
 *
 * To:      the surface itself, not points of it: equal surfaces have the distance 0, whatever their triangles.
 * From:    points of equal shares of the area, in the order of the triangles, placed by the R2 sequence
 *          (surface_points.h). The largest distance is also sought at all corners.
 * Sign:    positive outside the other solid, if that is closed. So a place that was added has a positive distance.
 * Shells:  if those of a solid overlap, points on walls that lie inside it are left out. Distances to such walls of the
 *          other solid count.
 * Work:    counted in steps. Beyond ZR_DEVIATION_STEPS per point of a task, or beyond ZR_DEVIATION_STEPS_MEAN per point
 *          of all and ZR_DEVIATION_STEPS_LEAST, there is no result: triangles that all overlap cannot be searched.
 * Exact:   tasks of points have separate sums, which are added in order: the same for all numbers of threads.
 */
#ifndef ZR_DEVIATION_H
#define ZR_DEVIATION_H

#include "measure/surface_tree.h"

enum { ZR_DEVIATION_POINTS = 50000, ZR_DEVIATION_STEPS = 1 << 12 };
enum { ZR_DEVIATION_STEPS_LEAST = 1 << 28, ZR_DEVIATION_STEPS_MEAN = 1 << 10 };

/* The cosine of 25 degrees: normals that differ less are alike. */
#define ZR_DEVIATION_ALIKE 0.90630778703664996

struct zr_deviation {
    bool is_omitted;            /* too much work, or no triangle: the rest is 0 */
    bool is_signed;             /* else mean is that of the distances without sign, as abs */
    uint32_t points;            /* without those left out */
    double mean, abs, rms, p95; /* p95: 95 % of the distances without sign are at most this */
    double square;              /* mean of the squares */
    double max;                 /* of the largest magnitude, with its sign */
    struct zr_world_place at;   /* there, on the first surface */
    double within;              /* share of the points that are near, by `threshold`, and whose normals are alike */
    double alignment;           /* mean magnitude of the cosine between the normals */
};

/* A surface whose distances are measured. */
struct zr_deviation_side {
    const struct zr_surface_tree *tree;
    bool has_overlap; /* its shells overlap */
};

/* Measures the distances of `from` from `to`, at `points` points. Takes scratch from the arena and gives it back. Fails
 * with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_deviation_find(const struct zr_run *run, const struct zr_deviation_side *from,
                                 const struct zr_deviation_side *to, uint32_t points, double threshold,
                                 struct zr_deviation *out);

#endif
