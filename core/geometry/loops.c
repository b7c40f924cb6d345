#include "geometry/loops.h"

#include <string.h>

typedef struct zr_loop_corner node;

#define NONE UINT32_MAX
enum { RING_MIN = 3, BRIDGES_IN_PLACE = 16 };

enum { VISITS_PER_CANCEL_CHECK = 1 << 18 };

bool zr_loops_stopped(struct zr_loops *loops, uint64_t visits)
{
    if (visits < loops->next_look) return false;
    loops->next_look = visits + VISITS_PER_CANCEL_CHECK;
    return zr_is_cancelled(loops->cancel);
}

/* ---- the plane ---- */

/* Divides a point by w. Returns false if the result is not usable: with corners on both sides of w = 0, the divided
 * rings enclose another region. */
static bool place(zr_vec4 point, double out[3])
{
    out[0] = (double)point.x;
    out[1] = (double)point.y;
    out[2] = (double)point.z;
    if (point.w != 1.0f) {
        double w = (double)point.w;
        for (int axis = 0; axis < 3; axis++)
            out[axis] /= w;
    }
    return isfinite(out[0]) && isfinite(out[1]) && isfinite(out[2]) && point.w > 0.0f && isfinite(point.w);
}

/* Adds the Newell normal of a ring to `normal`, and the magnitudes of its terms to `size`. Terms are relative to the
 * first corner, so that a small face far from the origin keeps its precision. */
static bool add_normal(const zr_vec4 *points, uint32_t begin, uint32_t end, double normal[3], double size[3])
{
    double origin[3], previous[3], current[3];
    if (!place(points[begin], origin)) return false;
    memset(previous, 0, sizeof previous);
    for (uint32_t corner = begin + 1; corner < end; corner++) {
        if (!place(points[corner], current)) return false;
        for (int axis = 0; axis < 3; axis++)
            current[axis] -= origin[axis];
        for (int axis = 0; axis < 3; axis++) {
            int a = (axis + 1) % 3, b = (axis + 2) % 3;
            double term = previous[a] * current[b] - previous[b] * current[a];
            normal[axis] += term;
            size[axis] += fabs(term);
        }
        memcpy(previous, current, sizeof previous);
    }
    return true;
}

static int largest(const double v[3])
{
    double x = fabs(v[0]), y = fabs(v[1]), z = fabs(v[2]);
    return x > y && x > z ? 0 : y > z ? 1 : 2;
}

/* A ring whose parts cancel out, such as a bow tie, has a normal of rounding errors only: the largest terms then define
 * its plane. */
bool zr_loops_axes(const zr_vec4 *points, const uint32_t *ring_offsets, uint32_t rings, int axes[2])
{
    double normal[3] = {0, 0, 0}, others[3] = {0, 0, 0}, size[3] = {0, 0, 0};
    for (uint32_t r = 0; r < rings; r++)
        if (ring_offsets[r + 1] > ring_offsets[r] &&
            !add_normal(points, ring_offsets[r], ring_offsets[r + 1], r == 0 ? normal : others, size))
            return false;
    int axis = largest(normal), widest = largest(size);
    if (!(size[widest] > 0.0)) return false;
    if (fabs(normal[axis]) < 1e-3 * size[widest]) axis = widest;
    bool behind = normal[axis] < 0.0;
    axes[behind] = (axis + 1) % 3;
    axes[!behind] = (axis + 2) % 3;
    return true;
}

/* ---- rings ---- */

static void link_ring(node *nodes, const zr_vec4 *points, const int axes[2], uint32_t first_corner, uint32_t begin,
                      uint32_t end)
{
    for (uint32_t i = begin; i < end; i++) {
        double at[3];
        place(points[first_corner + i], at);
        nodes[i] = (node){.u = at[axes[0]],
                          .v = at[axes[1]],
                          .corner = first_corner + i,
                          .previous = i > begin ? i - 1 : end - 1,
                          .next = i + 1 < end ? i + 1 : begin};
    }
}

/* Joins a ring to the face with its interior on the left: outer rings turn left, holes right. */
static void join_ring(node *nodes, uint32_t start, bool hole)
{
    double area = 0.0;
    uint32_t i = start;
    do {
        nodes[i].joined = true;
        area += zr_loop_corner_turn(&nodes[start], &nodes[i], &nodes[nodes[i].next]);
        i = nodes[i].next;
    } while (i != start);
    if (hole ? area <= 0.0 : area >= 0.0) return;
    do {
        uint32_t next = nodes[i].next;
        nodes[i].next = nodes[i].previous;
        nodes[i].previous = next;
        i = next;
    } while (i != start);
}

/* ---- bridges ---- */

/* Returns true if `to` lies in the corner's angle, to the left of its edges or on them. The angle of a spike, which a
 * bridge along an edge leaves behind, is empty. Bridges between corners in one position are skipped: they have no
 * length. */
static bool faces(const node *nodes, const node *corner, const node *to)
{
    const node *previous = &nodes[corner->previous], *next = &nodes[corner->next];
    for (int i = 0; i < BRIDGES_IN_PLACE && zr_loop_corner_is_at(previous, corner); i++)
        previous = &nodes[previous->previous];
    for (int i = 0; i < BRIDGES_IN_PLACE && zr_loop_corner_is_at(next, corner); i++)
        next = &nodes[next->next];
    double bend = zr_loop_corner_turn(previous, corner, next);
    if (bend > 0.0)
        return zr_loop_corner_turn(corner, next, to) >= 0.0 && zr_loop_corner_turn(corner, to, previous) >= 0.0;
    if (bend == 0.0 && zr_loop_corner_along(previous, corner, next) < 0.0) return false;
    return !(zr_loop_corner_turn(corner, previous, to) > 0.0 && zr_loop_corner_turn(corner, to, next) > 0.0);
}

/* Casts a ray from `m` towards +u, offset by an infinitesimal step along the edge to its neighbour `n` if it meets a
 * corner. Returns true if it crosses an odd number of joined edges. Sets *wall to the start of the nearest edge that
 * has `m` on its inner side. Bridges are crossed twice and do not change the parity. */
static bool cast_right(const struct zr_loops *t, const node *m, const node *n, uint32_t *wall)
{
    const node *nodes = t->nodes;
    bool odd = false, from_below = n->v < m->v;
    double nearest = 0.0;
    *wall = NONE;
    for (uint32_t i = 0; i < t->node_count; i++) {
        const node *p = &nodes[i], *q = &nodes[p->next];
        bool upward = from_below ? p->v < m->v : p->v <= m->v;
        if (!p->joined || upward == (from_below ? q->v < m->v : q->v <= m->v)) continue;
        double side = upward ? zr_loop_corner_turn(p, q, m) : zr_loop_corner_turn(q, p, m);
        if (side == 0.0) side = upward ? zr_loop_corner_turn(p, q, n) : zr_loop_corner_turn(q, p, n);
        if (side < 0.0) continue;
        odd = !odd;
        double u = p->u + (m->v - p->v) * ((q->u - p->u) / (q->v - p->v));
        if (!upward || (*wall != NONE && u >= nearest)) continue;
        nearest = u;
        *wall = i;
    }
    return odd;
}

/* Compares two corners from `m`: returns true if `a` deviates less from the direction +u than `b`, or equally and is
 * nearer. */
static bool is_nearer(const node *m, const node *a, const node *b)
{
    double au = a->u - m->u, av = fabs(a->v - m->v), bu = b->u - m->u, bv = fabs(b->v - m->v);
    double cross = av * bu - bv * au;
    return cross != 0.0 ? cross < 0.0 : au + av < bu + bv;
}

/* Returns a corner visible from `m`: the end of the wall with the larger u, unless other corners lie in the triangle of
 * m, the wall and that end; then the corner nearest to the ray. At a position shared by bridge ends, it is the corner
 * that faces m. */
static uint32_t visible_from(const struct zr_loops *t, const node *m, uint32_t wall)
{
    const node *nodes = t->nodes, *p = &nodes[wall], *q = &nodes[p->next];
    uint32_t best = NONE, end = p->v == m->v || (p->u > q->u && q->v != m->v) ? wall : p->next;
    const node *far = &nodes[end];
    bool above = far->v > m->v;
    for (uint32_t i = 0; i < t->node_count; i++) {
        const node *r = &nodes[i];
        if (!r->joined || r->u < m->u || (above ? r->v < m->v : r->v > m->v)) continue;
        double beyond = zr_loop_corner_turn(m, far, r);
        if ((above ? beyond > 0.0 : beyond < 0.0) || zr_loop_corner_turn(p, q, r) < 0.0) continue;
        if (best != NONE && !is_nearer(m, r, &nodes[best])) continue;
        if (faces(nodes, r, zr_loop_corner_is_at(r, m) ? &nodes[m->next] : m)) best = i;
    }
    return best != NONE ? best : end;
}

/* Connects corner `r` with the hole at `m` by an edge there and back. */
static void build_bridge(struct zr_loops *t, uint32_t r, uint32_t m)
{
    node *nodes = t->nodes;
    uint32_t m_again = t->node_count++, r_again = t->node_count++;
    nodes[m_again] = nodes[m];
    nodes[r_again] = nodes[r];
    nodes[nodes[m].previous].next = m_again;
    nodes[m_again].next = r_again;
    nodes[r_again].previous = m_again;
    nodes[nodes[r].next].previous = r_again;
    nodes[r].next = m;
    nodes[m].previous = r;
}

/* Sorts from right to left, so that a ray to the right only meets joined rings. */
static void sort_rings(const node *nodes, uint32_t *rightmost, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        uint32_t moved = rightmost[i], k = i;
        for (; k > 0 && nodes[rightmost[k - 1]].u < nodes[moved].u; k--)
            rightmost[k] = rightmost[k - 1];
        rightmost[k] = moved;
    }
}

void zr_loops_join(struct zr_loops *t, const zr_vec4 *points, const uint32_t *ring_offsets, uint32_t rings,
                   const int axes[2])
{
    uint32_t count = 0, base = ring_offsets[0];
    for (uint32_t r = 0; r < rings; r++) {
        uint32_t begin = ring_offsets[r] - base, end = ring_offsets[r + 1] - base, best = begin;
        link_ring(t->nodes, points, axes, base, begin, end);
        if (end - begin < RING_MIN) {
            for (uint32_t i = begin; i < end; i++)
                t->nodes[i].done = true;
            continue;
        }
        for (uint32_t i = begin + 1; i < end; i++)
            if (t->nodes[i].u > t->nodes[best].u) best = i;
        t->rightmost[count++] = best;
    }
    t->node_count = ring_offsets[rings] - base;
    sort_rings(t->nodes, t->rightmost, count);
    for (uint32_t r = 0; r < count; r++) {
        uint32_t m = t->rightmost[r], wall = NONE;
        bool hole = r > 0 && cast_right(t, &t->nodes[m], &t->nodes[t->nodes[m].next], &wall) && wall != NONE;
        uint32_t seen = hole ? visible_from(t, &t->nodes[m], wall) : NONE;
        t->visits += 2 * (uint64_t)t->node_count;
        if (zr_loops_stopped(t, t->visits)) return;
        join_ring(t->nodes, m, hole);
        if (hole) build_bridge(t, seen, m);
    }
}
