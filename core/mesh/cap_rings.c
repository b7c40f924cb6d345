#include "mesh/cap_rings.h"

struct point {
    double x, y;
};

struct grouping {
    const struct zr_mesh *mesh;
    const struct zr_rings *rings;
    const struct zr_cancel *cancel;
    int axis; /* along which corners are projected */
};

static struct point project(const struct grouping *g, uint32_t slot)
{
    const zr_vec3 p = zr_vec4_over_w(g->mesh->positions[g->mesh->indices[slot]]);
    const double at[3] = {(double)p.x, (double)p.y, (double)p.z};
    return (struct point){at[(g->axis + 1) % 3], at[(g->axis + 2) % 3]};
}

/* Returns twice the signed area of a ring along the axis. */
static double area_of(const struct grouping *g, uint32_t ring)
{
    const uint32_t begin = g->rings->offsets[ring], end = g->rings->offsets[ring + 1];
    const struct point first = project(g, begin);
    double sum = 0.0;
    for (uint32_t i = begin + 1; i + 1 < end; i++) {
        const struct point p = project(g, i), q = project(g, i + 1);
        sum += (p.x - first.x) * (q.y - first.y) - (p.y - first.y) * (q.x - first.x);
    }
    return sum;
}

/* Selects the axis along which ring 0 has the largest area. Returns that area, with its sign. */
static double choose_axis(struct grouping *g)
{
    double most = 0.0, largest = 0.0; /* not fabs(most): see outside_of in lines/line_pieces.c */
    int best = 0;
    for (g->axis = 0; g->axis < 3; g->axis++) {
        const double area = area_of(g, 0);
        if (!(fabs(area) > largest)) continue;
        largest = fabs(area);
        most = area;
        best = g->axis;
    }
    g->axis = best;
    return most;
}

/* Returns true if a ray from the point crosses the ring an odd number of times. */
static bool contains(const struct grouping *g, uint32_t ring, struct point at)
{
    const uint32_t begin = g->rings->offsets[ring], end = g->rings->offsets[ring + 1];
    struct point a = project(g, end - 1);
    bool is_inside = false;
    for (uint32_t i = begin; i < end; i++) {
        const struct point b = project(g, i);
        if ((a.y > at.y) != (b.y > at.y) && at.x < a.x + (b.x - a.x) * ((at.y - a.y) / (b.y - a.y)))
            is_inside = !is_inside;
        a = b;
    }
    return is_inside;
}

/* Returns true if the ring contains most of three points of the other: the middles of edges, moved by the share
 * `inwards` of the edge, where the other turns left if `turn` is positive. */
static bool is_around(const struct grouping *g, uint32_t ring, uint32_t other, double turn, double inwards)
{
    const uint32_t begin = g->rings->offsets[other], count = g->rings->offsets[other + 1] - begin;
    const double share = turn > 0.0 ? inwards : 0.0 - inwards;
    int inside = 0;
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t i = (uint32_t)((uint64_t)count * k / 3);
        const struct point a = project(g, begin + i), b = project(g, begin + (i + 1) % count);
        const struct point at = {0.5 * (a.x + b.x) - share * (b.y - a.y), 0.5 * (a.y + b.y) + share * (b.x - a.x)};
        inside += contains(g, ring, at);
    }
    return inside >= 2;
}

/* Returns true if a hole contains an earlier hole of the ring's group, lies in one, or coincides with one: its area is
 * taken away already. */
static bool is_taken(const struct grouping *g, const uint32_t *groups, uint32_t ring, uint32_t hole)
{
    const double inwards = 1e-3, turn = area_of(g, hole);
    for (uint32_t other = 0; other < hole && !zr_is_cancelled(g->cancel); other++) {
        if (groups[other] != ring || other == ring) continue;
        if (is_around(g, other, hole, turn, inwards) || is_around(g, hole, other, area_of(g, other), inwards))
            return true;
    }
    return false;
}

/* Returns the smallest ring around a hole, the hole itself if there is none. `is_free`: none of which an earlier hole
 * has taken it. *around: how many rings are around it. */
static uint32_t smallest_around(const struct grouping *g, const uint32_t *groups, uint32_t hole, double sign,
                                bool is_free, uint32_t *around)
{
    const double own = area_of(g, hole);
    double least = HUGE_VAL;
    uint32_t found = hole;
    *around = 0;
    for (uint32_t ring = 0; ring < g->rings->count && !zr_is_cancelled(g->cancel); ring++) {
        const double area = area_of(g, ring);
        if (area * sign <= 0.0 || fabs(area) < fabs(own) || !is_around(g, ring, hole, own, 0.0)) continue;
        ++*around;
        if (fabs(area) >= least || (is_free && is_taken(g, groups, ring, hole))) continue;
        least = fabs(area);
        found = ring;
    }
    return found;
}

void zr_cap_rings_group(const struct zr_mesh *mesh, const struct zr_rings *rings, const struct zr_cancel *cancel,
                        uint32_t *groups)
{
    struct grouping g = {.mesh = mesh, .rings = rings, .cancel = cancel};
    const double sign = choose_axis(&g);
    for (uint32_t hole = 0; hole < rings->count; hole++) {
        uint32_t around;
        groups[hole] = hole;
        if (!(area_of(&g, hole) * sign < 0.0)) continue;
        groups[hole] = smallest_around(&g, groups, hole, sign, false, &around);
        if (around < 2) continue;
        const uint32_t found = smallest_around(&g, groups, hole, sign, true, &around);
        if (found != hole) groups[hole] = found;
    }
}
