#include "mesh/facts/wall_lines.h"

enum {
    BESIDE_MAX = 96, /* triangles beside an overlap that are held for all its lines */
    BESIDE_PER_STEP = 4,
    MOVES_PER_STEP = 64 /* of crossings that are sorted by insertion; twice as many */
};

/* Triangles that lines through an overlap may cross. */
struct beside {
    struct zr_wall_point low, high; /* of the overlap */
    double end;                     /* highest of these lines */
    int count;
    bool is_full; /* there are more */
    struct zr_wall_facet facets[BESIDE_MAX];
};

/* ---- lines ---- */

struct crossing {
    double height;
    int turns; /* change of the winding number */
};

struct line {
    struct zr_wall_point at;
    const struct zr_wall_frame *frame;
    double begin, end;            /* heights of the wall */
    int before, at_begin, at_end; /* sums of turns: before the wall, and within a step of its ends */
    int count;
    struct crossing crossings[ZR_WALL_CROSSINGS]; /* within the wall, ascending */
};

/* Returns how often the triangle's border winds around the point. Both triangles of an edge decide alike about it. */
static int winding_of(const struct zr_wall_point c[3], struct zr_wall_point p)
{
    int winding = 0;
    for (int k = 0; k < 3; k++) {
        const struct zr_wall_point a = c[k], b = c[(k + 1) % 3];
        if ((a.v <= p.v) == (b.v <= p.v)) continue;
        const bool rises = a.v <= p.v;
        const double side = rises ? zr_wall_turn(a, b, p) : zr_wall_turn(b, a, p);
        if (side > 0.0) winding += rises ? 1 : -1;
    }
    return winding;
}

/* Adds the crossing with a triangle that winds around the line. False if there are too many. */
static bool put_crossing(const struct zr_wall_search *s, struct line *line, const struct zr_wall_facet *f, int winding)
{
    const struct crossing own = {zr_wall_height_at(f, line->at), -winding};
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

static void project_triangle(const struct zr_wall_search *s, const struct zr_wall_frame *frame, uint32_t triangle,
                             struct zr_wall_facet *out)
{
    struct zr_world_place p[3];
    zr_wall_solid_places(s->solid, triangle, p);
    zr_wall_project(frame, p, out);
}

static bool add_crossing(const struct zr_wall_search *s, struct line *line, uint32_t triangle)
{
    struct zr_wall_facet f;
    project_triangle(s, line->frame, triangle, &f);
    const int winding = winding_of(f.corners, line->at);
    return winding == 0 || !zr_wall_find_plane(&f) || put_crossing(s, line, &f, winding);
}

static bool is_on_line(const struct zr_wall_search *s, const struct line *line, const struct zr_wall_box *box)
{
    const struct zr_wall_frame *f = line->frame;
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
static bool cross_all(struct zr_wall_search *s, struct line *line)
{
    const struct zr_wall_solid *solid = s->solid;
    const struct zr_wall_tree *tree = &solid->around;
    uint32_t stack[ZR_WALL_DEPTH] = {1};
    for (int depth = 1; depth > 0;) {
        const uint32_t node = stack[--depth];
        if (!zr_wall_has_steps(s, 1)) return false;
        if (!is_on_line(s, line, &tree->boxes[node])) continue;
        if (node < solid->leaf_count) {
            stack[depth++] = 2 * node;
            stack[depth++] = 2 * node + 1;
            continue;
        }
        const uint32_t begin = (node - solid->leaf_count) * ZR_WALL_LEAF, left = solid->count - begin;
        if (!zr_wall_has_steps(s, 2 * ZR_WALL_LEAF)) return false;
        for (uint32_t i = 0; i < ZR_WALL_LEAF && i < left; i++)
            if (!add_crossing(s, line, tree->order[begin + i])) {
                s->is_stopped = true;
                return false;
            }
    }
    return true;
}

static bool cross_beside(struct zr_wall_search *s, const struct beside *beside, struct line *line)
{
    if (!zr_wall_has_steps(s, 1 + (uint32_t)beside->count / BESIDE_PER_STEP)) return false;
    for (int i = 0; i < beside->count; i++) {
        const int winding = winding_of(beside->facets[i].corners, line->at);
        if (winding == 0 || put_crossing(s, line, &beside->facets[i], winding)) continue;
        s->is_stopped = true;
        return false;
    }
    return true;
}

/* Returns true if all is inside from the wall's begin to its end on this line, and outside before and behind. */
static bool is_wall_at(struct zr_wall_search *s, const struct zr_wall_pair *pair, struct zr_wall_point at,
                       const struct beside *beside)
{
    struct line line; /* not cleared: most of it is never used */
    const double step = s->solid->step;
    line.at = at;
    line.frame = &pair->frame;
    line.begin = zr_wall_height_at(&pair->near, at);
    line.end = zr_wall_height_at(&pair->far, at);
    line.before = line.at_begin = line.at_end = line.count = 0;
    if (line.end - line.begin <= step) return false;
    if (!(beside ? cross_beside(s, beside, &line) : cross_all(s, &line))) return false;
    if (!zr_wall_has_steps(s, (uint32_t)(line.count * line.count) / MOVES_PER_STEP) || line.before != 0) return false;
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

static bool is_box_beside(const struct beside *beside, const struct zr_wall_frame *frame, const struct zr_wall_box *box,
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

static bool is_facet_beside(const struct beside *beside, const struct zr_wall_facet *f, double step)
{
    const struct zr_wall_point *c = f->corners;
    return zr_most_of(c[0].u, zr_most_of(c[1].u, c[2].u)) >= beside->low.u - step &&
           zr_least_of(c[0].u, zr_least_of(c[1].u, c[2].u)) <= beside->high.u + step &&
           zr_most_of(c[0].v, zr_most_of(c[1].v, c[2].v)) >= beside->low.v - step &&
           zr_least_of(c[0].v, zr_least_of(c[1].v, c[2].v)) <= beside->high.v + step;
}

static void hold_leaf(const struct zr_wall_search *s, const struct zr_wall_frame *frame, uint32_t leaf,
                      struct beside *beside)
{
    const uint32_t begin = leaf * ZR_WALL_LEAF, left = s->solid->count - begin;
    for (uint32_t i = 0; i < ZR_WALL_LEAF && i < left; i++) {
        struct zr_wall_facet f;
        project_triangle(s, frame, s->solid->around.order[begin + i], &f);
        if (!is_facet_beside(beside, &f, s->solid->step) || !zr_wall_find_plane(&f)) continue;
        if (beside->count == BESIDE_MAX) {
            beside->is_full = true;
            return;
        }
        beside->facets[beside->count++] = f;
    }
}

/* Holds the triangles that lines through the overlap may cross. False: there are too many, or no steps left. */
static bool hold_beside(struct zr_wall_search *s, const struct zr_wall_pair *pair, struct beside *beside)
{
    const struct zr_wall_solid *solid = s->solid;
    beside->low = beside->high = pair->overlap[0];
    beside->end = -HUGE_VAL;
    beside->count = 0;
    beside->is_full = false;
    for (int i = 0; i < pair->count; i++) {
        const struct zr_wall_point p = pair->overlap[i];
        beside->low = (struct zr_wall_point){zr_least_of(beside->low.u, p.u), zr_least_of(beside->low.v, p.v)};
        beside->high = (struct zr_wall_point){zr_most_of(beside->high.u, p.u), zr_most_of(beside->high.v, p.v)};
        beside->end = zr_most_of(beside->end, zr_wall_height_at(&pair->far, p));
    }
    uint32_t stack[ZR_WALL_DEPTH] = {1};
    for (int depth = 1; depth > 0 && !beside->is_full;) {
        const uint32_t node = stack[--depth];
        if (!zr_wall_has_steps(s, 1)) return false;
        if (!is_box_beside(beside, &pair->frame, &solid->around.boxes[node], solid->step)) continue;
        if (node < solid->leaf_count) {
            stack[depth++] = 2 * node;
            stack[depth++] = 2 * node + 1;
        } else {
            if (!zr_wall_has_steps(s, 2 * ZR_WALL_LEAF)) return false;
            hold_leaf(s, &pair->frame, node - solid->leaf_count, beside);
        }
    }
    return !beside->is_full;
}

/* Notes the middle of a wall along a line. Returns true. */
static bool keep_place(struct zr_wall_search *s, const struct zr_wall_pair *pair, struct zr_wall_point p)
{
    const struct zr_wall_frame *frame = &pair->frame;
    const double height = 0.5 * (zr_wall_height_at(&pair->near, p) + zr_wall_height_at(&pair->far, p));
    s->at = (struct zr_world_place){(p.u * frame->u.x + p.v * frame->v.x) + height * frame->d.x,
                                    (p.u * frame->u.y + p.v * frame->v.y) + height * frame->d.y,
                                    (p.u * frame->u.z + p.v * frame->v.z) + height * frame->d.z};
    return true;
}

/* The middle of the overlap, and places near its corners and sides. */
bool zr_wall_probe(struct zr_wall_search *s, const struct zr_wall_pair *pair)
{
    struct zr_wall_point middle = {0, 0};
    struct beside beside;
    for (int i = 0; i < pair->count; i++) {
        middle.u += pair->overlap[i].u / pair->count;
        middle.v += pair->overlap[i].v / pair->count;
    }
    if (is_wall_at(s, pair, middle, NULL)) return keep_place(s, pair, middle);
    const struct beside *held = hold_beside(s, pair, &beside) ? &beside : NULL;
    for (int i = 0; i < 3 * pair->count; i++) {
        static const double shares[3] = {0.75, 0.5, 0.96875}; /* half way to a side, to a corner, and next to it */
        const struct zr_wall_point a = pair->overlap[i / 3], b = pair->overlap[(i / 3 + 1) % pair->count],
                                   to = i % 3 == 0 ? (struct zr_wall_point){0.5 * (a.u + b.u), 0.5 * (a.v + b.v)} : a;
        const double share = shares[i % 3];
        if (s->is_stopped) return false;
        const struct zr_wall_point at = {middle.u + share * (to.u - middle.u), middle.v + share * (to.v - middle.v)};
        if (is_wall_at(s, pair, at, held)) return keep_place(s, pair, at);
    }
    return false;
}
