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

#endif
