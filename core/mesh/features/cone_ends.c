#include "mesh/features/cone_ends.h"

enum { TRIANGLES_MOST = 32 /* of a facet of a cone */ };

static const double SIDE_TILT = 0.05;                     /* below: other facets of the cylinder */
static const double TILT_LEAST = 0.17, TILT_MOST = 0.985; /* sine of a facet's normal against the plane of the end */
static const double NEARLY_ALL = 0.98;                    /* of the arc */
static const double TILT_SPREAD = 0.02, REACH_SPREAD = 0.02, SIZE_SPREAD = 2e-5;

/* Sums of one end. */
struct sums {
    double all, cone;                     /* arcs */
    double tilt[2], radius[2], height[2]; /* least and most of the facets of cones */
};

static zr_dvec3 place_of(const struct zr_facets *facets, uint32_t triangle, int corner)
{
    return facets->surface->places[facets->surface->corners[triangle][corner]];
}

static void extend(double range[2], double value)
{
    range[0] = zr_least_of(range[0], value);
    range[1] = zr_most_of(range[1], value);
}

/* Adds how far a facet reaches beyond the end at `from`, up (sign 1) or down (-1). False if it is not of a cone. */
static bool add_facet(struct zr_feature_work *work, const struct zr_facets *facets, uint32_t facet,
                      const struct zr_cylinder_frame *frame, double from, double sign, struct sums *sums)
{
    const double tilt = zr_dvec3_dot(facets->normals[facet], frame->axis);
    double height = 0.0, radius = 0.0;
    if (fabs(tilt) < TILT_LEAST || fabs(tilt) > TILT_MOST) return false;
    if (facets->begins[facet + 1] - facets->begins[facet] > TRIANGLES_MOST) return false;
    for (uint32_t i = facets->begins[facet]; i < facets->begins[facet + 1] && zr_feature_has_steps(work, 1); i++)
        for (int k = 0; k < 3; k++) {
            const zr_dvec3 p = zr_dvec3_sub(place_of(facets, facets->triangles[i], k), frame->center);
            const double x = zr_dvec3_dot(p, frame->u), y = zr_dvec3_dot(p, frame->v),
                         z = sign * (zr_dvec3_dot(p, frame->axis) - from);
            if (z <= height) continue;
            height = z;
            radius = sqrt(x * x + y * y);
        }
    extend(sums->tilt, tilt);
    extend(sums->height, height);
    extend(sums->radius, radius);
    return true;
}

static struct zr_cone_end cone_of(const struct sums *sums, double radius, double size)
{
    const struct zr_cone_end none = {0, 0};
    const double height = 0.5 * (sums->height[0] + sums->height[1]), far = 0.5 * (sums->radius[0] + sums->radius[1]);
    const double least = SIZE_SPREAD * size;
    if (!(sums->all > 0.0 && sums->cone >= NEARLY_ALL * sums->all)) return none;
    if (sums->tilt[1] - sums->tilt[0] > TILT_SPREAD || height <= 2.0 * least) return none;
    if (sums->height[1] - sums->height[0] > REACH_SPREAD * height + least ||
        sums->radius[1] - sums->radius[0] > REACH_SPREAD * fabs(far - radius) + least)
        return none;
    return (struct zr_cone_end){far, height};
}

bool zr_cone_ends_find(struct zr_feature_work *work, const struct zr_facets *facets, const uint32_t *list,
                       uint32_t count, const struct zr_cylinder_frame *frame, double low, double high,
                       struct zr_cone_end ends[2])
{
    const struct sums empty = {
        .tilt = {HUGE_VAL, -HUGE_VAL}, .radius = {HUGE_VAL, -HUGE_VAL}, .height = {HUGE_VAL, -HUGE_VAL}};
    struct sums sums[2] = {empty, empty};
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = facets->begins[list[i]]; j < facets->begins[list[i] + 1]; j++)
            for (int k = 0; k < 3; k++) {
                const uint32_t triangle = facets->triangles[j], next = facets->neighbours[triangle][k];
                const zr_dvec3 from = place_of(facets, triangle, k), to = place_of(facets, triangle, (k + 1) % 3),
                               edge = zr_dvec3_sub(to, from);
                const double along = zr_dvec3_dot(edge, frame->axis), square = zr_dvec3_dot(edge, edge);
                const uint32_t other = next == ZR_NO_FACET ? ZR_NO_FACET : facets->of_triangle[next];
                if (!zr_feature_has_steps(work, 1)) return false;
                if (other == list[i] || along * along > 0.5 * square) continue;
                if (other != ZR_NO_FACET && fabs(zr_dvec3_dot(facets->normals[other], frame->axis)) < SIDE_TILT)
                    continue;
                const double middle = zr_dvec3_dot(zr_dvec3_sub(from, frame->center), frame->axis) + 0.5 * along;
                const int end = middle > 0.5 * (low + high);
                const double arc = sqrt(square - along * along);
                sums[end].all += arc;
                if (other != ZR_NO_FACET &&
                    add_facet(work, facets, other, frame, end ? high : low, end ? 1.0 : -1.0, &sums[end]))
                    sums[end].cone += arc;
            }
    for (int end = 0; end < 2; end++)
        ends[end] = cone_of(&sums[end], frame->radius, facets->surface->size);
    return true;
}
