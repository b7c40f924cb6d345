#include "mesh/features/holes.h"

#include <string.h>

#include "base/sort.h"
#include "mesh/features/angles.h"
#include "mesh/features/axis_lines.h"

enum { SEGMENTS_LEAST = 8, FILLET_FACETS_LEAST = 4, NO_LINK = -1 };

static const double MORE_THAN_HALF = 185.0, WHOLE = 355.0, FILLET_LEAST = 45.0; /* degrees */
static const double OFF_AXIS = 1e-2, OFF_AXIS_SIZE = 2e-5;                      /* of the lesser radius, and the size */
static const double TOUCH = 1e-4;                                               /* of the size */
static const double CONE = 1.5;              /* of the difference of radii: length of a cone between two steps */
static const double SAME = 2e-3;             /* relative difference of equal measures */
static const double SAME_SIZE = 2e-5;        /* the same, of the size */
static const double SAME_DIRECTION = 0.9998; /* cosine of 1.1 degrees */
static const double SAME_FILLET = 1e-2;
static const double FILLET_ERROR = 5e-4, FILLET_NOISE = 4.0; /* of the radius, and of the noise */

/* A cylinder that may be a hole or a boss. */
struct round {
    const struct zr_cylinder *cylinder;
    struct zr_cylinder_ends ends;
    int64_t links[2]; /* the round that meets the low and the high end, or NO_LINK */
    bool is_listed;
};

struct finding {
    struct zr_feature_work *work;
    const struct zr_facets *facets;
    struct round *rounds;
    uint32_t count;
};

/* ---- rounds ---- */

static bool is_round(const struct zr_cylinder *cylinder)
{
    return cylinder->coverage > MORE_THAN_HALF && (cylinder->segments >= SEGMENTS_LEAST || cylinder->coverage >= WHOLE);
}

static bool is_hole(const struct round *round)
{
    const struct zr_cylinder_ends *ends = &round->ends;
    return round->cylinder->is_concave && !ends->is_filled &&
           !(ends->end[0] == ZR_END_CLOSED && ends->end[1] == ZR_END_CLOSED);
}

static bool look_at_ends(struct zr_arena *scratch, const struct finding *f)
{
    const struct zr_surface *surface = f->facets->surface;
    if (f->count == 0) return true;
    const struct zr_triangle_bounds *bounds = zr_triangle_bounds_make(scratch, f->work, surface);
    uint32_t *room = zr_arena_alloc(scratch, surface->triangle_count, sizeof *room);
    if (!bounds || !room) return false;
    for (uint32_t i = 0; i < f->count; i++)
        if (!zr_axis_lines_look(f->work, surface, bounds, f->rounds[i].cylinder, room, &f->rounds[i].ends))
            return false;
    return true;
}

/* Links two holes if they are coaxial and an end of one meets an end of the other, or with a cone between them. */
static void link(const struct finding *f, uint32_t i, uint32_t k, bool has_cone)
{
    struct round *a = &f->rounds[i], *b = &f->rounds[k];
    const double size = f->facets->surface->size, ra = a->cylinder->frame.radius, rb = b->cylinder->frame.radius;
    const double most = TOUCH * size + (has_cone ? CONE * fabs(ra - rb) : 0.0);
    double range[2];
    if (!zr_cylinders_share_axis(a->cylinder, b->cylinder,
                                 zr_most_of(OFF_AXIS * zr_least_of(ra, rb), OFF_AXIS_SIZE * size)))
        return;
    zr_cylinder_range_along(a->cylinder, b->cylinder, range);
    const bool is_turned = zr_dvec3_dot(a->cylinder->frame.axis, b->cylinder->frame.axis) < 0.0;
    const double above = range[0] - a->cylinder->high, below = a->cylinder->low - range[1];
    const int end = above >= below;
    const double gap = end ? above : below;
    if (gap < -TOUCH * size || gap > most) return;
    const int other = is_turned ? end : !end;
    if (a->links[end] != NO_LINK || b->links[other] != NO_LINK) return;
    a->links[end] = k;
    b->links[other] = i;
}

static bool link_holes(const struct finding *f)
{
    for (int has_cone = 0; has_cone < 2; has_cone++) /* those that meet come first: a step may be as short as a cone */
        for (uint32_t i = 0; i < f->count; i++) {
            if (!is_hole(&f->rounds[i])) continue;
            for (uint32_t k = i + 1; k < f->count; k++) {
                if (!zr_feature_has_steps(f->work, 1)) return false;
                if (is_hole(&f->rounds[k])) link(f, i, k, has_cone);
            }
        }
    return true;
}

/* ---- lists ---- */

static zr_dvec3 center_at(const struct zr_cylinder *cylinder, int end)
{
    return zr_dvec3_add_scaled(cylinder->frame.center, cylinder->frame.axis, end ? cylinder->high : cylinder->low);
}

/* Returns the axis that leads from one end into the cylinder. */
static zr_dvec3 axis_from(const struct zr_cylinder *cylinder, int end)
{
    const zr_dvec3 axis = cylinder->frame.axis;
    return end ? (zr_dvec3){0.0 - axis.x, 0.0 - axis.y, 0.0 - axis.z}
               : (zr_dvec3){axis.x + 0.0, axis.y + 0.0, axis.z + 0.0};
}

/* Of two directions, holes without a first end lead down the axis that they are nearest to. */
static bool leads_down(zr_dvec3 axis)
{
    const double x = fabs(axis.x), y = fabs(axis.y), z = fabs(axis.z), near = 1.0 - 1e-9;
    return (z >= near * x && z >= near * y ? axis.z : y >= near * x ? axis.y : axis.x) < 0.0;
}

static struct zr_hole measure(const struct round *round, int entry)
{
    const struct zr_cylinder *cylinder = round->cylinder;
    return (struct zr_hole){.diameter = 2.0 * cylinder->frame.radius,
                            .across_flats = 2.0 * cylinder->flat,
                            .depth = cylinder->high - cylinder->low,
                            .coverage = cylinder->coverage,
                            .at = center_at(cylinder, entry),
                            .axis = axis_from(cylinder, entry),
                            .segments = cylinder->segments};
}

/* An end of a chain of holes. */
struct outer_end {
    uint32_t round;
    int end;
};

/* Follows the links from the end of a hole to the last one. */
static struct outer_end follow(const struct finding *f, uint32_t round, int end)
{
    const uint32_t first = round;
    while (f->rounds[round].links[end] != NO_LINK) {
        const uint32_t next = (uint32_t)f->rounds[round].links[end];
        if (next == first) break;
        end = f->rounds[next].links[0] == round ? 1 : 0;
        round = next;
    }
    return (struct outer_end){round, end};
}

static enum zr_cylinder_end state_of(const struct finding *f, struct outer_end at)
{
    return f->rounds[at.round].ends.end[at.end];
}

static double radius_of(const struct finding *f, uint32_t round)
{
    return f->rounds[round].cylinder->frame.radius;
}

/* Returns the radius of an outer end, with its countersink. */
static double width_of(const struct finding *f, struct outer_end at)
{
    return zr_most_of(radius_of(f, at.round), f->rounds[at.round].cylinder->cones[at.end].radius);
}

/* Returns the end at which the chain begins: the open one, else the wider one, else the upper one. */
static struct outer_end entry_of(const struct finding *f, struct outer_end a, struct outer_end b)
{
    const bool a_closed = state_of(f, a) == ZR_END_CLOSED, b_closed = state_of(f, b) == ZR_END_CLOSED;
    const double ra = width_of(f, a), rb = width_of(f, b);
    if (a_closed != b_closed) return a_closed ? b : a;
    if (fabs(ra - rb) > SAME * ra) return ra > rb ? a : b;
    return leads_down(axis_from(f->rounds[a.round].cylinder, a.end)) ? a : b;
}

static enum zr_hole_reach reach_of(enum zr_cylinder_end a, enum zr_cylinder_end b)
{
    if (a == ZR_END_UNKNOWN || b == ZR_END_UNKNOWN) return ZR_REACH_UNKNOWN;
    return a == ZR_END_CLOSED || b == ZR_END_CLOSED ? ZR_REACH_BLIND : ZR_REACH_THROUGH;
}

static void add_step(struct zr_hole *hole, struct zr_hole_step step)
{
    if (hole->step_count < ZR_HOLE_STEPS_MAX) hole->steps[hole->step_count++] = step;
}

/* Adds the cone at an end of a cylinder if it widens. Returns its depth. */
static double add_countersink(const struct zr_cylinder *cylinder, int end, struct zr_hole *hole)
{
    const struct zr_cone_end *cone = &cylinder->cones[end];
    const double wider = cone->radius - cylinder->frame.radius;
    if (!(cone->height > 0.0 && wider > 0.0)) return 0.0;
    add_step(hole, (struct zr_hole_step){2.0 * cone->radius, cone->height, 2.0 * zr_angle_of(cone->height, wider),
                                         cylinder->segments});
    return cone->height;
}

/* Lists the chain of holes that one belongs to. False if it is closed at both ends. */
static bool list_chain(const struct finding *f, uint32_t round, struct zr_hole *out)
{
    const struct outer_end low = follow(f, round, 0), high = follow(f, round, 1), entry = entry_of(f, low, high);
    uint32_t at = entry.round, narrowest = entry.round;
    int end = entry.end, narrow_end = entry.end;
    for (bool is_last = false; !is_last;) {
        struct round *own = &f->rounds[at];
        own->is_listed = true;
        if (radius_of(f, at) < radius_of(f, narrowest)) {
            narrowest = at;
            narrow_end = end;
        }
        const int64_t next = own->links[!end];
        is_last = next == NO_LINK || f->rounds[next].is_listed;
        if (is_last) break;
        end = f->rounds[next].links[0] == at ? 0 : 1;
        at = (uint32_t)next;
    }
    *out = measure(&f->rounds[narrowest], narrow_end);
    out->at = center_at(f->rounds[entry.round].cylinder, entry.end);
    out->reach = reach_of(state_of(f, low), state_of(f, high));
    const double sunk = add_countersink(f->rounds[entry.round].cylinder, entry.end, out);
    out->at = zr_dvec3_add_scaled(out->at, axis_from(f->rounds[entry.round].cylinder, entry.end), 0.0 - sunk);
    uint32_t walked = entry.round;
    int side = entry.end;
    for (;;) {
        const struct zr_cylinder *cylinder = f->rounds[walked].cylinder;
        if (walked != narrowest)
            add_step(out, (struct zr_hole_step){2.0 * cylinder->frame.radius, cylinder->high - cylinder->low, 0.0,
                                                cylinder->segments});
        if (walked == at) break;
        const uint32_t next = (uint32_t)f->rounds[walked].links[!side];
        side = f->rounds[next].links[0] == walked ? 0 : 1;
        walked = next;
    }
    add_countersink(f->rounds[walked].cylinder, !side, out);
    return state_of(f, low) != ZR_END_CLOSED || state_of(f, high) != ZR_END_CLOSED;
}

static struct zr_hole boss_of(const struct round *round)
{
    const bool low = round->ends.end[0] == ZR_END_CLOSED, high = round->ends.end[1] == ZR_END_CLOSED;
    const int foot = low != high ? high : leads_down(axis_from(round->cylinder, 0)) ? 1 : 0;
    return measure(round, foot);
}

/* ---- groups ---- */

static bool are_same(double a, double b, double size)
{
    return fabs(a - b) <= SAME * zr_most_of(a, b) + SAME_SIZE * size;
}

static bool are_equal(const struct zr_hole *a, const struct zr_hole *b, double size)
{
    if (!are_same(a->diameter, b->diameter, size) || !are_same(a->depth, b->depth, size) || a->reach != b->reach ||
        a->step_count != b->step_count || zr_dvec3_dot(a->axis, b->axis) < SAME_DIRECTION ||
        fabs(a->coverage - b->coverage) > 1.0)
        return false;
    for (uint32_t i = 0; i < a->step_count; i++)
        if (!are_same(a->steps[i].diameter, b->steps[i].diameter, size) ||
            !are_same(a->steps[i].depth, b->steps[i].depth, size) || fabs(a->steps[i].angle - b->steps[i].angle) > 1.0)
            return false;
    return true;
}

static bool group(struct zr_feature_work *work, double size, struct zr_hole *holes, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        holes[i].group = i;
        for (uint32_t k = 0; k < i; k++) {
            if (!zr_feature_has_steps(work, 1)) return false;
            if (holes[k].group != k || !are_equal(&holes[k], &holes[i], size)) continue;
            holes[i].group = k;
            break;
        }
    }
    return true;
}

/* Finds the patterns of groups. */
static bool arrange(struct zr_arena *scratch, struct zr_feature_work *work, double size, struct zr_hole *holes,
                    uint32_t count)
{
    zr_dvec3 *places = zr_arena_alloc(scratch, ZR_PATTERN_PLACES_MAX, sizeof *places);
    double(*room)[2] = zr_arena_alloc(scratch, ZR_PATTERN_PLACES_MAX, sizeof *room);
    for (uint32_t i = 0; i < count && places && room; i++) {
        uint32_t listed = 0;
        if (holes[i].group != i) continue;
        for (uint32_t k = i; k < count && listed <= ZR_PATTERN_PLACES_MAX; k++) {
            if (!zr_feature_has_steps(work, 1)) return false;
            if (holes[k].group != i) continue;
            if (listed < ZR_PATTERN_PLACES_MAX) places[listed] = holes[k].at;
            listed++;
        }
        holes[i].pattern = zr_pattern_of(work, places, listed, holes[i].axis, size, room);
    }
    return places && room && !work->is_stopped;
}

/* ---- fillets ---- */

static bool is_fillet(const struct zr_cylinder *cylinder, const struct zr_surface *surface)
{
    return cylinder->error <= FILLET_ERROR * cylinder->frame.radius + FILLET_NOISE * surface->noise &&
           cylinder->coverage >= FILLET_LEAST && cylinder->coverage <= MORE_THAN_HALF &&
           cylinder->facets >= FILLET_FACETS_LEAST;
}

static uint32_t list_fillets(const struct zr_cylinders *cylinders, const struct zr_surface *surface, uint64_t *order,
                             struct zr_fillets *out)
{
    uint32_t count = 0, made = 0;
    for (uint32_t i = 0; i < cylinders->count; i++) {
        const float radius = (float)cylinders->at[i].frame.radius;
        uint32_t bits;
        memcpy(&bits, &radius, sizeof bits);
        if (is_fillet(&cylinders->at[i], surface)) order[count++] = (uint64_t)bits << 32 | i;
    }
    zr_sort_u64(order, count);
    for (uint32_t i = 0; i < count; i++) {
        const struct zr_cylinder *own = &cylinders->at[(uint32_t)order[i]];
        uint32_t to = made;
        for (uint32_t k = made > 2 ? made - 2 : 0; k < made; k++)
            if (out[k].is_convex != own->is_concave && own->frame.radius <= out[k].radius * (1.0 + SAME_FILLET)) to = k;
        if (to == made) out[made++] = (struct zr_fillets){.radius = own->frame.radius, .is_convex = !own->is_concave};
        out[to].count++;
    }
    return made;
}

/* ---- all steps ---- */

static bool list_all(struct zr_arena *scratch, struct finding *f, struct zr_holes *out, struct zr_hole *holes)
{
    for (uint32_t i = 0; i < f->count; i++) /* holes first */
        if (is_hole(&f->rounds[i]) && !f->rounds[i].is_listed)
            out->hole_count += list_chain(f, i, &holes[out->hole_count]);
    struct zr_hole *bosses = holes + out->hole_count;
    for (uint32_t i = 0; i < f->count; i++)
        if (!f->rounds[i].cylinder->is_concave) bosses[out->boss_count++] = boss_of(&f->rounds[i]);
    out->holes = holes;
    out->bosses = bosses;
    const double size = f->facets->surface->size;
    return group(f->work, size, holes, out->hole_count) && group(f->work, size, bosses, out->boss_count) &&
           arrange(scratch, f->work, size, holes, out->hole_count) &&
           arrange(scratch, f->work, size, bosses, out->boss_count);
}

bool zr_holes_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                   const struct zr_seeds *seeds, struct zr_holes *out)
{
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    struct zr_cylinders cylinders;
    struct finding f = {.work = work, .facets = facets};
    *out = (struct zr_holes){.hole_count = 0};
    bool ok = zr_cylinders_find(&scratch, work, facets, seeds, &cylinders);
    uint32_t fillets = 0;
    for (uint32_t i = 0; ok && i < cylinders.count; i++) {
        f.count += is_round(&cylinders.at[i]);
        fillets += is_fillet(&cylinders.at[i], facets->surface);
    }
    f.rounds = zr_arena_alloc(&scratch, f.count, sizeof *f.rounds);
    uint64_t *order = zr_arena_alloc(&scratch, fillets, sizeof *order);
    struct zr_fillets *made = zr_arena_alloc_beside(arena, &scratch, fillets, sizeof *made);
    struct zr_hole *holes = zr_arena_alloc_beside(arena, &scratch, f.count, sizeof *holes);
    ok = ok && f.rounds && order && made && holes;
    for (uint32_t i = 0, k = 0; ok && i < cylinders.count; i++)
        if (is_round(&cylinders.at[i]))
            f.rounds[k++] = (struct round){.cylinder = &cylinders.at[i], .links = {NO_LINK, NO_LINK}};
    if (ok) {
        out->fillets = made;
        out->fillet_count = list_fillets(&cylinders, facets->surface, order, made);
        ok = look_at_ends(&scratch, &f) && link_holes(&f) && list_all(&scratch, &f, out, holes);
    }
    zr_arena_close_scratch(&scratch, arena);
    return ok && zr_arena_ok(arena);
}
