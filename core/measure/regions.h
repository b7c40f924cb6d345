/* regions.h - measure: connected regions that only one of two closed solids has.
 *
 * Rays:    a grid along one oblique direction. Intervals inside one solid alone are joined with those of the four
 *          neighbours that they overlap, or would overlap if the faces at their ends were continued. So a thin region
 *          along faces that rays graze is one.
 * Thin:    intervals whose thickness, across the flatter of the faces at their ends, is at most `thin` are left out.
 *          Faces that coincide but are cut into other triangles give such slivers, which are long
 *          where rays graze them.
 * Small:   regions of less than the volume of eight cells are left out.
 * Bounds:  a box and a volume are those of the rays: a side may be short by a cell of the grid.
 * Exact:   one thread, in a fixed order.
 */
#ifndef ZR_REGIONS_H
#define ZR_REGIONS_H

#include "measure/ray_lists.h"

enum { ZR_REGIONS_MAX = 64 };

struct zr_region {
    bool is_b; /* only b has it: added; else removed */
    double volume;
    double min[3], max[3];
    double center[3];         /* of its volume */
    double thickness;         /* largest */
    struct zr_world_place at; /* the middle of its thickest interval */
};

struct zr_regions {
    uint32_t count, omitted;             /* omitted: the smallest ones, beyond ZR_REGIONS_MAX */
    double cell;                         /* side of a cell of the grid */
    struct zr_region at[ZR_REGIONS_MAX]; /* largest volumes first */
};

/* Finds the regions of two closed solids on the rays of one oblique direction. Takes scratch from the arena and gives
 * it back. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_regions_find(const struct zr_run *run, const struct zr_ray_lists *lists, double thin,
                               struct zr_regions *out);

#endif
