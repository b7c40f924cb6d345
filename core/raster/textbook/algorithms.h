/* algorithms.h - raster: the textbooks' hidden-surface algorithms, besides production's.
 *
 * Each is a zr_visibility_fn in a file of its own, which names its source. No two of these four find the crossings of
 * edges with rows of samples in the same way: one division per row, steps of whole columns and fractions, a walk by the
 * sign of an integer, bisection. (Production's half-spaces find none, and its oddeven.c divides too, in code of its
 * own.) All ways are exact: integers only, one rule (primitive.h), the same samples.
 */
#ifndef ZR_ALGORITHMS_H
#define ZR_ALGORITHMS_H

#include "base/run.h"
#include "raster/samples.h"

/* Draws the primitives that `samples` takes into cleared samples, which have no owner and the depth that a visible
 * fragment must be less than; or adds fragments to their lists. Uses the run's arena and cancel; one thread. Returns
 * ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY; the painter also ZR_BAD_SCENE beyond its limit of work, and ZR_INTERNAL if its
 * proof failed. All of the geometry's draws are `counted`. */
typedef enum zr_status zr_visibility_fn(const struct zr_run *run, const struct zr_geometry *geometry,
                                        struct zr_samples *samples);

/* Returns the algorithm; NULL for ZR_ALGORITHM_HALFSPACE, which works by tiles. */
zr_visibility_fn *zr_visibility_of(enum zr_algorithm algorithm);

zr_visibility_fn zr_edgelist, zr_trapezoid, zr_scanline, zr_painter;

/* The painter's limit of work: spans and samples compared or cut, and pieces passed. Some 4 s of one core. */
#define ZR_PAINTER_WORK_MAX UINT64_C(500000000)

/* The painter with another limit of work. Returns ZR_BAD_SCENE beyond it. */
enum zr_status zr_painter_within(struct zr_arena *arena, const struct zr_geometry *geometry, uint64_t work_max,
                                 const struct zr_cancel *cancel, struct zr_samples *samples);

/* Primitives whose boxes contain pixels. */
struct zr_primitives {
    uint32_t count;
    struct zr_primitive *items; /* in scene order */
};

/* Makes all primitives that `samples` takes, for algorithms that need them at once. Returns ZR_OK, ZR_CANCELLED or
 * ZR_NO_MEMORY. */
enum zr_status zr_primitives_make(struct zr_arena *arena, const struct zr_geometry *geometry,
                                  const struct zr_samples *samples, const struct zr_cancel *cancel,
                                  struct zr_primitives *primitives);

static inline bool zr_primitive_is_empty(const struct zr_primitive *primitive)
{
    return primitive->min_x > primitive->max_x || primitive->min_y > primitive->max_y;
}

#endif
