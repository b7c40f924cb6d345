#include "mesh/features/feature_at.h"

#include "base/dvec3.h"
#include "base/trig.h"
#include "mesh/features/part_features.h"

/* Shares of the radius, of the part's size, and of a unit normal within which places and normals agree. */
static const double radius_share = 5e-3, size_share = 2e-5, normal_share = 0.05, plane_share = 1e-5;

/* A place seen from a hole: distances along the axis and from it, and the normal along both. */
struct seen {
    double along, away, normal_along, normal_away;
};

static struct seen see(const struct zr_hole *hole, zr_dvec3 at, zr_dvec3 normal)
{
    const zr_dvec3 from = zr_dvec3_sub(at, hole->at);
    const double along = zr_dvec3_dot(from, hole->axis);
    const zr_dvec3 across = zr_dvec3_add_scaled(from, hole->axis, -along);
    const double away = sqrt(zr_dvec3_dot(across, across));
    return (struct seen){along, away, zr_dvec3_dot(normal, hole->axis),
                         away > 0.0 ? zr_dvec3_dot(normal, across) / away : 0.0};
}

/* True if the distance from the axis is that of a wall of this diameter; `least` is that of its facets' middles. */
static bool is_on_wall(const struct seen *s, double diameter, double least, double near)
{
    const double slack = near + radius_share * 0.5 * diameter;
    return s->away <= 0.5 * diameter + slack && s->away >= 0.5 * least - slack && fabs(s->normal_along) <= normal_share;
}

static double flats_of(double diameter, uint32_t segments)
{
    double sine, cosine;
    if (segments < 3) return diameter;
    zr_sine_cosine(180.0 / (double)segments, &sine, &cosine);
    return diameter * cosine;
}

/* True if a place on a cone, which narrows down to the hole, has the cone's normal. */
static bool is_on_cone(const struct seen *s, const struct zr_hole_step *step, double narrow, double near)
{
    double sine, cosine;
    zr_sine_cosine(0.5 * step->angle, &sine, &cosine);
    return s->away <= 0.5 * step->diameter + near && s->away >= 0.5 * flats_of(narrow, step->segments) - near &&
           fabs(fabs(s->normal_along) - sine) <= normal_share;
}

/* Returns 0 if the place is not on the hole, 1 if on its cylinder, 2 + number of a step. */
static uint32_t where_on(const struct zr_hole *hole, double size, zr_dvec3 at, zr_dvec3 normal)
{
    const struct seen s = see(hole, at, normal);
    const double near = size_share * size, slack = near + radius_share * hole->diameter;
    double length = hole->depth;
    for (uint32_t i = 0; i < hole->step_count; i++)
        length += hole->steps[i].depth;
    if (s.along < -slack || s.along > length + slack) return 0;
    if (fabs(s.normal_away) > normal_share && is_on_wall(&s, hole->diameter, hole->across_flats, near)) return 1;
    for (uint32_t i = 0; i < hole->step_count; i++) {
        const struct zr_hole_step *step = &hole->steps[i];
        if (step->angle > 0.0 ? is_on_cone(&s, step, hole->diameter, slack)
                              : is_on_wall(&s, step->diameter, flats_of(step->diameter, step->segments), near))
            return 2 + i;
    }
    return 0;
}

static bool find_round(const struct zr_hole *holes, uint32_t count, double size, zr_dvec3 at, zr_dvec3 normal,
                       struct zr_feature_at *out)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t where = where_on(&holes[i], size, at, normal);
        if (where == 0) continue;
        out->number = i;
        out->step = where - 1;
        return true;
    }
    return false;
}

static bool find_plane(const struct zr_planes *planes, double size, zr_dvec3 at, zr_dvec3 normal, uint32_t *number)
{
    for (uint32_t i = 0; i < planes->count; i++) {
        const struct zr_plane *plane = &planes->at[i];
        *number = i;
        if (fabs(zr_dvec3_dot(plane->normal, normal)) >= 1.0 - plane_share &&
            fabs(zr_dvec3_dot(plane->normal, at) - plane->offset) <= size_share * size)
            return true;
    }
    return false;
}

struct zr_feature_at zr_feature_find_at(const struct zr_part_features *features, const double place[3],
                                        const double direction[3])
{
    const zr_dvec3 at = {place[0], place[1], place[2]}, normal = {direction[0], direction[1], direction[2]};
    const struct zr_holes *holes = &features->holes;
    struct zr_feature_at found = {.kind = ZR_FEATURE_NONE};
    if (!features->is_omitted && find_round(holes->holes, holes->hole_count, features->size, at, normal, &found))
        found.kind = ZR_FEATURE_HOLE;
    else if (!features->is_omitted && find_round(holes->bosses, holes->boss_count, features->size, at, normal, &found))
        found.kind = ZR_FEATURE_BOSS;
    else if (find_plane(&features->planes, features->size, at, normal, &found.number))
        found.kind = ZR_FEATURE_PLANE;
    else
        found = (struct zr_feature_at){.kind = ZR_FEATURE_NONE};
    return found;
}
