/* points.h - scene: maxima of measures over all points of a scene, such as the largest x, found on all threads.
 *
 * Space:  world or eye space.
 * Exact:  a maximum does not depend on the order of points; zeros are positive.
 */
#ifndef ZR_POINTS_H
#define ZR_POINTS_H

#include <math.h>

#include "base/team.h"
#include "core.h"
#include "scene/scene.h"

struct zr_bounds;

/* Selects points, their space and the threads. */
struct zr_points {
    const struct zr_scene *scene;
    const struct zr_view *view;     /* fitted view; may be NULL without fitted_only */
    struct zr_team *team;           /* NULL: one thread */
    const struct zr_cancel *cancel; /* may be NULL; if cancelled, the search returns its maxima so far */
    bool fitted_only;               /* points of the fitted mesh only, if the view names one */
    bool with_hidden;               /* also points of elements that are not shown, and of tools */
    const struct zr_bounds *corners; /* eight points instead of those of the scene; NULL: none */
    const zr_mat4 *world_to_eye;    /* points in eye space, in the same floats as drawing; NULL: in world space */
};

enum { ZR_MEASURES = 6 };

/* Raises each of most[] to the largest measure of the points. Points may come in any order, and more than once. */
typedef void zr_points_measure_fn(const void *context, enum zr_isa isa, const zr_vec4 *points, uint32_t count,
                                  double most[ZR_MEASURES]);

/* Finds the maxima; -HUGE_VAL for measures that no point raises. */
void zr_points_most(const struct zr_points *points, zr_points_measure_fn *measure, const void *context,
                    double most[ZR_MEASURES]);

static inline void zr_raise(double *most, double value)
{
    *most = value > *most ? value : *most;
}

#endif
