/* Position of the eye at which the window holds the geometry. */
#include <float.h>

#include "scene/camera/camera_parts.h"
#include "scene/camera/margins.h"

/* Inputs of a perspective fit. `size`: diagonal of the bounds; `rounding`: error of a coordinate, zr_rounding_of. */
struct fitting {
    const struct zr_points *points;
    struct zr_opening opening;
    double size, rounding;
};

/* Returns a point in coordinates along the axes, from the eye. */
static zr_dvec3 along(const struct zr_axes *axes, zr_dvec3 p)
{
    zr_dvec3 q = zr_dvec3_sub(p, axes->eye);
    return (zr_dvec3){zr_dvec3_dot(q, axes->right), zr_dvec3_dot(q, axes->up), zr_dvec3_dot(q, axes->back)};
}

struct slopes {
    const struct zr_axes *axes;
    const struct zr_opening *opening;
};

/* Runs the kernel, or measures point by point if it refuses. */
static void measure_slopes(const void *context, enum zr_isa isa, const zr_vec4 *points, uint32_t count,
                           double most[ZR_MEASURES])
{
    const struct slopes *slopes = context;
    const struct zr_opening *o = slopes->opening;
    if (zr_fit_slopes_of(isa)(slopes->axes, o, points, count, most)) return;
    for (uint32_t i = 0; i < count; i++) {
        zr_dvec3 p;
        if (!zr_place_of(points[i], &p)) continue;
        const zr_dvec3 q = along(slopes->axes, p);
        const double x = q.x - o->shear * q.y;
        zr_raise(&most[ZR_SLOPE_RIGHT], x + o->right * q.z);
        zr_raise(&most[ZR_SLOPE_LEFT], -(x + o->left * q.z));
        zr_raise(&most[ZR_SLOPE_TOP], q.y + o->top * q.z);
        zr_raise(&most[ZR_SLOPE_BOTTOM], -(q.y + o->bottom * q.z));
        zr_raise(&most[ZR_SLOPE_NEAR], q.z);
    }
}

static void find_slopes(const struct zr_points *points, const struct zr_opening *opening, const struct zr_axes *axes,
                        double most[ZR_MEASURES])
{
    zr_points_most(points, measure_slopes, &(struct slopes){axes, opening}, most);
}

/* Moves the eye sideways and back until the opening just holds every point.
 *
 * An eye at e and distance d sees a point at x, with z towards the camera, if left (d - z) <= x - e <= right (d - z).
 * So e lies between the largest x + right z - right d and the smallest x + left z - left d. At the least distance the
 * two are equal. (The smallest is the negated maximum of negated values.) */
static void fit_freely(const struct fitting *fitting, struct zr_axes *axes)
{
    const struct zr_opening *o = &fitting->opening;
    const double rounding = fitting->rounding, sheared = rounding * (1.0 + fabs(o->shear));
    double most[ZR_MEASURES], distance = fitting->size, x = 0.0, y = 0.0;
    find_slopes(fitting->points, o, axes, most);
    if (most[ZR_SLOPE_NEAR] > -HUGE_VAL) {
        const double right = most[ZR_SLOPE_RIGHT] + sheared * (1.0 + fabs(o->right)),
                     left = -most[ZR_SLOPE_LEFT] - sheared * (1.0 + fabs(o->left)),
                     top = most[ZR_SLOPE_TOP] + rounding * (1.0 + fabs(o->top)),
                     bottom = -most[ZR_SLOPE_BOTTOM] - rounding * (1.0 + fabs(o->bottom));
        distance = fmax((right - left) / (o->right - o->left), (top - bottom) / (o->top - o->bottom));
        distance = fmax(distance, (most[ZR_SLOPE_NEAR] + rounding) + 0.05 * fitting->size);
        y = 0.5 * ((top - o->top * distance) + (bottom - o->bottom * distance));
        x = 0.5 * ((right - o->right * distance) + (left - o->left * distance)) + o->shear * y;
    }
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->right, x);
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->up, y);
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->back, distance);
}

/* Context of measure_retreat. */
struct retreat {
    const struct fitting *fitting;
    const struct zr_axes *axes;
};

/* Raises most[0] to the distance by which the eye must move back to see the points, without moving sideways. */
static void measure_retreat(const void *context, enum zr_isa isa, const zr_vec4 *points, uint32_t count,
                            double most[ZR_MEASURES])
{
    (void)isa;
    const struct retreat *retreat = context;
    const struct zr_opening *o = &retreat->fitting->opening;
    const double rounding = retreat->fitting->rounding, least = 0.05 * retreat->fitting->size;
    for (uint32_t i = 0; i < count; i++) {
        zr_dvec3 p;
        if (!zr_place_of(points[i], &p)) continue;
        const zr_dvec3 q = along(retreat->axes, p);
        double x = q.x - o->shear * q.y, around = rounding * (1.0 + fabs(o->shear));
        double wide = fmax((x + around) / o->right, (x - around) / o->left);
        double tall = fmax((q.y + rounding) / o->top, (q.y - rounding) / o->bottom);
        zr_raise(&most[0], q.z + rounding + fmax(fmax(wide, tall), least));
    }
}

/* Moves the eye straight back: the target stays on the view axis. ZR_BAD_SCENE if the axis is outside the window. */
static enum zr_status fit_on_axis(const struct fitting *fitting, struct zr_axes *axes, struct zr_error *error)
{
    const struct zr_opening *o = &fitting->opening;
    if (!(o->left < 0.0 && o->right > 0.0 && o->bottom < 0.0 && o->top > 0.0))
        return zr_error_add(error, ZR_BAD_SCENE, "/view/target",
                            "no distance shows the geometry: the principal point is outside of the window");
    const struct retreat retreat = {fitting, axes};
    double most[ZR_MEASURES];
    zr_points_most(fitting->points, measure_retreat, &retreat, most);
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->back, most[0] > 0.0 ? most[0] : fitting->size);
    return ZR_OK;
}

/* Measures extents along the axes; all zero without finite points. */
static void find_extent_along(const struct zr_points *points, const struct zr_axes *axes, double most[ZR_MEASURES])
{
    static const struct zr_opening no_slopes = {0};
    find_slopes(points, &no_slopes, axes, most);
    for (int k = 0; k < ZR_MEASURES; k++)
        if (most[k] == -HUGE_VAL) most[k] = 0.0;
}

/* Moves the eye so that margins that differ are free. `x`, `y`: half sizes of the points. */
static void move_to_margins(const struct zr_view *view, double x, double y, struct zr_axes *axes)
{
    const struct zr_margins free = zr_view_margins(view);
    const double aspect = (double)view->width / (double)view->height;
    const double ymag = fmax(y / (1.0 - free.top - free.bottom), x / aspect / (1.0 - free.left - free.right));
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->right, (free.right - free.left) * ymag * aspect);
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->up, (free.top - free.bottom) * ymag);
}

/* Without perspective, the distance does not change the picture: the eye is one diagonal of the bounds in front of the
 * nearest point of the whole scene. free: centres the eye on the fitted points. */
static void fit_parallel(const struct zr_points *fitted, double size, bool free, struct zr_axes *axes)
{
    double most[ZR_MEASURES], of_all[ZR_MEASURES];
    find_extent_along(fitted, axes, most);
    double nearest = most[ZR_SLOPE_NEAR];
    if (fitted->view->fit_to_mesh) {
        struct zr_points all = *fitted;
        all.fitted_only = false;
        all.corners = NULL;
        find_extent_along(&all, axes, of_all);
        nearest = of_all[ZR_SLOPE_NEAR];
    }
    if (free) {
        axes->eye = zr_dvec3_add_scaled(axes->eye, axes->right, (most[ZR_SLOPE_RIGHT] - most[ZR_SLOPE_LEFT]) * 0.5);
        axes->eye = zr_dvec3_add_scaled(axes->eye, axes->up, (most[ZR_SLOPE_TOP] - most[ZR_SLOPE_BOTTOM]) * 0.5);
        if (zr_view_has_room(fitted->view) && !(fitted->view->xmag > 0.0f))
            move_to_margins(fitted->view, (most[ZR_SLOPE_RIGHT] + most[ZR_SLOPE_LEFT]) * 0.5,
                            (most[ZR_SLOPE_TOP] + most[ZR_SLOPE_BOTTOM]) * 0.5, axes);
    }
    axes->eye = zr_dvec3_add_scaled(axes->eye, axes->back, nearest + size);
}

enum zr_status zr_fit_eye(const struct zr_points *points, const struct zr_bounds *bounds, struct zr_axes *axes,
                          struct zr_error *error)
{
    const struct zr_view *view = points->view;
    struct zr_points fitted = *points;
    fitted.fitted_only = true;
    if (zr_view_fits_corners(view) && bounds->valid) fitted.corners = bounds;
    bool free = view->pose != ZR_POSE_ORBIT || !view->has_target;
    zr_dvec3 min = zr_dvec3_of(bounds->min), max = zr_dvec3_of(bounds->max);
    if (!free)
        axes->eye = zr_dvec3_of(view->target);
    else if (bounds->valid)
        axes->eye = (zr_dvec3){(min.x + max.x) * 0.5, (min.y + max.y) * 0.5, (min.z + max.z) * 0.5};
    if (view->pose == ZR_POSE_ORBIT && view->distance > 0.0f) {
        axes->eye = zr_dvec3_add_scaled(axes->eye, axes->back, (double)view->distance);
        return ZR_OK;
    }
    if (!zr_view_is_perspective(view)) {
        fit_parallel(&fitted, zr_size_of(bounds), free, axes);
        return ZR_OK;
    }
    struct fitting fitting = {&fitted, zr_opening_of(view), zr_size_of(bounds), zr_rounding_of(bounds, axes->eye)};
    if (!free) return fit_on_axis(&fitting, axes, error);
    fit_freely(&fitting, axes);
    return ZR_OK;
}
