/* symmetry.h - mesh: planes and axes of symmetry of a surface.
 *
 * Center: the mean of the surface by area. All planes and axes of symmetry go through it.
 * Tried:  mirror images and turns across and around x, y and z, and the principal axes of the surface. A principal axis
 *         near one of x, y and z, to 0.8 degrees, is not tried, nor are two of equal moments. Turns have orders from 2
 *         to 24; more, such as those of a disc, are round.
 * Rule:   samples of the surface, mirrored or turned, lie on it, to 0.002 of the size: 1024 by area, and up to 2048 each
 *         of corners and of middles of triangles.
 */
#ifndef ZR_SYMMETRY_H
#define ZR_SYMMETRY_H

#include "base/arena.h"
#include "mesh/features/surface.h"

enum { ZR_SYMMETRIES_MAX = 6, ZR_TURNS_MOST = 24 };

struct zr_turn {
    zr_dvec3 axis;  /* unit length, through the centre */
    uint32_t order; /* equal turns in a circle; 0: round */
};

struct zr_symmetry {
    zr_dvec3 center;
    uint32_t direction_count, mirror_count, turn_count;
    zr_dvec3 directions[ZR_SYMMETRIES_MAX]; /* that were tried */
    zr_dvec3 mirrors[ZR_SYMMETRIES_MAX];    /* normals of planes through the centre */
    struct zr_turn turns[ZR_SYMMETRIES_MAX];
};

/* Finds the centre and the directions. False without steps, or if the surface has no area. */
bool zr_symmetry_begin(struct zr_feature_work *work, const struct zr_surface *surface, struct zr_symmetry *out);

/* Finds the symmetries, after zr_symmetry_begin. Takes scratch from the arena and gives it back. False without memory or
 * steps. */
bool zr_symmetry_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_surface *surface,
                      struct zr_symmetry *out);

#endif
