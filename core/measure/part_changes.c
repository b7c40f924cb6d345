#include "measure/part_changes.h"

#include "base/arena.h"
#include "base/cancel.h"

/* Areas and volumes that differ by this share are the same. */
#define SAME 1e-6

enum { ITEMS_PER_CANCEL_CHECK = 1 << 13 };

struct facts {
    double area, volume, middle[3]; /* volume: of the pyramids; for a closed part it does not depend on its place */
    double min[3], max[3];
    bool is_there;
};

static void add_triangle(const struct zr_solid *solid, uint32_t triangle, struct facts *facts)
{
    struct zr_world_place p[3];
    zr_solid_places(solid, triangle, p);
    const struct zr_world_place n =
        zr_world_place_cross(zr_world_place_minus(p[1], p[0]), zr_world_place_minus(p[2], p[0]));
    const double area = 0.5 * sqrt(zr_world_place_dot(n, n));
    facts->area += area;
    facts->volume += zr_world_place_dot(p[0], n) / 6.0;
    for (int i = 0; i < 3; i++) {
        const double at[3] = {p[i].x, p[i].y, p[i].z};
        for (int k = 0; k < 3; k++) {
            facts->middle[k] += area / 3.0 * at[k];
            facts->min[k] = facts->is_there ? zr_least_of(facts->min[k], at[k]) : at[k];
            facts->max[k] = facts->is_there ? zr_most_of(facts->max[k], at[k]) : at[k];
        }
        facts->is_there = true;
    }
}

/* Returns facts per part, or NULL without memory. */
static struct facts *facts_of(const struct zr_run *run, struct zr_arena *scratch, const struct zr_solid *solid,
                              const struct zr_part_list *parts)
{
    struct facts *facts = zr_arena_zero(scratch, parts->count, sizeof *facts);
    if (!facts) return NULL;
    for (uint32_t t = 0; t < solid->count; t++) {
        if (t % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel)) break;
        if (solid->parts[t] < parts->count) add_triangle(solid, t, &facts[solid->parts[t]]);
    }
    for (uint32_t i = 0; i < parts->count; i++)
        for (int k = 0; k < 3 && facts[i].area > 0.0; k++)
            facts[i].middle[k] /= facts[i].area;
    return facts;
}

/* Compares two parts of one name. False: they are the same. */
static bool compare(const struct facts *a, const struct facts *b, double tolerance, bool is_closed,
                    struct zr_part_change *change)
{
    double squares = 0.0, most = 0.0;
    for (int k = 0; k < 3; k++) {
        change->by[k] = b->middle[k] - a->middle[k];
        squares += change->by[k] * change->by[k];
        most = zr_most_of(most, zr_most_of(fabs(b->min[k] - a->min[k]), fabs(b->max[k] - a->max[k])));
    }
    change->kind = ZR_PART_CHANGED;
    if (fabs(b->area - a->area) > SAME * a->area) return true;
    if (is_closed && fabs(b->volume - a->volume) > SAME * zr_most_of(fabs(a->volume), fabs(b->volume))) return true;
    change->kind = ZR_PART_MOVED;
    return sqrt(squares) > tolerance || most > tolerance;
}

static void add(struct zr_part_changes *out, struct zr_part_change *list, const struct zr_part_change *change)
{
    if (out->count == ZR_PART_CHANGES_MAX)
        out->omitted++;
    else
        list[out->count++] = *change;
}

enum zr_status zr_part_changes_find(const struct zr_run *run, const struct zr_solid *a,
                                    const struct zr_part_list *parts_a, const struct zr_solid *b,
                                    const struct zr_part_list *parts_b, double tolerance, struct zr_part_changes *out)
{
    struct zr_part_change *list = zr_arena_alloc(run->arena, ZR_PART_CHANGES_MAX, sizeof *list);
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct facts *of_a = facts_of(run, &scratch, a, parts_a), *of_b = facts_of(run, &scratch, b, parts_b);
    *out = (struct zr_part_changes){.at = list};
    const bool ok = list && of_a && of_b, is_closed = a->is_closed && b->is_closed;
    for (uint32_t i = 0; ok && i < parts_a->count; i++) {
        const struct zr_part *other = zr_part_list_find(parts_b, parts_a->at[i].name);
        const uint32_t k = other ? (uint32_t)(other - parts_b->at) : 0;
        struct zr_part_change change = {.kind = ZR_PART_REMOVED, .name = parts_a->at[i].name};
        if (!of_a[i].is_there) continue;
        if (!other || !of_b[k].is_there || compare(&of_a[i], &of_b[k], tolerance, is_closed, &change))
            add(out, list, &change);
    }
    for (uint32_t i = 0; ok && i < parts_b->count; i++) {
        const struct zr_part *other = zr_part_list_find(parts_a, parts_b->at[i].name);
        const struct zr_part_change change = {.kind = ZR_PART_ADDED, .name = parts_b->at[i].name};
        if (of_b[i].is_there && (!other || !of_a[other - parts_a->at].is_there)) add(out, list, &change);
    }
    zr_arena_close_scratch(&scratch, run->arena);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ok ? ZR_OK : ZR_NO_MEMORY;
}
