#include "mesh/least_wall.h"

enum {
    STACK = 64,      /* more than the depth of a tree */
    POLYGON_MAX = 9, /* corners while a triangle is clipped by three lines */
    STEPS_PER_CANCEL_CHECK = 1 << 12,
    STEPS_PER_PAIR = 8,
    PROBE_FIRST = 64, /* every 64th leaf is searched first, for an early bound */
    BESIDE_MAX = 96,  /* triangles beside an overlap that are held for all its lines */
    BESIDE_PER_STEP = 4,
    MOVES_PER_STEP = 64, /* of crossings that are sorted by insertion; twice as many */
    SMALL = 1 << 16,     /* bytes; smaller solids get blocks of SMALL_UNIT, so that the system clears fewer pages */
    SMALL_UNIT = 1 << 12
};

struct point {
    double u, v;
};

/* A frame whose third axis `d` runs through the material. */
struct frame {
    struct zr_world_place u, v, d;
};

/* A projected triangle, and its plane: height = at + du u + dv v. */
struct facet {
    struct point corners[3];
    double heights[3];
    double at, du, dv;
};

/* Triangles that lines through an overlap may cross. */
struct beside {
    struct point low, high; /* of the overlap */
    double end;             /* highest of these lines */
    int count;
    bool is_full; /* there are more */
    struct facet facets[BESIDE_MAX];
};

struct search {
    const struct zr_wall_solid *solid;
    const struct zr_cancel *cancel;
    uint64_t steps, steps_most, next_look;
    bool is_stopped; /* cancelled, or too many steps */
    double best;
};

/* Both sides of a possible wall, projected: their overlap. */
struct pair {
    struct frame frame;
    struct facet near, far;
    struct point overlap[POLYGON_MAX];
    int count;
    double thickness;
};

static bool has_steps(struct search *s, uint32_t steps)
{
    s->steps += steps;
    if (s->steps > s->steps_most) s->is_stopped = true;
    if (s->steps >= s->next_look) {
        s->next_look = s->steps + STEPS_PER_CANCEL_CHECK;
        if (zr_is_cancelled(s->cancel)) s->is_stopped = true;
    }
    return !s->is_stopped;
}

/* ---- projections ---- */

static struct frame frame_along(struct zr_world_place d)
{
    const double length = sqrt(zr_world_place_dot(d, d));
    struct frame f = {.d = {d.x / length, d.y / length, d.z / length}};
    const double ax = fabs(f.d.x), ay = fabs(f.d.y), az = fabs(f.d.z);
    const struct zr_world_place axis = {ax <= ay && ax <= az, ay < ax && ay <= az, az < ax && az < ay};
    const struct zr_world_place u = zr_world_place_cross(axis, f.d);
    const double side = sqrt(zr_world_place_dot(u, u));
    f.u = (struct zr_world_place){u.x / side, u.y / side, u.z / side};
    f.v = zr_world_place_cross(f.d, f.u);
    return f;
}

static void project(const struct frame *frame, const struct zr_world_place p[3], struct facet *out)
{
    for (int k = 0; k < 3; k++) {
        out->corners[k] = (struct point){zr_world_place_dot(frame->u, p[k]), zr_world_place_dot(frame->v, p[k])};
        out->heights[k] = zr_world_place_dot(frame->d, p[k]);
    }
}

/* Positive for a left turn. */
static double turn(struct point a, struct point b, struct point c)
{
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/* Finds the plane of a facet. False if it is seen edge-on. */
static bool find_plane(struct facet *f)
{
    const struct point *c = f->corners;
    const double area = turn(c[0], c[1], c[2]), h1 = f->heights[1] - f->heights[0], h2 = f->heights[2] - f->heights[0];
    if (area == 0.0) return false;
    f->du = (h1 * (c[2].v - c[0].v) - h2 * (c[1].v - c[0].v)) / area;
    f->dv = (h2 * (c[1].u - c[0].u) - h1 * (c[2].u - c[0].u)) / area;
    f->at = f->heights[0] - (f->du * c[0].u + f->dv * c[0].v);
    return true;
}

/* Returns the height of the plane, within that of the triangle. */
static double height_at(const struct facet *f, struct point p)
{
    const double h = f->at + (f->du * p.u + f->dv * p.v);
    const double low = zr_least_of(f->heights[0], zr_least_of(f->heights[1], f->heights[2])),
                 high = zr_most_of(f->heights[0], zr_most_of(f->heights[1], f->heights[2]));
    return h < low ? low : h > high ? high : h;
}

/* Clips a convex polygon to the left side of the line from a to b, and returns the number of its corners.
 * Source: Sutherland and Hodgman, 1974. */
static int clip(const struct point *in, int count, struct point a, struct point b, struct point *out)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const struct point p = in[i], q = in[(i + 1) % count];
        const double tp = turn(a, b, p), tq = turn(a, b, q);
        if (tp >= 0.0) out[kept++] = p;
        if ((tp < 0.0) == (tq < 0.0)) continue;
        const double t = tp / (tp - tq);
        out[kept++] = (struct point){p.u + t * (q.u - p.u), p.v + t * (q.v - p.v)};
    }
    return kept;
}

/* Returns true if the polygon is wider than `least`. */
static bool is_wider(const struct point *p, int count, double least)
{
    double area = 0.0, around = 0.0;
    for (int i = 0; i < count; i++) {
        const struct point q = p[(i + 1) % count];
        if (i > 0) area += turn(p[0], p[i], q);
        const double u = q.u - p[i].u, v = q.v - p[i].v;
        around += sqrt(u * u + v * v);
    }
    return area > least * around; /* both are twice those of a thin one */
}

/* ---- lines ---- */

struct crossing {
    double height;
    int turns; /* change of the winding number */
};

struct line {
    struct point at;
    const struct frame *frame;
    double begin, end;            /* heights of the wall */
    int before, at_begin, at_end; /* sums of turns: before the wall, and within a step of its ends */
    int count;
    struct crossing crossings[ZR_WALL_CROSSINGS]; /* within the wall, ascending */
};

/* Returns how often the triangle's border winds around the point. Both triangles of an edge decide alike about it. */
static int winding_of(const struct point c[3], struct point p)
{
    int winding = 0;
    for (int k = 0; k < 3; k++) {
        const struct point a = c[k], b = c[(k + 1) % 3];
        if ((a.v <= p.v) == (b.v <= p.v)) continue;
        const bool rises = a.v <= p.v;
        const double side = rises ? turn(a, b, p) : turn(b, a, p);
        if (side > 0.0) winding += rises ? 1 : -1;
    }
    return winding;
}

/* Adds the crossing with a triangle that winds around the line. False if there are too many. */
static bool put_crossing(const struct search *s, struct line *line, const struct facet *f, int winding)
{
    const struct crossing own = {height_at(f, line->at), -winding};
    const double step = s->solid->step;
    int *sum = own.height < line->begin - step    ? &line->before
               : own.height <= line->begin + step ? &line->at_begin
               : own.height < line->end - step    ? NULL
                                                  : &line->at_end;
    if (own.height > line->end + step) return true;
    if (sum) {
        *sum += own.turns;
        return true;
    }
    if (line->count == ZR_WALL_CROSSINGS) return false;
    int at = line->count++;
    for (; at > 0 && line->crossings[at - 1].height > own.height; at--)
        line->crossings[at] = line->crossings[at - 1];
    line->crossings[at] = own;
    return true;
}

static void project_triangle(const struct search *s, const struct frame *frame, uint32_t triangle, struct facet *out)
{
    struct zr_world_place p[3];
    zr_wall_solid_places(s->solid, triangle, p);
    project(frame, p, out);
}

static bool add_crossing(const struct search *s, struct line *line, uint32_t triangle)
{
    struct facet f;
    project_triangle(s, line->frame, triangle, &f);
    const int winding = winding_of(f.corners, line->at);
    return winding == 0 || !find_plane(&f) || put_crossing(s, line, &f, winding);
}

static bool is_on_line(const struct search *s, const struct line *line, const struct zr_wall_box *box)
{
    const struct frame *f = line->frame;
    const double step = s->solid->step;
    const double from[3] = {f->u.x * line->at.u + f->v.x * line->at.v, f->u.y * line->at.u + f->v.y * line->at.v,
                            f->u.z * line->at.u + f->v.z * line->at.v},
                 along[3] = {f->d.x, f->d.y, f->d.z};
    double begin = -HUGE_VAL, end = line->end + 2.0 * step;
    for (int k = 0; k < 3; k++) {
        const double low = box->min[k] - step, high = box->max[k] + step;
        if (fabs(along[k]) < 1e-12) {
            if (from[k] < low || from[k] > high) return false;
            continue;
        }
        const double a = (low - from[k]) / along[k], b = (high - from[k]) / along[k];
        begin = zr_most_of(begin, zr_least_of(a, b));
        end = zr_least_of(end, zr_most_of(a, b));
    }
    return begin <= end;
}

/* Crosses all triangles that the line meets. */
static bool cross_all(struct search *s, struct line *line)
{
    const struct zr_wall_solid *solid = s->solid;
    const struct zr_wall_tree *tree = &solid->around;
    uint32_t stack[STACK] = {1};
    for (int depth = 1; depth > 0;) {
        const uint32_t node = stack[--depth];
        if (!has_steps(s, 1)) return false;
        if (!is_on_line(s, line, &tree->boxes[node])) continue;
        if (node < solid->leaf_count) {
            stack[depth++] = 2 * node;
            stack[depth++] = 2 * node + 1;
            continue;
        }
        const uint32_t begin = (node - solid->leaf_count) * ZR_WALL_LEAF, left = solid->count - begin;
        if (!has_steps(s, 2 * ZR_WALL_LEAF)) return false;
        for (uint32_t i = 0; i < ZR_WALL_LEAF && i < left; i++)
            if (!add_crossing(s, line, tree->order[begin + i])) {
                s->is_stopped = true;
                return false;
            }
    }
    return true;
}

static bool cross_beside(struct search *s, const struct beside *beside, struct line *line)
{
    if (!has_steps(s, 1 + (uint32_t)beside->count / BESIDE_PER_STEP)) return false;
    for (int i = 0; i < beside->count; i++) {
        const int winding = winding_of(beside->facets[i].corners, line->at);
        if (winding == 0 || put_crossing(s, line, &beside->facets[i], winding)) continue;
        s->is_stopped = true;
        return false;
    }
    return true;
}

/* Returns true if all is inside from the wall's begin to its end on this line, and outside before and behind. */
static bool is_wall_at(struct search *s, const struct pair *pair, struct point at, const struct beside *beside)
{
    struct line line; /* not cleared: most of it is never used */
    const double step = s->solid->step;
    line.at = at;
    line.frame = &pair->frame;
    line.begin = height_at(&pair->near, at);
    line.end = height_at(&pair->far, at);
    line.before = line.at_begin = line.at_end = line.count = 0;
    if (line.end - line.begin <= step) return false;
    if (!(beside ? cross_beside(s, beside, &line) : cross_all(s, &line))) return false;
    if (!has_steps(s, (uint32_t)(line.count * line.count) / MOVES_PER_STEP) || line.before != 0) return false;
    int winding = line.at_begin;
    if (winding <= 0) return false;
    for (int i = 0; i < line.count; i++) {
        winding += line.crossings[i].turns;
        const double next = i + 1 < line.count ? line.crossings[i + 1].height : line.end;
        if (winding <= 0 && next - line.crossings[i].height > step) return false;
    }
    return winding + line.at_end <= 0;
}

/* ---- triangles beside an overlap ---- */

static double half_of(const struct zr_wall_box *box, struct zr_world_place axis)
{
    return 0.5 * ((fabs(axis.x) * (box->max[0] - box->min[0]) + fabs(axis.y) * (box->max[1] - box->min[1])) +
                  fabs(axis.z) * (box->max[2] - box->min[2]));
}

static bool is_box_beside(const struct beside *beside, const struct frame *frame, const struct zr_wall_box *box,
                          double step)
{
    const struct zr_world_place middle = {0.5 * (box->min[0] + box->max[0]), 0.5 * (box->min[1] + box->max[1]),
                                          0.5 * (box->min[2] + box->max[2])};
    const double u = zr_world_place_dot(frame->u, middle), v = zr_world_place_dot(frame->v, middle);
    const double half_u = half_of(box, frame->u) + step, half_v = half_of(box, frame->v) + step;
    return u + half_u >= beside->low.u && u - half_u <= beside->high.u && v + half_v >= beside->low.v &&
           v - half_v <= beside->high.v &&
           zr_world_place_dot(frame->d, middle) - half_of(box, frame->d) <= beside->end + 2.0 * step;
}

static bool is_facet_beside(const struct beside *beside, const struct facet *f, double step)
{
    const struct point *c = f->corners;
    return zr_most_of(c[0].u, zr_most_of(c[1].u, c[2].u)) >= beside->low.u - step &&
           zr_least_of(c[0].u, zr_least_of(c[1].u, c[2].u)) <= beside->high.u + step &&
           zr_most_of(c[0].v, zr_most_of(c[1].v, c[2].v)) >= beside->low.v - step &&
           zr_least_of(c[0].v, zr_least_of(c[1].v, c[2].v)) <= beside->high.v + step;
}

static void hold_leaf(const struct search *s, const struct frame *frame, uint32_t leaf, struct beside *beside)
{
    const uint32_t begin = leaf * ZR_WALL_LEAF, left = s->solid->count - begin;
    for (uint32_t i = 0; i < ZR_WALL_LEAF && i < left; i++) {
        struct facet f;
        project_triangle(s, frame, s->solid->around.order[begin + i], &f);
        if (!is_facet_beside(beside, &f, s->solid->step) || !find_plane(&f)) continue;
        if (beside->count == BESIDE_MAX) {
            beside->is_full = true;
            return;
        }
        beside->facets[beside->count++] = f;
    }
}

/* Holds the triangles that lines through the overlap may cross. False: there are too many, or no steps left. */
static bool hold_beside(struct search *s, const struct pair *pair, struct beside *beside)
{
    const struct zr_wall_solid *solid = s->solid;
    beside->low = beside->high = pair->overlap[0];
    beside->end = -HUGE_VAL;
    beside->count = 0;
    beside->is_full = false;
    for (int i = 0; i < pair->count; i++) {
        const struct point p = pair->overlap[i];
        beside->low = (struct point){zr_least_of(beside->low.u, p.u), zr_least_of(beside->low.v, p.v)};
        beside->high = (struct point){zr_most_of(beside->high.u, p.u), zr_most_of(beside->high.v, p.v)};
        beside->end = zr_most_of(beside->end, height_at(&pair->far, p));
    }
    uint32_t stack[STACK] = {1};
    for (int depth = 1; depth > 0 && !beside->is_full;) {
        const uint32_t node = stack[--depth];
        if (!has_steps(s, 1)) return false;
        if (!is_box_beside(beside, &pair->frame, &solid->around.boxes[node], solid->step)) continue;
        if (node < solid->leaf_count) {
            stack[depth++] = 2 * node;
            stack[depth++] = 2 * node + 1;
        } else {
            if (!has_steps(s, 2 * ZR_WALL_LEAF)) return false;
            hold_leaf(s, &pair->frame, node - solid->leaf_count, beside);
        }
    }
    return !beside->is_full;
}

/* Probes the middle of the overlap, and places near its corners and sides. */
static bool is_wall(struct search *s, const struct pair *pair)
{
    struct point middle = {0, 0};
    struct beside beside;
    for (int i = 0; i < pair->count; i++) {
        middle.u += pair->overlap[i].u / pair->count;
        middle.v += pair->overlap[i].v / pair->count;
    }
    if (is_wall_at(s, pair, middle, NULL)) return true;
    const struct beside *held = hold_beside(s, pair, &beside) ? &beside : NULL;
    for (int i = 0; i < 3 * pair->count; i++) {
        static const double shares[3] = {0.75, 0.5, 0.96875}; /* half way to a side, to a corner, and next to it */
        const struct point a = pair->overlap[i / 3], b = pair->overlap[(i / 3 + 1) % pair->count],
                           to = i % 3 == 0 ? (struct point){0.5 * (a.u + b.u), 0.5 * (a.v + b.v)} : a;
        const double share = shares[i % 3];
        if (s->is_stopped) return false;
        if (is_wall_at(s, pair,
                       (struct point){middle.u + share * (to.u - middle.u), middle.v + share * (to.v - middle.v)},
                       held))
            return true;
    }
    return false;
}

/* ---- pairs ---- */

/* Planes have normals of unit length to 1e-7. Gains below the rounding of float positions are not sought: there would
 * be one in every other pair of a finely meshed plate. */
static bool is_better(const struct search *s, double distance)
{
    return distance < s->best - (1e-6 * s->best + 0.1 * s->solid->step) || s->best == HUGE_VAL;
}

/* Finds the overlap and the distance. False if there is none, or the distance is not below the best one. */
static bool make_pair(const struct search *s, uint32_t near, uint32_t far, const struct zr_world_place a[3],
                      const struct zr_world_place b[3], struct pair *pair)
{
    const float *n = s->solid->normals[near], *m = s->solid->normals[far];
    const double step = s->solid->step;
    struct point other[POLYGON_MAX];
    double nearest = HUGE_VAL, farthest = -HUGE_VAL;
    pair->frame = frame_along(
        (struct zr_world_place){(double)m[0] - (double)n[0], (double)m[1] - (double)n[1], (double)m[2] - (double)n[2]});
    project(&pair->frame, a, &pair->near);
    project(&pair->frame, b, &pair->far);
    if (!find_plane(&pair->near) || !find_plane(&pair->far)) return false;
    const struct point *p = pair->near.corners, *q = pair->far.corners;
    const struct point left[3] = {p[0], p[2], p[1]}; /* the near one is seen from inside */
    pair->count = clip(left, 3, q[0], q[1], other);
    pair->count = clip(other, pair->count, q[1], q[2], pair->overlap);
    pair->count = clip(pair->overlap, pair->count, q[2], q[0], other);
    if (pair->count < 3 || !is_wider(other, pair->count, step)) return false;
    for (int i = 0; i < pair->count; i++) {
        const double distance = height_at(&pair->far, other[i]) - height_at(&pair->near, other[i]);
        pair->overlap[i] = other[i];
        nearest = zr_least_of(nearest, distance);
        farthest = zr_most_of(farthest, distance);
    }
    pair->thickness = zr_most_of(nearest, 0.0);
    return farthest > step && is_better(s, pair->thickness);
}

/* Returns the distance that triangles in `far` have at least from opposite ones in `near`; HUGE_VAL: not below the best
 * one. */
static double distance_of(const struct search *s, const struct zr_wall_box *near, const struct zr_wall_box *far)
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

static void search_leaves(struct search *s, uint32_t near, uint32_t far)
{
    const struct zr_wall_solid *solid = s->solid;
    const uint32_t *order = solid->along.order, near_begin = near * ZR_WALL_LEAF, far_begin = far * ZR_WALL_LEAF;
    struct zr_world_place a[3], b[ZR_WALL_LEAF][3];
    bool has_place[ZR_WALL_LEAF] = {false};
    struct pair pair;
    for (uint32_t i = near_begin; i < solid->count && i < near_begin + ZR_WALL_LEAF; i++) {
        const float *n = solid->normals[order[i]];
        bool has_own = false;
        for (uint32_t k = 0; k < ZR_WALL_LEAF && far_begin + k < solid->count; k++) {
            const uint32_t other = order[far_begin + k];
            const float *m = solid->normals[other];
            const float x = n[0] + m[0], y = n[1] + m[1], z = n[2] + m[2];
            if (x * x + y * y + z * z > ZR_WALL_TILT * ZR_WALL_TILT) continue;
            if (!has_steps(s, 1)) return;
            if (!has_own) zr_wall_solid_places(solid, order[i], a);
            if (!has_place[k]) zr_wall_solid_places(solid, other, b[k]);
            has_own = has_place[k] = true;
            if (!is_better(s, distance_of_plane(a, b[k], m))) continue;
            if (!has_steps(s, STEPS_PER_PAIR)) return;
            if (make_pair(s, order[i], other, a, b[k], &pair) && is_wall(s, &pair)) s->best = pair.thickness;
        }
    }
}

/* Searches the triangles opposite to those of a leaf, nearer boxes first. */
static void search_from(struct search *s, uint32_t leaf)
{
    const struct zr_wall_solid *solid = s->solid;
    const struct zr_wall_box *boxes = solid->along.boxes, *near = &boxes[solid->leaf_count + leaf];
    struct {
        uint32_t node;
        double distance;
    } stack[STACK] = {{1, distance_of(s, near, &boxes[1])}};
    for (int depth = 1; depth > 0;) {
        const uint32_t node = stack[--depth].node;
        if (!has_steps(s, 1)) return;
        if (!(stack[depth].distance < s->best)) continue;
        if (node >= solid->leaf_count) {
            if (has_steps(s, 2 * ZR_WALL_LEAF)) search_leaves(s, leaf, node - solid->leaf_count);
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
static void search_pairs(struct search *s)
{
    const struct zr_wall_solid *solid = s->solid;
    const struct zr_wall_box *boxes = solid->along.boxes;
    const uint32_t leaf_count = solid->leaf_count;
    struct {
        uint32_t near, far;
    } stack[2 * STACK] = {{1, 1}};
    for (int depth = 1; depth > 0;) {
        const uint32_t near = stack[--depth].near, far = stack[depth].far;
        if (!has_steps(s, 1)) return;
        if (!is_searched(&boxes[near]) || distance_of(s, &boxes[near], &boxes[far]) == HUGE_VAL) continue;
        if (near >= leaf_count && far >= leaf_count) {
            if (has_steps(s, 2 * ZR_WALL_LEAF)) search_leaves(s, near - leaf_count, far - leaf_count);
            continue;
        }
        const bool splits_near = near < leaf_count && near <= far;
        for (uint32_t i = 0; i < 2; i++, depth++) {
            stack[depth].near = splits_near ? 2 * near + i : near;
            stack[depth].far = splits_near ? far : 2 * far + i;
        }
    }
}

static void search_all(struct search *s)
{
    for (uint32_t i = 0; i < s->solid->leaf_count && !s->is_stopped; i += PROBE_FIRST)
        search_from(s, i);
    if (!s->is_stopped) search_pairs(s);
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
        struct search s = {.solid = &solid, .cancel = cancel, .steps_most = *steps, .best = HUGE_VAL};
        search_all(&s);
        *steps -= s.steps < *steps ? s.steps : *steps;
        wall.is_omitted = s.is_stopped;
        wall.is_found = !s.is_stopped && s.best < HUGE_VAL;
        wall.thickness = wall.is_found ? s.best : 0.0;
    }
    zr_arena_close_scratch(&scratch, arena);
    return wall;
}
