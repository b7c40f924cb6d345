#include "mesh/features/patch.h"

static const double WIDTH_MOST = 1.1;                     /* of a facet, of the radius */
static const double ACROSS = 5e-3;                        /* sine of the tilt of a facet against the axis */
static const double ACROSS_ON_CIRCLE = 0.1;               /* the same if all its corners lie on the cylinder */
static const double GROW_RADIUS = 2e-3, GROW_SIZE = 1e-5; /* distance from the circle, of radius and size */

static zr_dvec3 place_of(const struct zr_facets *facets, uint32_t triangle, int corner)
{
    return facets->surface->places[facets->surface->corners[triangle][corner]];
}

bool zr_facet_span_of(struct zr_feature_work *work, const struct zr_facets *facets, uint32_t facet,
                      const struct zr_cylinder_frame *frame, double radius_most, struct zr_facet_span *out)
{
    const zr_dvec3 normal = facets->normals[facet], along = zr_dvec3_cross(frame->axis, normal);
    const double squares_most = radius_most * radius_most;
    double first = HUGE_VAL, last = -HUGE_VAL, least = HUGE_VAL, most = 0.0;
    *out = (struct zr_facet_span){.low = HUGE_VAL, .high = -HUGE_VAL};
    if (zr_dvec3_dot(along, along) < 0.5) return false;
    for (uint32_t i = facets->begins[facet]; i < facets->begins[facet + 1]; i++) {
        if (!zr_feature_has_steps(work, 1)) return false;
        for (int k = 0; k < 3; k++) {
            const zr_dvec3 p = zr_dvec3_sub(place_of(facets, facets->triangles[i], k), frame->center);
            const double x = zr_dvec3_dot(p, frame->u), y = zr_dvec3_dot(p, frame->v), z = zr_dvec3_dot(p, frame->axis);
            const double at = zr_dvec3_dot(p, along), squares = x * x + y * y;
            if (squares > squares_most) return false;
            if (at < first) {
                first = at;
                out->first[0] = x;
                out->first[1] = y;
            }
            if (at > last) {
                last = at;
                out->last[0] = x;
                out->last[1] = y;
            }
            if (squares < least) least = squares;
            if (squares > most) most = squares;
            if (z < out->low) out->low = z;
            if (z > out->high) out->high = z;
        }
    }
    const double x = out->first[0] + out->last[0], y = out->first[1] + out->last[1], length = sqrt(x * x + y * y);
    if (length > 0.0)
        out->outwards = (x * zr_dvec3_dot(normal, frame->u) + y * zr_dvec3_dot(normal, frame->v)) / length;
    out->first_radius = sqrt(out->first[0] * out->first[0] + out->first[1] * out->first[1]);
    out->last_radius = sqrt(out->last[0] * out->last[0] + out->last[1] * out->last[1]);
    out->width = last - first;
    out->least = sqrt(least);
    out->most = sqrt(most);
    return true;
}

bool zr_patch_fit(struct zr_feature_work *work, const struct zr_facets *facets, const uint32_t *list, uint32_t count,
                  struct zr_cylinder_frame *frame)
{
    struct zr_normal_sums normals = {0};
    struct zr_circle_sums circle = {0};
    struct zr_facet_span span;
    double x, y;
    for (uint32_t i = 0; i < count; i++)
        zr_normal_sums_add(&normals, facets->normals[list[i]], facets->areas[list[i]]);
    zr_dvec3 axis = zr_normal_sums_axis(&normals);
    if (zr_dvec3_dot(axis, axis) < 0.5) return false;
    if (zr_dvec3_dot(axis, frame->axis) < 0.0) axis = (zr_dvec3){0.0 - axis.x, 0.0 - axis.y, 0.0 - axis.z};
    zr_cylinder_frame_turn(frame, axis);
    for (uint32_t i = 0; i < count; i++) {
        if (!zr_facet_span_of(work, facets, list[i], frame, HUGE_VAL, &span)) return false;
        zr_circle_sums_add(&circle, span.first[0], span.first[1]);
        zr_circle_sums_add(&circle, span.last[0], span.last[1]);
    }
    if (!zr_circle_sums_fit(&circle, &x, &y, &frame->radius)) return false;
    frame->center = zr_dvec3_add_scaled(zr_dvec3_add_scaled(frame->center, frame->u, x), frame->v, y);
    return frame->radius < ZR_PATCH_RADIUS_MOST * facets->surface->size;
}

bool zr_patch_fits(struct zr_feature_work *work, const struct zr_facets *facets, const struct zr_patch *patch,
                   uint32_t facet)
{
    const struct zr_cylinder_frame *frame = &patch->frame;
    const zr_dvec3 normal = facets->normals[facet];
    const double tolerance = zr_most_of(GROW_RADIUS * frame->radius, GROW_SIZE * facets->surface->size);
    const double tilt = fabs(zr_dvec3_dot(normal, frame->axis));
    struct zr_facet_span span;
    if (tilt > ACROSS_ON_CIRCLE) return false;
    if (!zr_facet_span_of(work, facets, facet, frame, frame->radius + tolerance, &span)) return false;
    if (!zr_radius_fits(span.first_radius, frame, tolerance) || !zr_radius_fits(span.last_radius, frame, tolerance) ||
        span.width > WIDTH_MOST * frame->radius)
        return false;
    if (tilt > ACROSS && span.least < frame->radius - tolerance) return false;
    return zr_facet_span_faces(&span, patch->is_concave);
}
