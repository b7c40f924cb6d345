/* Bounds of the geometry in world and eye space. */
#include <float.h>

#include "scene/camera/camera_parts.h"

/* Runs the kernel, or measures point by point if it refuses. */
static void measure_extent(const void *context, enum zr_isa isa, const zr_vec4 *points, uint32_t count,
                           double most[ZR_MEASURES])
{
    (void)context;
    if (zr_fit_extent_of(isa)(points, count, most)) return;
    for (uint32_t i = 0; i < count; i++) {
        zr_dvec3 p;
        if (!zr_place_of(points[i], &p)) continue;
        const double values[ZR_MEASURES] = {p.x, p.y, p.z, -p.x, -p.y, -p.z};
        for (int k = 0; k < ZR_MEASURES; k++)
            zr_raise(&most[k], values[k]);
    }
}

/* False without finite points. */
static bool find_extent(const struct zr_points *points, struct zr_extent *e)
{
    double most[ZR_MEASURES];
    zr_points_most(points, measure_extent, NULL, most);
    *e = (struct zr_extent){{0.0 - most[3], 0.0 - most[4], 0.0 - most[5]}, {most[0], most[1], most[2]}};
    return e->min.x <= e->max.x;
}

/* Far from the origin, rounding moves points, and the view must hold the rounded positions. */
struct zr_extent zr_extent_in_eye_space(const struct zr_points *points, const zr_mat4 *world_to_eye, bool fitted_only)
{
    struct zr_points placed = *points;
    struct zr_extent e;
    placed.world_to_eye = world_to_eye;
    placed.fitted_only = fitted_only;
    return find_extent(&placed, &e) ? e : (struct zr_extent){{0, 0, 0}, {0, 0, 0}};
}

static struct zr_bounds bounds_of(const struct zr_points *points)
{
    struct zr_extent e;
    if (!find_extent(points, &e)) return (struct zr_bounds){.valid = false};
    return (struct zr_bounds){
        true, {(float)e.min.x, (float)e.min.y, (float)e.min.z}, {(float)e.max.x, (float)e.max.y, (float)e.max.z}};
}

struct zr_bounds zr_bounds_of(const struct zr_scene *scene, struct zr_team *team, const struct zr_cancel *cancel)
{
    if (scene->has_box) return (struct zr_bounds){true, scene->box_min, scene->box_max};
    return bounds_of(&(struct zr_points){.scene = scene, .team = team, .cancel = cancel});
}

struct zr_bounds zr_fit_bounds(const struct zr_points *points, const struct zr_bounds *whole)
{
    struct zr_points fitted = *points;
    fitted.fitted_only = true;
    return points->view->fit_to_mesh ? bounds_of(&fitted) : *whole;
}

double zr_size_of(const struct zr_bounds *bounds)
{
    zr_dvec3 diagonal = zr_dvec3_sub(zr_dvec3_of(bounds->max), zr_dvec3_of(bounds->min));
    double size = bounds->valid ? sqrt(zr_dvec3_dot(diagonal, diagonal)) : 0.0;
    return size > 0.0 ? size : 1.0;
}

/* Each operation on a coordinate is off by at most half an ulp of the largest magnitude, `moved` included. Sixteen
 * epsilons cover them all. */
double zr_rounding_of(const struct zr_bounds *bounds, zr_dvec3 moved)
{
    const zr_vec3 low = bounds->min, high = bounds->max;
    const float all[] = {low.x, low.y, low.z, high.x, high.y, high.z};
    double largest = fmax(fabs(moved.x), fmax(fabs(moved.y), fabs(moved.z)));
    for (int i = 0; i < 6 && bounds->valid; i++)
        largest = fmax(largest, fabs((double)all[i]));
    return 16.0 * (double)FLT_EPSILON * largest;
}
