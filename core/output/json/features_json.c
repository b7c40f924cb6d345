#include "output/json/features_json.h"

#include <inttypes.h>
#include <stdio.h>

static const double ZERO = 1e-7, ZERO_DIRECTION = 1e-5;

/* The centre of symmetries has digits down to this share of the size: a tenth of their tolerance
 * (mesh/features/symmetry.h). */
static const double SYMMETRY_STEP = 2e-4;

/* The part that is printed. Places and lengths nearer to 0 than a ten-millionth of the size are 0. */
struct printing {
    struct zr_print *print;
    double size;
    const double *moved; /* added to places, which then are doubles; NULL: nothing */
};

static double snapped(double value, double least)
{
    return fabs(value) < least ? 0.0 : value;
}

static void print_length(const struct printing *p, const char *key, double value)
{
    zr_print_float(p->print, key, (float)value);
}

static void print_direction(const struct printing *p, const char *key, zr_dvec3 v)
{
    const float out[3] = {(float)snapped(v.x, ZERO_DIRECTION), (float)snapped(v.y, ZERO_DIRECTION),
                          (float)snapped(v.z, ZERO_DIRECTION)};
    zr_print_floats(p->print, key, out, 3);
}

static void print_place(const struct printing *p, const char *key, zr_dvec3 at)
{
    const double near[3] = {snapped(at.x, ZERO * p->size), snapped(at.y, ZERO * p->size),
                            snapped(at.z, ZERO * p->size)};
    double far[3];
    float out[3];
    for (int k = 0; k < 3; k++) {
        out[k] = (float)near[k];
        far[k] = near[k] + (p->moved ? p->moved[k] : 0.0);
    }
    if (p->moved)
        zr_print_doubles(p->print, key, far, 3);
    else
        zr_print_floats(p->print, key, out, 3);
}

/* Rounds to a power of ten that is at most `step`. */
static double rounded(double value, double step)
{
    double per_unit = 1.0;
    while (per_unit * step < 1.0 && per_unit < 1e30)
        per_unit *= 10.0;
    while (per_unit * step >= 10.0 && per_unit > 1e-30)
        per_unit /= 10.0;
    return floor(value * per_unit + 0.5) / per_unit;
}

/* Prints the offset of a plane. */
static void print_offset(const struct printing *p, zr_dvec3 normal, double offset)
{
    const double near = snapped(offset, ZERO * p->size), *moved = p->moved;
    if (!moved)
        zr_print_float(p->print, "offset", (float)near);
    else
        zr_print_double(p->print, "offset", near + ((normal.x * moved[0] + normal.y * moved[1]) + normal.z * moved[2]));
}

/* Prints the holes of a group, whose first one is `first`. */
static void print_places(const struct printing *p, const struct zr_hole *holes, uint32_t count, uint32_t first)
{
    uint32_t places = 0, printed = 0;
    zr_print_begin(p->print, "at", '[');
    for (uint32_t i = first; i < count; i++) {
        if (holes[i].group != first || places++ >= ZR_FEATURE_PLACES_MAX) continue;
        print_place(p, NULL, holes[i].at);
        printed++;
    }
    zr_print_end(p->print, ']');
    zr_print_count(p->print, "count", places);
    if (printed < places) zr_print_count(p->print, "atOmitted", places - printed);
}

static void print_pattern(const struct printing *p, const struct zr_pattern *pattern)
{
    if (pattern->kind == ZR_PATTERN_NONE) return;
    zr_print_begin(p->print, "pattern", '{');
    zr_print_string(p->print, "kind", pattern->kind == ZR_PATTERN_CIRCLE ? "circle" : "grid");
    print_place(p, "center", pattern->center);
    if (pattern->kind == ZR_PATTERN_CIRCLE) {
        print_length(p, "diameter", pattern->diameter);
    } else {
        const float pitch[2] = {(float)pattern->pitch[0], (float)pattern->pitch[1]};
        zr_print_begin(p->print, "counts", '[');
        zr_print_count(p->print, NULL, pattern->counts[0]);
        zr_print_count(p->print, NULL, pattern->counts[1]);
        zr_print_end(p->print, ']');
        zr_print_floats(p->print, "pitch", pitch, 2);
    }
    zr_print_end(p->print, '}');
}

void zr_hole_steps_print(struct zr_print *print, const char *key, const struct zr_hole *hole)
{
    const struct printing p = {.print = print};
    zr_print_begin(print, key, '[');
    for (uint32_t i = 0; i < hole->step_count; i++) {
        zr_print_begin(print, NULL, '{');
        print_length(&p, "diameter", hole->steps[i].diameter);
        print_length(&p, "depth", hole->steps[i].depth);
        if (hole->steps[i].angle > 0.0) print_length(&p, "angleDegrees", hole->steps[i].angle);
        zr_print_count(print, "segments", hole->steps[i].segments);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

static void print_group(const struct printing *p, const struct zr_hole *holes, uint32_t count, uint32_t first,
                        bool is_hole)
{
    const struct zr_hole *hole = &holes[first];
    zr_print_begin(p->print, NULL, '{');
    print_length(p, "diameter", hole->diameter);
    print_length(p, "acrossFlats", hole->across_flats);
    print_length(p, is_hole ? "depth" : "height", hole->depth);
    if (is_hole && hole->reach == ZR_REACH_UNKNOWN) zr_print_null(p->print, "through");
    if (is_hole && hole->reach != ZR_REACH_UNKNOWN) zr_print_bool(p->print, "through", hole->reach == ZR_REACH_THROUGH);
    print_direction(p, "axis", hole->axis);
    print_places(p, holes, count, first);
    print_pattern(p, &hole->pattern);
    zr_print_count(p->print, "segments", hole->segments);
    print_length(p, "coverageDegrees", hole->coverage);
    if (hole->step_count > 0) zr_hole_steps_print(p->print, "steps", hole);
    zr_print_end(p->print, '}');
}

static void print_groups(const struct printing *p, const char *key, const char *omitted_key,
                         const struct zr_hole *holes, uint32_t count, bool is_hole)
{
    uint32_t groups = 0;
    zr_print_begin(p->print, key, '[');
    for (uint32_t i = 0; i < count; i++)
        if (holes[i].group == i && groups++ < ZR_FEATURE_GROUPS_MAX) print_group(p, holes, count, i, is_hole);
    zr_print_end(p->print, ']');
    if (groups > ZR_FEATURE_GROUPS_MAX) zr_print_count(p->print, omitted_key, groups - ZR_FEATURE_GROUPS_MAX);
}

static void print_fillets(const struct printing *p, const char *key, const struct zr_holes *holes, bool is_convex)
{
    zr_print_begin(p->print, key, '[');
    for (uint32_t i = 0, groups = 0; i < holes->fillet_count; i++) {
        if (holes->fillets[i].is_convex != is_convex || groups++ >= ZR_FEATURE_GROUPS_MAX) continue;
        zr_print_begin(p->print, NULL, '{');
        print_length(p, "radius", holes->fillets[i].radius);
        zr_print_count(p->print, "count", holes->fillets[i].count);
        zr_print_end(p->print, '}');
    }
    zr_print_end(p->print, ']');
}

static void print_planes(const struct printing *p, const struct zr_planes *planes)
{
    zr_print_begin(p->print, "planes", '[');
    for (uint32_t i = 0; i < planes->count; i++) {
        const struct zr_plane *plane = &planes->at[i];
        zr_print_begin(p->print, NULL, '{');
        print_direction(p, "normal", plane->normal);
        print_offset(p, plane->normal, plane->offset);
        print_length(p, "area", plane->area);
        zr_print_end(p->print, '}');
    }
    zr_print_end(p->print, ']');
}

static void print_borders(const struct printing *p, const struct zr_borders *borders)
{
    if (borders->count == 0) return;
    zr_print_begin(p->print, "openLoops", '[');
    for (uint32_t i = 0; i < borders->count; i++) {
        zr_print_begin(p->print, NULL, '{');
        zr_print_count(p->print, "edges", borders->at[i].edges);
        print_length(p, "length", borders->at[i].length);
        print_place(p, "center", borders->at[i].center);
        zr_print_bool(p->print, "closed", borders->at[i].is_closed);
        zr_print_end(p->print, '}');
    }
    zr_print_end(p->print, ']');
    if (borders->omitted > 0) zr_print_count(p->print, "openLoopsOmitted", borders->omitted);
}

static void print_cylinder(const struct printing *p, const struct zr_bounding_cylinder *cylinder)
{
    if (!cylinder->is_found) return;
    zr_print_begin(p->print, "boundingCylinder", '{');
    print_length(p, "diameter", cylinder->diameter);
    print_length(p, "height", cylinder->height);
    print_direction(p, "axis", cylinder->axis);
    print_place(p, "at", cylinder->at);
    zr_print_end(p->print, '}');
}

static void print_symmetry(const struct printing *p, const struct zr_symmetry *symmetry)
{
    const double step = SYMMETRY_STEP * p->size;
    const zr_dvec3 center = {rounded(symmetry->center.x, step), rounded(symmetry->center.y, step),
                             rounded(symmetry->center.z, step)};
    zr_print_begin(p->print, "symmetry", '{');
    zr_print_begin(p->print, "mirror", '[');
    for (uint32_t i = 0; i < symmetry->mirror_count; i++) {
        const zr_dvec3 normal = symmetry->mirrors[i];
        const double offset = (normal.x * center.x + normal.y * center.y) + normal.z * center.z;
        zr_print_begin(p->print, NULL, '{');
        print_direction(p, "normal", normal);
        print_offset(p, normal, offset);
        zr_print_end(p->print, '}');
    }
    zr_print_end(p->print, ']');
    zr_print_begin(p->print, "turn", '[');
    for (uint32_t i = 0; i < symmetry->turn_count; i++) {
        zr_print_begin(p->print, NULL, '{');
        print_direction(p, "axis", symmetry->turns[i].axis);
        print_place(p, "at", center);
        if (symmetry->turns[i].order > 0)
            zr_print_count(p->print, "order", symmetry->turns[i].order);
        else
            zr_print_null(p->print, "order");
        zr_print_end(p->print, '}');
    }
    zr_print_end(p->print, ']');
    zr_print_end(p->print, '}');
}

/* Prints which limit kept holes from being searched, and its number. */
static void print_limit(struct zr_print *print, const struct zr_part_features *features)
{
    char text[160] = "too little memory is left";
    if (features->limit == ZR_FEATURE_LIMIT_FACES)
        snprintf(text, sizeof text, "the mesh has more than %d faces", ZR_FEATURE_FACES_MOST);
    if (features->limit == ZR_FEATURE_LIMIT_STEPS)
        snprintf(text, sizeof text,
                 "the search takes more than %" PRIu64 " steps: %d per triangle, and a share of %d for all parts",
                 features->steps_most, ZR_FEATURE_STEPS, ZR_FEATURE_STEPS_MIN);
    zr_print_string(print, "omittedReason", text);
}

void zr_features_print(struct zr_print *print, const struct zr_part_features *features, const double *moved)
{
    const struct zr_holes *holes = &features->holes;
    const struct printing p = {print, features->size, moved};
    zr_print_begin(print, "features", '{');
    if (features->is_omitted) {
        zr_print_bool(print, "omitted", true);
        print_limit(print, features);
    } else {
        print_groups(&p, "holes", "holesOmitted", holes->holes, holes->hole_count, true);
        print_groups(&p, "bosses", "bossesOmitted", holes->bosses, holes->boss_count, false);
        print_fillets(&p, "fillets", holes, false);
        print_fillets(&p, "rounds", holes, true);
    }
    print_planes(&p, &features->planes);
    print_borders(&p, &features->borders);
    print_cylinder(&p, &features->cylinder);
    if (features->has_symmetry) print_symmetry(&p, &features->symmetry);
    if (features->tunnels.is_known) zr_print_count(print, "handles", features->tunnels.count);
    zr_print_end(print, '}');
}
