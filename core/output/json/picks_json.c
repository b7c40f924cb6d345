#include "output/json/picks_json.h"

#include <math.h>

#include "base/dvec3.h"
#include "measure/part_distance.h"
#include "mesh/features/angles.h"
#include "mesh/features/part_features.h"
#include "scene/camera/camera.h"

/* Lengths below this share of the bounds' diagonal, and parts of directions below this, are 0. */
static const double zero_share = 1e-7, zero_direction = 1e-6;

struct printing {
    struct zr_print *print;
    const struct zr_frame *frame;
    double zero; /* length */
};

static double snapped(double value, double least)
{
    return fabs(value) < least ? 0.0 : value;
}

static void print_length(const struct printing *p, const char *key, double value)
{
    zr_print_float(p->print, key, (float)snapped(value, p->zero));
}

static void print_vector(const struct printing *p, const char *key, zr_dvec3 v, double zero)
{
    const float out[3] = {(float)snapped(v.x, zero), (float)snapped(v.y, zero), (float)snapped(v.z, zero)};
    zr_print_floats(p->print, key, out, 3);
}

static void print_point(const struct printing *p, const char *key, const double at[3])
{
    const double *moved = p->frame->origin;
    double far[3];
    for (int k = 0; k < 3; k++)
        far[k] = snapped(at[k], p->zero) + (moved ? moved[k] : 0.0);
    if (moved)
        zr_print_doubles(p->print, key, far, 3);
    else
        print_vector(p, key, (zr_dvec3){far[0], far[1], far[2]}, 0.0);
}

static zr_dvec3 vector_of(const double v[3])
{
    return (zr_dvec3){v[0], v[1], v[2]};
}

static bool has_normal(const struct zr_picked *picked)
{
    const zr_dvec3 n = vector_of(picked->normal);
    return zr_dvec3_dot(n, n) > 0.0;
}

/* Prints the feature: the number is that of its group in parts[].features, the place that of the one picked. */
static void print_feature(const struct printing *p, const struct zr_picked *picked)
{
    const struct zr_part_features *features = &p->frame->parts.features[picked->part];
    const struct zr_feature_at *at = &picked->feature;
    const struct zr_hole *holes = at->kind == ZR_FEATURE_BOSS ? features->holes.bosses : features->holes.holes;
    uint32_t number = at->number;
    zr_print_begin(p->print, "feature", '{');
    zr_print_string(p->print, "kind",
                    at->kind == ZR_FEATURE_HOLE   ? "hole"
                    : at->kind == ZR_FEATURE_BOSS ? "boss"
                                                  : "plane");
    if (at->kind != ZR_FEATURE_PLANE) {
        number = 0;
        for (uint32_t i = 0; i < holes[at->number].group; i++)
            number += holes[i].group == i;
    }
    zr_print_count(p->print, "number", number);
    if (at->kind != ZR_FEATURE_PLANE) {
        const struct zr_hole *hole = &holes[at->number];
        const zr_dvec3 a = hole->axis;
        const double place[3] = {hole->at.x, hole->at.y, hole->at.z};
        if (at->step > 0) zr_print_count(p->print, "step", at->step - 1);
        print_length(p, "diameter", at->step > 0 ? hole->steps[at->step - 1].diameter : hole->diameter);
        print_vector(p, "axis", a, zero_direction);
        print_point(p, "at", place);
    }
    zr_print_end(p->print, '}');
}

/* Prints the keys of a surface. */
static void print_picked(const struct printing *p, const struct zr_picked *picked)
{
    if (picked->part != UINT32_MAX)
        zr_print_string(p->print, "part", p->frame->parts.list.at[picked->part].name);
    else
        zr_print_null(p->print, "part");
    zr_print_count(p->print, "instanceId", UINT64_C(1) + picked->instance);
    zr_print_count(p->print, "faceId", picked->face_id);
    if (picked->is_cap) zr_print_bool(p->print, "cap", true);
    if (picked->has_feature) print_feature(p, picked);
    print_point(p, "point", picked->point);
    if (has_normal(picked))
        print_vector(p, "normal", vector_of(picked->normal), zero_direction);
    else
        zr_print_null(p->print, "normal");
    zr_print_float(p->print, "depth", picked->depth);
}

static double distance_of(const struct zr_picked *a, const struct zr_picked *b)
{
    const zr_dvec3 d = zr_dvec3_sub(vector_of(b->point), vector_of(a->point));
    return sqrt(zr_dvec3_dot(d, d));
}

static void print_pick(const struct printing *p, const struct zr_pick *pick)
{
    zr_print_begin(p->print, NULL, '{');
    zr_print_begin(p->print, "pixel", '[');
    zr_print_count(p->print, NULL, pick->x);
    zr_print_count(p->print, NULL, pick->y);
    zr_print_end(p->print, ']');
    if (pick->is_hit)
        print_picked(p, &pick->at);
    else
        zr_print_null(p->print, "part");
    zr_print_begin(p->print, "behind", '[');
    for (uint32_t i = 0; i < pick->behind_count; i++) {
        zr_print_begin(p->print, NULL, '{');
        print_picked(p, &pick->behind[i]);
        print_length(p, "distance", distance_of(&pick->at, &pick->behind[i]));
        zr_print_end(p->print, '}');
    }
    zr_print_end(p->print, ']');
    if (pick->behind_omitted > 0) zr_print_count(p->print, "behindOmitted", pick->behind_omitted);
    zr_print_end(p->print, '}');
}

/* Prints distance, offset and angle between two picks. */
static void print_between(const struct printing *p, uint32_t from, const struct zr_picked *a, const struct zr_picked *b)
{
    const zr_dvec3 d = zr_dvec3_sub(vector_of(b->point), vector_of(a->point)), m = vector_of(a->normal),
                   n = vector_of(b->normal), across = zr_dvec3_cross(m, n);
    zr_print_begin(p->print, NULL, '{');
    zr_print_count(p->print, "from", from);
    zr_print_count(p->print, "to", UINT64_C(1) + from);
    print_length(p, "distance", sqrt(zr_dvec3_dot(d, d)));
    print_vector(p, "offset", d, p->zero);
    if (has_normal(a)) print_length(p, "alongNormal", zr_dvec3_dot(d, m));
    if (has_normal(a) && has_normal(b))
        zr_print_float(
            p->print, "angleDegrees",
            (float)snapped(zr_angle_of(zr_dvec3_dot(m, n), sqrt(zr_dvec3_dot(across, across))), zero_direction));
    zr_print_end(p->print, '}');
}

void zr_picks_print(struct zr_print *print, const struct zr_frame *frame)
{
    const struct zr_picks *picks = &frame->picks;
    const struct printing p = {print, frame, zero_share * (double)zr_diagonal_of(&frame->bounds)};
    if (picks->count == 0) return;
    zr_print_begin(print, "picks", '[');
    for (uint32_t i = 0; i < picks->count; i++)
        print_pick(&p, &picks->at[i]);
    zr_print_end(print, ']');
    zr_print_begin(print, "between", '[');
    for (uint32_t i = 0; i + 1 < picks->count; i++)
        if (picks->at[i].is_hit && picks->at[i + 1].is_hit)
            print_between(&p, i, &picks->at[i].at, &picks->at[i + 1].at);
    zr_print_end(print, ']');
}

void zr_distances_print(struct zr_print *print, const struct zr_frame *frame)
{
    const struct printing p = {print, frame, zero_share * (double)zr_diagonal_of(&frame->bounds)};
    if (frame->distance_count == 0) return;
    zr_print_begin(print, "distances", '[');
    for (uint32_t i = 0; i < frame->distance_count; i++) {
        const struct zr_part_distance *d = &frame->distances[i];
        zr_print_begin(print, NULL, '{');
        zr_print_begin(print, "parts", '[');
        zr_print_string(print, NULL, d->parts[0]);
        zr_print_string(print, NULL, d->parts[1]);
        zr_print_end(print, ']');
        if (d->is_found) {
            print_length(&p, "distance", d->distance);
            print_point(&p, "from", d->places[0]);
            print_point(&p, "to", d->places[1]);
            zr_print_bool(print, "crosses", d->crosses);
        } else {
            zr_print_null(print, "distance");
        }
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}
