#include "scene/camera/extent_view.h"

#include <math.h>

/* Largest extent of a flat scene along an axis, in diagonals of its bounds. */
static const double flat_most = 1e-3;

/* LOW: height from which nothing is raised, 1 / diagonals. RAISED: of what has no height, degrees. */
#define LOW    8.0
#define RAISED 14.0

static void look_along(struct zr_view *view, double azimuth, double elevation)
{
    view->azimuth_degrees = azimuth;
    view->elevation_degrees = elevation;
}

void zr_view_suit_extent(struct zr_view *view, const struct zr_bounds *bounds, bool z_is_up)
{
    if (!view->suits_extent || view->pose != ZR_POSE_ORBIT || !bounds->valid) return;
    const double x = (double)bounds->max.x - (double)bounds->min.x, y = (double)bounds->max.y - (double)bounds->min.y,
                 z = (double)bounds->max.z - (double)bounds->min.z;
    const double height = z_is_up ? z : y, depth = z_is_up ? y : z;
    const double diagonal = sqrt(x * x + y * y + z * z), flat = flat_most * diagonal;
    if (!(diagonal > 0.0) || !isfinite(diagonal)) return;
    if (depth < flat)
        look_along(view, 0.0, 0.0);
    else if (x < flat)
        look_along(view, 90.0, 0.0);
    else if (height < flat)
        look_along(view, 0.0, 90.0);
    else
        view->elevation_degrees += RAISED * fmin(fmax(1.0 - LOW * height / diagonal, 0.0), 1.0);
}
