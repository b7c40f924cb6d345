/* Predicts texture coordinates of Draco meshes: each triangle has about the same form in space and in the texture. */
#include "input/codecs/draco_mesh.h"

#include <math.h>
#include <stdlib.h>

/* Flags that are used from the last one. */
struct sides {
    bool *are_left;
    uint32_t count;
};

static bool read_sides(struct zr_draco *draco, uint32_t most, struct sides *out)
{
    struct zr_draco_flags flags;
    bool is_left = true;
    out->count = zr_draco_u32(&draco->stream);
    if (out->count > most || !zr_draco_flags_open(&draco->stream, &flags)) return false;
    out->are_left = zr_arena_alloc(&draco->scratch, out->count, sizeof *out->are_left);
    for (uint32_t i = 0; out->are_left && i < out->count; i++) {
        if (zr_draco_stops(draco)) return false;
        if (!zr_draco_flags_next(&flags)) is_left = !is_left;
        out->are_left[i] = is_left;
    }
    return out->are_left && !flags.is_broken;
}

/* Returns the root, rounded down. */
static uint64_t find_root(uint64_t square)
{
    uint64_t root = (uint64_t)sqrt((double)square);
    if (root > UINT32_MAX) root = UINT32_MAX;
    while (root * root > square)
        root--;
    while (root < UINT32_MAX && (root + 1) * (root + 1) <= square)
        root++;
    return root;
}

/* Sums of products modulo 2^64: a broken stream may let them overflow. */
static uint64_t dot(const int64_t a[3], const int64_t b[3])
{
    return (uint64_t)a[0] * (uint64_t)b[0] + (uint64_t)a[1] * (uint64_t)b[1] + (uint64_t)a[2] * (uint64_t)b[2];
}

static int64_t largest(const int64_t *values, int count)
{
    int64_t most = 0;
    for (int k = 0; k < count; k++)
        if (llabs(values[k]) > most) most = llabs(values[k]);
    return most;
}

/* Predicts the coordinates of a triangle's tip from those of its other corners n and p. All squares are scaled by the
 * square of the edge from n to p. False if numbers are too large. */
static bool predict_tip(const int32_t *tip, const int32_t *at_n, const int32_t *at_p, const int32_t *n,
                        const int32_t *p, struct sides *sides, int32_t out[2])
{
    int64_t edge[3], to_tip[3], rest[3];
    const int64_t edge_uv[2] = {(int64_t)p[0] - n[0], (int64_t)p[1] - n[1]}, n_uv[2] = {n[0], n[1]};
    for (int k = 0; k < 3; k++) {
        edge[k] = (int64_t)at_p[k] - at_n[k];
        to_tip[k] = (int64_t)tip[k] - at_n[k];
    }
    const uint64_t square = dot(edge, edge);
    const int64_t along = (int64_t)dot(edge, to_tip), scale = (int64_t)square;
    if (scale <= 0 || along == INT64_MIN || largest(n_uv, 2) > INT64_MAX / scale ||
        llabs(along) > INT64_MAX / largest(edge_uv, 2) || llabs(along) > INT64_MAX / largest(edge, 3) ||
        sides->count == 0)
        return false;
    for (int k = 0; k < 3; k++)
        rest[k] = (int64_t)((uint64_t)to_tip[k] - (uint64_t)(along * edge[k] / scale));
    const uint64_t across = find_root(dot(rest, rest) * square);
    const bool is_left = sides->are_left[--sides->count];
    for (int k = 0; k < 2; k++) {
        const uint64_t on_edge = (uint64_t)n_uv[k] * square + (uint64_t)along * (uint64_t)edge_uv[k],
                       beside = across * (uint64_t)(k == 0 ? edge_uv[1] : -edge_uv[0]);
        out[k] = (int32_t)(uint32_t)((int64_t)(is_left ? on_edge + beside : on_edge - beside) / scale);
    }
    return true;
}

static bool same(const int32_t *a, const int32_t *b, int count)
{
    for (int k = 0; k < count; k++)
        if (a[k] != b[k]) return false;
    return true;
}

/* Predicts value i at a corner. */
static bool predict(const struct zr_draco_values *of, const struct zr_draco_positions *positions, struct sides *sides,
                    uint32_t i, int32_t out[2])
{
    const struct zr_draco_order *order = of->order;
    const uint32_t corner = order->corners[i], next = order->values[order->of->vertices[zr_draco_next(corner)]],
                   previous = order->values[order->of->vertices[zr_draco_previous(corner)]];
    const int32_t *values = of->integers;
    if (next < i && previous < i) {
        const int32_t *at_n = positions->integers + 3 * (size_t)positions->of_value[next],
                      *at_p = positions->integers + 3 * (size_t)positions->of_value[previous],
                      *n = values + 2 * (size_t)next, *p = values + 2 * (size_t)previous;
        if (same(n, p, 2)) {
            out[0] = p[0];
            out[1] = p[1];
            return true;
        }
        if (!same(at_n, at_p, 3))
            return predict_tip(positions->integers + 3 * (size_t)positions->of_value[i], at_n, at_p, n, p, sides, out);
    }
    const int32_t *before = next < i ? values + 2 * (size_t)next : i > 0 ? values + 2 * (size_t)(i - 1) : NULL;
    out[0] = before ? before[0] : 0;
    out[1] = before ? before[1] : 0;
    return true;
}

bool zr_draco_predict_texcoords(struct zr_draco *draco, struct zr_draco_values *of,
                                const struct zr_draco_positions *positions)
{
    struct zr_draco_wrap wrap;
    struct sides sides;
    if (of->width != 2 || !read_sides(draco, of->order->count, &sides) || !zr_draco_wrap_read(&draco->stream, 2, &wrap))
        return false;
    for (uint32_t i = 0; i < of->order->count; i++) {
        int32_t predicted[2];
        if (zr_draco_stops(draco)) return false;
        if (!predict(of, positions, &sides, i, predicted)) return false;
        zr_draco_wrap_add(&wrap, predicted, of->integers + 2 * (size_t)i);
    }
    return true;
}
