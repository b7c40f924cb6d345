/* Predicts normals of Draco meshes: the sum of the normals of a vertex's faces, times their areas. */
#include "input/codecs/draco_mesh.h"

static const int32_t *position_at(const struct zr_draco_order *order, const struct zr_draco_positions *positions,
                                  uint32_t corner)
{
    const uint32_t value = order->values[order->of->vertices[corner]];
    return positions->integers + 3 * (size_t)positions->of_value[value];
}

/* Adds the cross product of two edges, modulo 2^64: a broken stream may let it overflow. */
static void add_cross(const int32_t *at, const int32_t *next, const int32_t *previous, uint64_t sum[3])
{
    uint64_t a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = (uint64_t)((int64_t)next[k] - at[k]);
        b[k] = (uint64_t)((int64_t)previous[k] - at[k]);
    }
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        sum[k] += a[l] * b[m] - a[m] * b[l];
    }
}

static uint64_t magnitude(int64_t value)
{
    return value < 0 ? 0 - (uint64_t)value : (uint64_t)value;
}

/* Returns the corner after `at` in the faces around `start`: to the left, and from a boundary to the right of it. */
static uint32_t go_around(const struct zr_draco_corners *of, uint32_t start, uint32_t at, bool *to_right)
{
    if (*to_right) return zr_draco_right(of, at);
    const uint32_t left = zr_draco_left(of, at);
    if (left == start) return ZR_DRACO_NONE;
    *to_right = left == ZR_DRACO_NONE;
    return *to_right ? zr_draco_right(of, start) : left;
}

/* Sums the normals of the faces around a corner, scaled down to magnitudes of at most 2^29. False if cancelled. */
static bool sum_normals(struct zr_draco *draco, const struct zr_draco_order *order,
                        const struct zr_draco_positions *positions, uint32_t corner, int32_t out[3])
{
    enum { SUM_MOST = 1 << 29 };
    const int32_t *at = position_at(order, positions, corner);
    uint64_t sum[3] = {0, 0, 0}, length = 0;
    bool to_right = false;
    for (uint32_t c = corner; c != ZR_DRACO_NONE; c = go_around(order->of, corner, c, &to_right)) {
        if (zr_draco_stops(draco)) return false;
        add_cross(at, position_at(order, positions, zr_draco_next(c)),
                  position_at(order, positions, zr_draco_previous(c)), sum);
    }
    for (int k = 0; k < 3; k++) {
        const uint64_t next = magnitude((int64_t)sum[k]);
        length = length > INT64_MAX - (next <= INT64_MAX ? next : INT64_MAX) ? INT64_MAX : length + next;
    }
    const int64_t factor = length > SUM_MOST ? (int64_t)(length / SUM_MOST) : 1;
    for (int k = 0; k < 3; k++)
        out[k] = (int32_t)((int64_t)sum[k] / factor);
    return true;
}

bool zr_draco_predict_normals(struct zr_draco *draco, struct zr_draco_values *of, bool is_canonical,
                              const struct zr_draco_positions *positions)
{
    const struct zr_draco_order *order = of->order;
    struct zr_draco_octahedron octahedron;
    struct zr_draco_flags flips;
    if (!zr_draco_octahedron_read(&draco->stream, is_canonical, &octahedron) ||
        !zr_draco_flags_open(&draco->stream, &flips))
        return false;
    for (uint32_t i = 0; i < order->count && !flips.is_broken; i++) {
        int32_t direction[3], predicted[2];
        if (!sum_normals(draco, order, positions, order->corners[i], direction)) return false;
        zr_draco_octahedron_point(&octahedron, zr_draco_flags_next(&flips), direction, predicted);
        zr_draco_octahedron_add(&octahedron, predicted, of->integers + 2 * (size_t)i);
    }
    return !flips.is_broken;
}
