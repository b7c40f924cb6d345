#include "output/json/features_json.h"

static void print_place(struct zr_print *print, const char *key, zr_dvec3 at, const double *moved)
{
    double out[3] = {at.x, at.y, at.z};
    for (int k = 0; moved && k < 3; k++)
        out[k] += moved[k];
    zr_print_doubles(print, key, out, 3);
}

/* Prints the holes of a group, whose first one is `first`. */
static void print_places(struct zr_print *print, const struct zr_hole *holes, uint32_t count, uint32_t first,
                         const double *moved)
{
    uint32_t places = 0, printed = 0;
    zr_print_begin(print, "at", '[');
    for (uint32_t i = first; i < count; i++) {
        if (holes[i].group != first || places++ >= ZR_FEATURE_PLACES_MAX) continue;
        print_place(print, NULL, holes[i].at, moved);
        printed++;
    }
    zr_print_end(print, ']');
    zr_print_count(print, "count", places);
    if (printed < places) zr_print_count(print, "atOmitted", places - printed);
}

static void print_group(struct zr_print *print, const struct zr_hole *holes, uint32_t count, uint32_t first,
                        bool is_hole, const double *moved)
{
    const struct zr_hole *hole = &holes[first];
    zr_print_begin(print, NULL, '{');
    zr_print_double(print, "diameter", hole->diameter);
    zr_print_double(print, "acrossFlats", hole->across_flats);
    zr_print_double(print, is_hole ? "depth" : "height", hole->depth);
    if (is_hole && hole->reach == ZR_REACH_UNKNOWN) zr_print_null(print, "through");
    if (is_hole && hole->reach != ZR_REACH_UNKNOWN) zr_print_bool(print, "through", hole->reach == ZR_REACH_THROUGH);
    print_place(print, "axis", hole->axis, NULL);
    print_places(print, holes, count, first, moved);
    zr_print_count(print, "segments", hole->segments);
    zr_print_double(print, "coverageDegrees", hole->coverage);
    if (hole->step_count > 0) {
        zr_print_begin(print, "steps", '[');
        for (uint32_t i = 0; i < hole->step_count; i++) {
            zr_print_begin(print, NULL, '{');
            zr_print_double(print, "diameter", hole->steps[i].diameter);
            zr_print_double(print, "depth", hole->steps[i].depth);
            zr_print_count(print, "segments", hole->steps[i].segments);
            zr_print_end(print, '}');
        }
        zr_print_end(print, ']');
    }
    zr_print_end(print, '}');
}

static void print_groups(struct zr_print *print, const char *key, const char *omitted_key, const struct zr_hole *holes,
                         uint32_t count, bool is_hole, const double *moved)
{
    uint32_t groups = 0;
    zr_print_begin(print, key, '[');
    for (uint32_t i = 0; i < count; i++)
        if (holes[i].group == i && groups++ < ZR_FEATURE_GROUPS_MAX)
            print_group(print, holes, count, i, is_hole, moved);
    zr_print_end(print, ']');
    if (groups > ZR_FEATURE_GROUPS_MAX) zr_print_count(print, omitted_key, groups - ZR_FEATURE_GROUPS_MAX);
}

static void print_fillets(struct zr_print *print, const char *key, const struct zr_holes *holes, bool is_convex)
{
    zr_print_begin(print, key, '[');
    for (uint32_t i = 0, groups = 0; i < holes->fillet_count; i++) {
        if (holes->fillets[i].is_convex != is_convex || groups++ >= ZR_FEATURE_GROUPS_MAX) continue;
        zr_print_begin(print, NULL, '{');
        zr_print_double(print, "radius", holes->fillets[i].radius);
        zr_print_count(print, "count", holes->fillets[i].count);
        zr_print_end(print, '}');
    }
    zr_print_end(print, ']');
}

void zr_features_print(struct zr_print *print, const struct zr_part_features *features, const double *moved)
{
    const struct zr_holes *holes = &features->holes;
    zr_print_begin(print, "features", '{');
    if (features->is_omitted) {
        zr_print_bool(print, "omitted", true);
    } else {
        print_groups(print, "holes", "holesOmitted", holes->holes, holes->hole_count, true, moved);
        print_groups(print, "bosses", "bossesOmitted", holes->bosses, holes->boss_count, false, moved);
        print_fillets(print, "fillets", holes, false);
        print_fillets(print, "rounds", holes, true);
    }
    zr_print_end(print, '}');
}
