/* algorithms.h - raster: the textbooks' hidden-surface algorithms, beside production's.
 *
 * Each is a zr_visibility_fn in a file of its own, whose head names its
 * source. No two of these four find an edge's crossings with the rows of samples in the same
 * way: one division a row, steps of whole columns and parts, a walk by the sign of an integer,
 * bisection. (Production's half-spaces look for none, and its oddeven.c divides too, in code of
 * its own.) All ways are exact: integers only, one rule (primitive.h), the same samples.
 */
#ifndef ZR_ALGORITHMS_H
#define ZR_ALGORITHMS_H

#include "raster/samples.h"

/* Draws the primitives that they take into samples that have been cleared: no owner, and the depth below which
 * something is seen; or into their lists. One thread. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY; the painter's also ends
 * with ZR_BAD_SCENE beyond its limit of work, and could find its own proof wrong, ZR_INTERNAL. All of the geometry's
 * draws are `counted`. */
typedef enum zr_status zr_visibility_fn(struct zr_arena *arena, const struct zr_geometry *geometry,
                                        const struct zr_cancel *cancel, struct zr_samples *samples);

/* NULL for ZR_ALGORITHM_HALFSPACE, which works in tiles. */
zr_visibility_fn *zr_visibility_of(enum zr_algorithm algorithm);

zr_visibility_fn zr_edgelist, zr_trapezoid, zr_scanline, zr_painter;

/* Spans and samples that the painter compares or cuts, and pieces that it passes, at most: some 20 s of one core. */
#define ZR_PAINTER_WORK_MAX UINT64_C(2500000000)

/* The painter with another limit; ZR_BAD_SCENE beyond it. */
enum zr_status zr_painter_within(struct zr_arena *arena, const struct zr_geometry *geometry, uint64_t work_max,
                                 const struct zr_cancel *cancel, struct zr_samples *samples);

/* Of all that has pixels in its box. */
struct zr_primitives {
    uint32_t count;
    struct zr_primitive *items; /* in the order of the scene */
};

/* For those who look at all primitives at once: those that the samples take. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_primitives_make(struct zr_arena *arena, const struct zr_geometry *geometry,
                                  const struct zr_samples *samples, const struct zr_cancel *cancel,
                                  struct zr_primitives *primitives);

static inline bool zr_primitive_is_empty(const struct zr_primitive *primitive)
{
    return primitive->min_x > primitive->max_x || primitive->min_y > primitive->max_y;
}

#endif
