/* refined.h - measure: the surface of a solid, cut finely enough for colours by its distance from another solid.
 *
 * Edges:  each edge longer than `longest` is halved, and so is each edge longer than `finest` along which the surface
 *         enters another class. Both faces of an edge decide alike, so there are no gaps.
 * Class:  near (the distance is at most `near`), outside or inside the other solid. The class of a triangle is that of
 *         most of its corners. Distances from an open solid have no sign: it has no inside.
 * Search: edges that balls without the other surface cover, around their ends, are not looked at.
 * Work:   each round halves edges; a round that would give more than ZR_REFINED_MOST triangles beyond those of the
 *         solid is not begun. Beyond ZR_REFINED_STEPS of searching, there is no result.
 * Exact:  the same for all numbers of threads.
 */
#ifndef ZR_REFINED_H
#define ZR_REFINED_H

#include "measure/surface_tree.h"

enum { ZR_REFINED_MOST = 1 << 19, ZR_REFINED_STEPS = 1 << 30 };

enum zr_surface_class { ZR_SURFACE_NEAR, ZR_SURFACE_OUTSIDE, ZR_SURFACE_INSIDE, ZR_SURFACE_CLASSES };

struct zr_refined_triangle {
    struct zr_world_place at[3];
    double distance[3]; /* with sign, positive outside */
    enum zr_surface_class own;
};

struct zr_refined {
    uint32_t count;
    const struct zr_refined_triangle *at;
    bool is_omitted; /* too much work, as for deviations */
};

struct zr_refining {
    double longest, finest; /* finest: HUGE_VAL for classes that do not matter */
    double near;
    double reach; /* distances beyond it are only known to be at least this; HUGE_VAL: all are known */
};

/* Cuts the surface of `solid` by its distance from `other`, in the arena. Takes scratch and gives it back. Fails with
 * ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_refined_make(const struct zr_run *run, const struct zr_solid *solid,
                               const struct zr_surface_tree *other, const struct zr_refining *how,
                               struct zr_refined *out);

#endif
