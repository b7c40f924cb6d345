/* face_shapes.h - faces of every shape for tests, with corners on a grid of integers: areas are exact. */
#ifndef ZR_TEST_FACE_SHAPES_H
#define ZR_TEST_FACE_SHAPES_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include "support/random.h"

enum { CORNERS_MAX = 1024, RINGS_MAX = 341 };

struct grid_point {
    int64_t x, y;
};

struct face {
    struct grid_point at[CORNERS_MAX];
    uint32_t ring_offsets[RINGS_MAX + 1], rings;
};

static inline uint32_t corners_of(const struct face *face)
{
    return face->ring_offsets[face->rings];
}

static inline int64_t turn(struct grid_point a, struct grid_point b, struct grid_point c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* Twice the area. */
static inline int64_t ring_area(const struct face *face, uint32_t r)
{
    int64_t sum = 0;
    uint32_t begin = face->ring_offsets[r], end = face->ring_offsets[r + 1];
    for (uint32_t i = begin + 2; i < end; i++)
        sum += turn(face->at[begin], face->at[i - 1], face->at[i]);
    return sum;
}

/* Is the middle of the edge from `p` to `q` inside of ring r? */
static inline bool is_inside(const struct face *face, uint32_t r, struct grid_point p, struct grid_point q)
{
    bool inside = false;
    struct grid_point middle = {p.x + q.x, p.y + q.y};
    uint32_t begin = face->ring_offsets[r], end = face->ring_offsets[r + 1];
    for (uint32_t i = begin; i < end; i++) {
        struct grid_point a = face->at[i], b = face->at[i + 1 < end ? i + 1 : begin];
        a = (struct grid_point){2 * a.x, 2 * a.y};
        b = (struct grid_point){2 * b.x, 2 * b.y};
        if ((a.y <= middle.y) == (b.y <= middle.y)) continue;
        int64_t side = turn(a, b, middle);
        if (a.y < b.y ? side > 0 : side < 0) inside = !inside;
    }
    return inside;
}

/* Is ring r inside of ring s? Told by an edge in whose middle no corner of s touches it. */
static inline bool ring_is_inside(const struct face *face, uint32_t s, uint32_t r)
{
    const struct grid_point *p = face->at + face->ring_offsets[r];
    bool touched = true;
    for (uint32_t k = face->ring_offsets[r]; touched && k + 1 < face->ring_offsets[r + 1]; k++) {
        p = face->at + k;
        touched = false;
        for (uint32_t i = face->ring_offsets[s]; i < face->ring_offsets[s + 1]; i++)
            touched |= 2 * face->at[i].x == p[0].x + p[1].x && 2 * face->at[i].y == p[0].y + p[1].y;
    }
    return is_inside(face, s, p[0], p[1]);
}

/* Rings inside of an even number of others add to the area, the others take away from it. */
static inline int64_t area_by_nesting(const struct face *face)
{
    int64_t sum = 0;
    for (uint32_t r = 0; r < face->rings; r++) {
        int depth = 0;
        for (uint32_t s = 0; s < face->rings; s++)
            depth += s != r && ring_is_inside(face, s, r);
        sum += depth % 2 ? -llabs(ring_area(face, r)) : llabs(ring_area(face, r));
    }
    return sum;
}

/* ---- shapes ---- */

static inline void start(struct face *face)
{
    face->rings = 0;
    face->ring_offsets[0] = 0;
}

static inline void add(struct face *face, uint32_t *corner, int64_t x, int64_t y)
{
    face->at[(*corner)++] = (struct grid_point){x, y};
}

static inline void end_ring(struct face *face, uint32_t end)
{
    face->ring_offsets[++face->rings] = end;
}

static inline void reverse_ring(struct face *face, uint32_t r)
{
    for (uint32_t i = face->ring_offsets[r], k = face->ring_offsets[r + 1]; i + 1 < k; i++) {
        struct grid_point moved = face->at[i];
        face->at[i] = face->at[--k];
        face->at[k] = moved;
    }
}

static inline int half_of(struct grid_point p)
{
    return p.y < 0 || (p.y == 0 && p.x < 0);
}

static inline int compare_directions(const void *left, const void *right)
{
    const struct grid_point *a = left, *b = right;
    if (half_of(*a) != half_of(*b)) return half_of(*a) - half_of(*b);
    int64_t cross = a->x * b->y - a->y * b->x;
    return cross > 0 ? -1 : cross < 0 ? 1 : 0;
}

/* Corners around (x, y) in the order of their directions, none twice. The first four, on the axes, keep the
 * centre inside. */
static inline void add_star(struct face *face, struct random *random, int64_t x, int64_t y, int64_t radius,
                            uint32_t count)
{
    uint32_t begin = corners_of(face), end = begin;
    for (uint32_t i = 0; i < count; i++) {
        int64_t dx = (int64_t)random_below(random, (uint32_t)(2 * radius)) - radius;
        int64_t dy = (int64_t)random_below(random, (uint32_t)(2 * radius)) - radius;
        if (i < 4) {
            dx = i % 2 ? 0 : (1 - (int64_t)i) * radius;
            dy = i % 2 ? (2 - (int64_t)i) * radius : 0;
        }
        if (dx != 0 || dy != 0) face->at[end++] = (struct grid_point){dx, dy};
    }
    qsort(face->at + begin, end - begin, sizeof face->at[0], compare_directions);
    uint32_t kept = begin;
    for (uint32_t i = begin; i < end; i++)
        if (i == begin || compare_directions(&face->at[kept - 1], &face->at[i]) != 0) face->at[kept++] = face->at[i];
    for (uint32_t i = begin; i < kept; i++) {
        face->at[i].x += x;
        face->at[i].y += y;
    }
    end_ring(face, kept);
    if (random_below(random, 2)) reverse_ring(face, face->rings - 1);
}

static inline int sign(int64_t value)
{
    return (value > 0) - (value < 0);
}

static inline bool is_between(struct grid_point a, struct grid_point b, struct grid_point p)
{
    int64_t along = (p.x - a.x) * (p.x - b.x) + (p.y - a.y) * (p.y - b.y);
    return turn(a, b, p) == 0 && along <= 0;
}

static inline bool edges_touch(struct grid_point a, struct grid_point b, struct grid_point c, struct grid_point d)
{
    if (is_between(a, b, c) || is_between(a, b, d) || is_between(c, d, a) || is_between(c, d, b)) return true;
    return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
}

/* Random points, uncrossed: while two edges meet, the way between them is turned round. False where that does not
 * come to an end, as with corners in one place. */
static inline bool add_uncrossed(struct face *face, struct random *random, uint32_t size, uint32_t count)
{
    uint32_t begin = corners_of(face);
    struct grid_point *p = face->at + begin;
    for (uint32_t i = 0; i < count; i++)
        p[i] = (struct grid_point){random_below(random, size), random_below(random, size)};
    end_ring(face, begin + count);
    bool crossed = true;
    for (uint32_t round = 0; crossed && round < 200; round++) {
        crossed = false;
        for (uint32_t i = 0; i + 1 < count; i++)
            for (uint32_t k = i + 1; k < count; k++) {
                struct grid_point a = p[i], b = p[i + 1], c = p[k], d = p[(k + 1) % count];
                bool after = k == i + 1, before = (k + 1) % count == i;
                bool meet = after    ? is_between(a, b, d) || is_between(b, d, a)
                            : before ? is_between(a, b, c) || is_between(c, a, b)
                                     : edges_touch(a, b, c, d);
                if (!meet) continue;
                crossed = true;
                for (uint32_t low = i + 1, high = k; low < high; low++, high--) {
                    struct grid_point moved = p[low];
                    p[low] = p[high];
                    p[high] = moved;
                }
            }
    }
    return !crossed && ring_area(face, face->rings - 1) != 0;
}

#endif
