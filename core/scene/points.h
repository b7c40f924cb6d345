/* points.h - scene: the most of what its points reach, such as the largest x of all: all threads look for it.
 *
 * Space:    world or eye space.
 * Exact:    the most is the same in whatever order points are looked at; of zeros none has a sign.
 */
#ifndef ZR_POINTS_H
#define ZR_POINTS_H

#include <math.h>

#include "base/team.h"
#include "scene/scene.h"
#include "zraster.h"

/* Which points are looked at, and by whom. */
struct zr_points {
    const struct zr_scene *scene;
    const struct zr_view *view;     /* that is fitted; may be NULL without fitted_only */
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

static inline void zr_raise(double *most, double value)
{
    *most = value > *most ? value : *most;
}

#endif
