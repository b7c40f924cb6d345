/* points.h - scene: the most of what its points reach, such as the largest x of all: all threads look for it.
 *
 * Space:    world or eye space, in doubles.
 *
 * Left out: points at infinity (w = 0), or beyond the range of float.
 * Exact:    the most is the same in whatever order points are looked at; of zeros none has a sign.
 */
#ifndef ZR_POINTS_H
#define ZR_POINTS_H

#include <float.h>
#include <math.h>

#include "base/team.h"
#include "scene/scene.h"
#include "zraster.h"

typedef struct {
    double x, y, z;
} zr_dvec3;

/* Which points are looked at, and by whom. */
struct zr_points {
    const struct zr_scene *scene;
    struct zr_team *team;           /* may be NULL: one thread */
    const struct zr_cancel *cancel; /* may be NULL; cancelled, all below return early, with what they have */
    bool fitted_only;               /* those of the mesh that the view is fitted to, where it names one */
    const zr_mat4 *world_to_eye;    /* into eye space, in the floats that are drawn; NULL: in world space */
};

enum { ZR_MEASURES = 6 };

/* Raises each of most[] to what any of the points reaches; no matter how often, and in which order, a point is looked
 * at. */
typedef void zr_points_measure_fn(const void *context, enum zr_isa isa, const zr_vec4 *points, uint32_t count,
                                  double most[ZR_MEASURES]);

/* Where no point has a place, or `measure` never writes, -HUGE_VAL. */
void zr_points_most(const struct zr_points *points, zr_points_measure_fn *measure, const void *context,
                    double most[ZR_MEASURES]);

/* False for what has no place. By 1 nothing need be divided, and mostly that is w: a third of the time of a walk. */
static inline bool zr_point_place(zr_vec4 p, zr_dvec3 *out)
{
    const double w = (double)p.w, most = (double)FLT_MAX;
    *out = (zr_dvec3){(double)p.x, (double)p.y, (double)p.z};
    if (p.w != 1.0f) *out = (zr_dvec3){out->x / w, out->y / w, out->z / w};
    return p.w != 0.0f && fabs(out->x) <= most && fabs(out->y) <= most && fabs(out->z) <= most;
}

static inline void zr_raise(double *most, double value)
{
    *most = value > *most ? value : *most;
}

/* ---- two measures as kernels, for fit.c: false, and nothing raised, where points are fewer than a vector's lanes, or
 * one is not finite or has a w that is not 1 ---- */

/* Raises most[0], [1], [2] to x, y, z, and [3], [4], [5] to -x, -y, -z. */
typedef bool zr_points_extent_fn(const zr_vec4 *points, uint32_t count, double most[ZR_MEASURES]);

zr_points_extent_fn zr_points_extent_scalar, zr_points_extent_sse2, zr_points_extent_avx2, zr_points_extent_avx512,
    zr_points_extent_neon;

zr_points_extent_fn *zr_points_extent_of(enum zr_isa isa);

/* Coordinates of points, and how far those reach across slopes that open along the last of them. */
struct zr_slopes {
    zr_dvec3 origin, axes[3];
    double shear;                    /* of x, by y */
    double right, left, top, bottom; /* of x and of y, by z */
};

enum zr_slope { ZR_SLOPE_RIGHT, ZR_SLOPE_LEFT, ZR_SLOPE_TOP, ZR_SLOPE_BOTTOM, ZR_SLOPE_NEAR };

/* Raises most[ZR_SLOPE_RIGHT] to x + right z, [ZR_SLOPE_LEFT] to -(x + left z), [ZR_SLOPE_TOP] to y + top z,
 * [ZR_SLOPE_BOTTOM] to -(y + bottom z), [ZR_SLOPE_NEAR] to z, x being sheared. */
typedef bool zr_points_slopes_fn(const struct zr_slopes *slopes, const zr_vec4 *points, uint32_t count,
                                 double most[ZR_MEASURES]);

zr_points_slopes_fn zr_points_slopes_scalar, zr_points_slopes_sse2, zr_points_slopes_avx2, zr_points_slopes_avx512,
    zr_points_slopes_neon;

zr_points_slopes_fn *zr_points_slopes_of(enum zr_isa isa);

#endif
