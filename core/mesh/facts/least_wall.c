#include "mesh/facts/least_wall.h"

#include "mesh/facts/wall_lines.h"

enum {
    STEPS_PER_PAIR = 8,
    PROBE_FIRST = 64, /* every 64th leaf is searched first, for an early bound */
    SMALL = 1 << 16,  /* bytes; smaller solids get blocks of SMALL_UNIT, so that the system clears fewer pages */
    SMALL_UNIT = 1 << 12
};

/* ---- projections ---- */

static struct zr_wall_frame frame_along(struct zr_world_place d)
{
    const double length = sqrt(zr_world_place_dot(d, d));
    struct zr_wall_frame f = {.d = {d.x / length, d.y / length, d.z / length}};
    const double ax = fabs(f.d.x), ay = fabs(f.d.y), az = fabs(f.d.z);
    const struct zr_world_place axis = {ax <= ay && ax <= az, ay < ax && ay <= az, az < ax && az < ay};
    const struct zr_world_place u = zr_world_place_cross(axis, f.d);
    const double side = sqrt(zr_world_place_dot(u, u));
    f.u = (struct zr_world_place){u.x / side, u.y / side, u.z / side};
    f.v = zr_world_place_cross(f.d, f.u);
    return f;
}

/* Clips a convex polygon to the left side of the line from a to b, and returns the number of its corners.
 * Source: Sutherland and Hodgman, 1974. */
static int clip(const struct zr_wall_point *in, int count, struct zr_wall_point a, struct zr_wall_point b,
                struct zr_wall_point *out)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const struct zr_wall_point p = in[i], q = in[(i + 1) % count];
        const double tp = zr_wall_turn(a, b, p), tq = zr_wall_turn(a, b, q);
        if (tp >= 0.0) out[kept++] = p;
        if ((tp < 0.0) == (tq < 0.0)) continue;
        const double t = tp / (tp - tq);
        out[kept++] = (struct zr_wall_point){p.u + t * (q.u - p.u), p.v + t * (q.v - p.v)};
    }
    return kept;
}

/* Returns true if the polygon is wider than `least`. */
static bool is_wider(const struct zr_wall_point *p, int count, double least)
{
    double area = 0.0, around = 0.0;
    for (int i = 0; i < count; i++) {
        const struct zr_wall_point q = p[(i + 1) % count];
        if (i > 0) area += zr_wall_turn(p[0], p[i], q);
        const double u = q.u - p[i].u, v = q.v - p[i].v;
        around += sqrt(u * u + v * v);
    }
    return area > least * around; /* both are twice those of a thin one */
}

/* ---- pairs ---- */

/* Planes have normals of unit length to 1e-7. Gains below the rounding of float positions are not sought: there would
 * be one in every other pair of a finely meshed plate. */
static bool is_better(const struct zr_wall_search *s, double distance)
{
    return distance < s->best - (1e-6 * s->best + 0.1 * s->solid->step) || s->best == HUGE_VAL;
}

/* Finds the overlap and the distance. False if there is none, or the distance is not below the best one. */
static bool make_pair(const struct zr_wall_search *s, uint32_t near, uint32_t far, const struct zr_world_place a[3],
                      const struct zr_world_place b[3], struct zr_wall_pair *pair)
{
    const float *n = s->solid->normals[near], *m = s->solid->normals[far];
    const double step = s->solid->step;
    struct zr_wall_point other[ZR_WALL_CORNERS];
    double nearest = HUGE_VAL, farthest = -HUGE_VAL;
    pair->frame = frame_along(
        (struct zr_world_place){(double)m[0] - (double)n[0], (double)m[1] - (double)n[1], (double)m[2] - (double)n[2]});
    zr_wall_project(&pair->frame, a, &pair->near);
    zr_wall_project(&pair->frame, b, &pair->far);
    if (!zr_wall_find_plane(&pair->near) || !zr_wall_find_plane(&pair->far)) return false;
    const struct zr_wall_point *p = pair->near.corners, *q = pair->far.corners;
    const struct zr_wall_point left[3] = {p[0], p[2], p[1]}; /* the near one is seen from inside */
    pair->count = clip(left, 3, q[0], q[1], other);
    pair->count = clip(other, pair->count, q[1], q[2], pair->overlap);
    pair->count = clip(pair->overlap, pair->count, q[2], q[0], other);
    if (pair->count < 3 || !is_wider(other, pair->count, step)) return false;
    for (int i = 0; i < pair->count; i++) {
        const double distance = zr_wall_height_at(&pair->far, other[i]) - zr_wall_height_at(&pair->near, other[i]);
        pair->overlap[i] = other[i];
        nearest = zr_least_of(nearest, distance);
        farthest = zr_most_of(farthest, distance);
    }
    pair->thickness = zr_most_of(nearest, 0.0);
    return farthest > step && is_better(s, pair->thickness);
}

/* Returns the distance that triangles in `far` have at least from opposite ones in `near`; HUGE_VAL: not below the best
 * one. */
static double distance_of(const struct zr_wall_search *s, const struct zr_wall_box *near, const struct zr_wall_box *far)
{
    const double reach = s->best < s->solid->size ? s->best : s->solid->size;
    const double slack = reach * (double)ZR_WALL_TILT + s->solid->step;
    double least = 0.0, most = 0.0, gaps = 0.0;
    for (int k = 0; k < 3; k++) {
        if (far->low[k] > ZR_WALL_TILT - near->low[k] || far->high[k] < -near->high[k] - ZR_WALL_TILT) return HUGE_VAL;
        const double from = (double)-near->high[k], to = (double)-near->low[k]; /* inwards */
        const double low = far->min[k] - near->max[k], high = far->max[k] - near->min[k];
        if (low > zr_most_of(to, 0.0) * reach + slack || high < zr_least_of(from, 0.0) * reach - slack) return HUGE_VAL;
        least += zr_least_of(zr_least_of(from * low, from * high), zr_least_of(to * low, to * high));
        most += zr_most_of(zr_most_of(from * low, from * high), zr_most_of(to * low, to * high));
        const double gap = zr_most_of(0.0, zr_most_of(low, -high));
        gaps += gap * gap;
    }
    if (most <= 0.0) return HUGE_VAL;
    least = zr_most_of(least, sqrt(gaps));
    return is_better(s, least) ? least : HUGE_VAL;
}

/* Returns the least distance of a triangle's corners from the plane of an opposite one. */
static double distance_of_plane(const struct zr_world_place a[3], const struct zr_world_place b[3], const float m[3])
{
    const struct zr_world_place normal = {(double)m[0], (double)m[1], (double)m[2]};
    const double plane = zr_world_place_dot(normal, b[0]);
    return plane - zr_most_of(zr_world_place_dot(normal, a[0]),
                              zr_most_of(zr_world_place_dot(normal, a[1]), zr_world_place_dot(normal, a[2])));
}

static void search_leaves(struct zr_wall_search *s, uint32_t near, uint32_t far)
{
    const struct zr_wall_solid *solid = s->solid;
    const uint32_t *order = solid->along.order, near_begin = near * ZR_WALL_LEAF, far_begin = far * ZR_WALL_LEAF;
    struct zr_world_place a[3], b[ZR_WALL_LEAF][3];
    bool has_place[ZR_WALL_LEAF] = {false};
    struct zr_wall_pair pair;
    for (uint32_t i = near_begin; i < solid->count && i < near_begin + ZR_WALL_LEAF; i++) {
        const float *n = solid->normals[order[i]];
        bool has_own = false;
        for (uint32_t k = 0; k < ZR_WALL_LEAF && far_begin + k < solid->count; k++) {
            const uint32_t other = order[far_begin + k];
            const float *m = solid->normals[other];
            const float x = n[0] + m[0], y = n[1] + m[1], z = n[2] + m[2];
            if (x * x + y * y + z * z > ZR_WALL_TILT * ZR_WALL_TILT) continue;
            if (!zr_wall_has_steps(s, 1)) return;
            if (!has_own) zr_wall_solid_places(solid, order[i], a);
            if (!has_place[k]) zr_wall_solid_places(solid, other, b[k]);
            has_own = has_place[k] = true;
            if (!is_better(s, distance_of_plane(a, b[k], m))) continue;
            if (!zr_wall_has_steps(s, STEPS_PER_PAIR)) return;
            if (!make_pair(s, order[i], other, a, b[k], &pair) || !zr_wall_probe(s, &pair)) continue;
            s->best = pair.thickness;
            s->best_at = s->at;
        }
    }
}

/* Searches the triangles opposite to those of a leaf, nearer boxes first. */
static void search_from(struct zr_wall_search *s, uint32_t leaf)
{
    const struct zr_wall_solid *solid = s->solid;
    const struct zr_wall_box *boxes = solid->along.boxes, *near = &boxes[solid->leaf_count + leaf];
    struct {
        uint32_t node;
        double distance;
    } stack[ZR_WALL_DEPTH] = {{1, distance_of(s, near, &boxes[1])}};
    for (int depth = 1; depth > 0;) {
        const uint32_t node = stack[--depth].node;
        if (!zr_wall_has_steps(s, 1)) return;
        if (!(stack[depth].distance < s->best)) continue;
        if (node >= solid->leaf_count) {
            if (zr_wall_has_steps(s, 2 * ZR_WALL_LEAF)) search_leaves(s, leaf, node - solid->leaf_count);
            continue;
        }
        const double left = distance_of(s, near, &boxes[2 * node]), right = distance_of(s, near, &boxes[2 * node + 1]);
        const uint32_t first = left <= right ? 2 * node : 2 * node + 1;
        if (zr_most_of(left, right) < HUGE_VAL) {
            stack[depth].node = first ^ 1u;
            stack[depth++].distance = zr_most_of(left, right);
        }
        if (zr_least_of(left, right) < HUGE_VAL) {
            stack[depth].node = first;
            stack[depth++].distance = zr_least_of(left, right);
        }
    }
}

/* Of two opposite triangles one has a normal on this side of a plane, to half the tilt. False if none in the box has.
 */
static bool is_searched(const struct zr_wall_box *box)
{
    return 0.48f * box->high[0] + 0.6f * box->high[1] + 0.64f * box->high[2] >= -ZR_WALL_TILT;
}

/* Searches all pairs of boxes, larger ones first. */
static void search_pairs(struct zr_wall_search *s)
{
    const struct zr_wall_solid *solid = s->solid;
    const struct zr_wall_box *boxes = solid->along.boxes;
    const uint32_t leaf_count = solid->leaf_count;
    struct {
        uint32_t near, far;
    } stack[2 * ZR_WALL_DEPTH] = {{1, 1}};
    for (int depth = 1; depth > 0;) {
        const uint32_t near = stack[--depth].near, far = stack[depth].far;
        if (!zr_wall_has_steps(s, 1)) return;
        if (!is_searched(&boxes[near]) || distance_of(s, &boxes[near], &boxes[far]) == HUGE_VAL) continue;
        if (near >= leaf_count && far >= leaf_count) {
            if (zr_wall_has_steps(s, 2 * ZR_WALL_LEAF)) search_leaves(s, near - leaf_count, far - leaf_count);
            continue;
        }
        const bool splits_near = near < leaf_count && near <= far;
        for (uint32_t i = 0; i < 2; i++, depth++) {
            stack[depth].near = splits_near ? 2 * near + i : near;
            stack[depth].far = splits_near ? far : 2 * far + i;
        }
    }
}

static void search_all(struct zr_wall_search *s)
{
    for (uint32_t i = 0; i < s->solid->leaf_count && !s->is_stopped; i += PROBE_FIRST)
        search_from(s, i);
    if (!s->is_stopped) search_pairs(s);
}

/* Coordinates within a step of 0 are 0. */
static double rounded(double value, double step)
{
    return fabs(value) <= step ? 0.0 : value;
}

struct zr_least_wall zr_least_wall_find(struct zr_arena *arena, const struct zr_cancel *cancel,
                                        const struct zr_wall_faces *faces, uint64_t *steps)
{
    struct zr_wall_solid solid = {.count = 0};
    struct zr_least_wall wall = {.is_omitted = true};
    const size_t bytes = zr_wall_solid_bytes(faces);
    if (zr_arena_block_bytes(bytes) > zr_arena_left(arena)) return wall;
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    if (bytes < SMALL) scratch.unit = SMALL_UNIT;
    if (zr_wall_solid_make(&scratch, cancel, faces, &solid)) {
        struct zr_wall_search s = {.solid = &solid, .cancel = cancel, .steps_most = *steps, .best = HUGE_VAL};
        search_all(&s);
        *steps -= s.steps < *steps ? s.steps : *steps;
        wall.is_omitted = s.is_stopped;
        wall.is_found = !s.is_stopped && s.best < HUGE_VAL;
        wall.thickness = wall.is_found ? s.best : 0.0;
        wall.at[0] = rounded(s.best_at.x + solid.origin.x, solid.step);
        wall.at[1] = rounded(s.best_at.y + solid.origin.y, solid.step);
        wall.at[2] = rounded(s.best_at.z + solid.origin.z, solid.step);
    }
    zr_arena_close_scratch(&scratch, arena);
    return wall;
}
