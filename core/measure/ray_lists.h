/* ray_lists.h - measure: where the rays of a grid cross the faces of two solids.
 *
 * Space:  that of the first solid; `b` has the same middle.
 * Lists:  each ray has its crossings in order, as numbers of 64 bits: height, |cosine| between face and ray, solid,
 *         sign. Equal crossings are equal numbers, so the order of triangles does not matter.
 * Work:   counted beforehand: rows and crossings of triangles. A grid beyond `ZR_RAY_WORK`, or beyond the memory left,
 *         is made coarser. So the grid depends on the solids and the memory alone.
 * Exact:  the same for all instruction sets and numbers of threads.
 */
#ifndef ZR_RAY_LISTS_H
#define ZR_RAY_LISTS_H

#include "measure/solid.h"
#include "mesh/facts/ray_grid.h"

/* Largest number of rows and crossings of a grid, and more of them per triangle. */
enum { ZR_RAY_WORK = 1 << 25, ZR_RAY_WORK_PER_TRIANGLE = 32 };

struct zr_ray_lists {
    struct zr_ray_grid grid;
    const uint32_t *begins;    /* per ray, row by row; one more at the end */
    const uint64_t *crossings; /* ascending on each ray */
};

/* Makes the lists in the arena: at most `rays` along the longer side, in a direction of
 * zr_ray_grid_turn. The diagonals are not
 * both 0. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_ray_lists_make(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                                 int direction, uint32_t rays, struct zr_ray_lists *out);

/* Rays that meet triangles, without their crossings. */
struct zr_ray_hits {
    struct zr_ray_grid grid;
    const uint8_t *hits; /* per ray, row by row: 1 for the first solid, and 2 for the second one */
};

/* Finds them in the arena, as zr_ray_lists_make. */
enum zr_status zr_ray_hits_make(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                                int direction, uint32_t rays, struct zr_ray_hits *out);

enum { ZR_CROSSING_COSINES = (1 << 14) - 1, ZR_CROSSING_HEIGHT_SHIFT = 16 };

static inline uint64_t zr_crossing_of(uint64_t height, double cosine, bool is_b, bool enters)
{
    return height << ZR_CROSSING_HEIGHT_SHIFT | (uint64_t)(cosine * (double)ZR_CROSSING_COSINES + 0.5) << 2 |
           (is_b ? 2u : 0u) | (enters ? 1u : 0u);
}

/* With the tag of a triangle in place of the cosine. */
static inline uint64_t zr_crossing_tagged(uint64_t height, uint8_t tag, bool enters)
{
    return height << ZR_CROSSING_HEIGHT_SHIFT | (uint64_t)tag << 2 | (enters ? 1u : 0u);
}

static inline uint32_t zr_crossing_tag(uint64_t crossing)
{
    return (uint32_t)(crossing >> 2 & UINT8_MAX);
}

static inline bool zr_crossing_is_b(uint64_t crossing)
{
    return crossing >> 1 & 1u;
}

static inline int zr_crossing_sign(uint64_t crossing)
{
    return crossing & 1u ? 1 : -1;
}

static inline double zr_crossing_cosine(uint64_t crossing)
{
    return (double)(crossing >> 2 & ZR_CROSSING_COSINES) / (double)ZR_CROSSING_COSINES;
}

/* Returns the place along the ray, relative to the middle of the grid. */
static inline double zr_crossing_place(const struct zr_ray_grid *grid, uint64_t crossing)
{
    return (double)(crossing >> ZR_CROSSING_HEIGHT_SHIFT) * (2.0 * grid->half[2] / ZR_RAY_HEIGHTS) - grid->half[2];
}

/* The intervals between the crossings of one ray, in order. */
struct zr_ray_interval {
    double from, to;       /* relative to the middle of the grid */
    double enters, leaves; /* cosines between the ray and the faces at both ends */
    int a, b;              /* winding numbers of the solids */
};

/* Returns the thickness across the flatter of both faces. */
static inline double zr_ray_thickness(const struct zr_ray_interval *at)
{
    return (at->to - at->from) * zr_least_of(at->enters, at->leaves);
}

/* A walk along one ray. */
struct zr_ray_walk {
    const struct zr_ray_grid *grid;
    const uint64_t *at, *end;
    int a, b; /* winding numbers before `at` */
};

/* Begins a walk. It has no intervals if a winding number does not come back to 0 at the end of the ray, as between
 * corners that are only nearly equal. */
struct zr_ray_walk zr_ray_walk_begin(const struct zr_ray_lists *lists, uint32_t ray);

/* Finds the next interval in which a winding number is not 0. False: there is none. */
static inline bool zr_ray_walk_next(struct zr_ray_walk *walk, struct zr_ray_interval *out)
{
    while (walk->at + 1 < walk->end) {
        const uint64_t from = walk->at[0], to = walk->at[1];
        *(zr_crossing_is_b(from) ? &walk->b : &walk->a) += zr_crossing_sign(from);
        walk->at++;
        if (walk->a == 0 && walk->b == 0) continue;
        *out = (struct zr_ray_interval){zr_crossing_place(walk->grid, from),
                                        zr_crossing_place(walk->grid, to),
                                        zr_crossing_cosine(from),
                                        zr_crossing_cosine(to),
                                        walk->a,
                                        walk->b};
        return true;
    }
    return false;
}

#endif
