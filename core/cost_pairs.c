#include "cost_pairs.h"

#include <math.h>
#include <stdbool.h>

/* A triangle that another one cuts in its three edges has six corners at most. */
enum { CORNERS_MAX = 6 };

struct point {
    double x, y;
};

struct polygon {
    int count;
    struct point corners[CORNERS_MAX + 1];
};

static struct point point_of(const struct zr_window_vertex *v)
{
    return (struct point){(double)v->x, (double)v->y};
}

/* Twice the area of a, b, c: positive where they turn to the left. */
static double turn(struct point a, struct point b, struct point c)
{
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/* What is on the left of the line from a to b. Source: Sutherland & Hodgman 1974. */
static struct polygon cut(const struct polygon *in, struct point a, struct point b)
{
    struct polygon out = {.count = 0};
    for (int i = 0; i < in->count; i++) {
        const struct point p = in->corners[i], q = in->corners[i + 1 < in->count ? i + 1 : 0];
        const double side_p = turn(a, b, p), side_q = turn(a, b, q);
        if (side_p >= 0.0 && out.count < CORNERS_MAX) out.corners[out.count++] = p;
        if ((side_p >= 0.0) == (side_q >= 0.0) || out.count == CORNERS_MAX) continue;
        const double t = side_p / (side_p - side_q);
        out.corners[out.count++] = (struct point){p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
    }
    return out;
}

static double doubled_area(const struct zr_cost_triangle *t)
{
    return turn(point_of(&t->corners[0]), point_of(&t->corners[1]), point_of(&t->corners[2]));
}

static double depth_at(const struct zr_cost_triangle *t, struct point p)
{
    const struct zr_window_vertex *a = &t->corners[0], *b = &t->corners[1], *c = &t->corners[2];
    const double u = turn(p, point_of(b), point_of(c)), v = turn(p, point_of(c), point_of(a)),
                 w = turn(p, point_of(a), point_of(b));
    return (u * (double)a->z + v * (double)b->z + w * (double)c->z) / (u + v + w);
}

static bool ranges_overlap(const struct zr_cost_triangle *p, const struct zr_cost_triangle *q, size_t offset)
{
    float low[2] = {HUGE_VALF, HUGE_VALF}, high[2] = {-HUGE_VALF, -HUGE_VALF};
    for (int k = 0; k < 6; k++) {
        const struct zr_cost_triangle *of = k < 3 ? p : q;
        const float value = *(const float *)(const void *)((const char *)&of->corners[k % 3] + offset);
        low[k / 3] = fminf(low[k / 3], value);
        high[k / 3] = fmaxf(high[k / 3], value);
    }
    return low[0] < high[1] && low[1] < high[0];
}

static double area_of(const struct polygon *polygon)
{
    double doubled = 0.0;
    for (int i = 2; i < polygon->count; i++)
        doubled += turn(polygon->corners[0], polygon->corners[i - 1], polygon->corners[i]);
    return 0.5 * fabs(doubled);
}

static double height_of(const struct zr_cost_triangle *t)
{
    const double a = (double)t->corners[0].y, b = (double)t->corners[1].y, c = (double)t->corners[2].y;
    return fmax(a, fmax(b, c)) - fmin(a, fmin(b, c));
}

/* Adds one pair to the sum. */
static void add_pair(struct zr_cost_pairs *sum, const struct zr_cost_triangle *p, const struct zr_cost_triangle *q)
{
    if (!ranges_overlap(p, q, offsetof(struct zr_window_vertex, x)) ||
        !ranges_overlap(p, q, offsetof(struct zr_window_vertex, y)) ||
        !ranges_overlap(p, q, offsetof(struct zr_window_vertex, z)))
        return;
    sum->meeting += 1.0;
    struct polygon both = {3, {point_of(&p->corners[0]), point_of(&p->corners[1]), point_of(&p->corners[2])}};
    const bool left = doubled_area(q) > 0.0;
    for (int k = 0; k < 3; k++) {
        const struct point a = point_of(&q->corners[k]), b = point_of(&q->corners[(k + 1) % 3]);
        both = left ? cut(&both, a, b) : cut(&both, b, a);
    }
    bool nearer = false, farther = false;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < both.count; i++) {
        const double behind = depth_at(p, both.corners[i]) - depth_at(q, both.corners[i]);
        nearer |= behind < 0.0;
        farther |= behind > 0.0;
        low = fmin(low, both.corners[i].y);
        high = fmax(high, both.corners[i].y);
    }
    if (both.count < 3) return;
    sum->overlapping += 1.0;
    sum->heights += height_of(p) + height_of(q);
    if (nearer && farther && high - low >= 1.0) {
        sum->crossing += 1.0;
        sum->rows += high - low;
    } else {
        sum->area += area_of(&both);
    }
}

struct zr_cost_pairs zr_cost_pairs_measure(const struct zr_cost_triangle *triangles, size_t count)
{
    struct zr_cost_pairs sum = {.meeting = 0.0};
    if (count < 2) return sum;
    for (size_t i = 1; i < count; i++)
        for (size_t k = 0; k < i; k++)
            add_pair(&sum, &triangles[i], &triangles[k]);
    const double pairs = 0.5 * (double)count * (double)(count - 1);
    return (struct zr_cost_pairs){.meeting = sum.meeting / pairs,
                                  .overlapping = sum.overlapping / pairs,
                                  .heights = sum.heights / pairs,
                                  .area = sum.area / pairs,
                                  .crossing = sum.crossing / pairs,
                                  .rows = sum.rows / pairs};
}
