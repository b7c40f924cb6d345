#include "input/text/recenter.h"

#include "base/vec.h"

bool zr_box_is_remote(const struct zr_box *box, double sizes)
{
    double size = 0.0, middle = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        size = fmax(size, box->high[axis] - box->low[axis]);
        middle = fmax(middle, fabs(box->low[axis] / 2.0 + box->high[axis] / 2.0));
    }
    return size > 0.0 && middle > sizes * size;
}

void zr_box_include_placed(struct zr_box *all, const struct zr_box *box, const struct zr_matrix *matrix)
{
    if (box->low[0] > box->high[0]) return;
    for (unsigned corner = 0; corner < 8; corner++) {
        const double v[4] = {corner & 1 ? box->high[0] : box->low[0], corner & 2 ? box->high[1] : box->low[1],
                             corner & 4 ? box->high[2] : box->low[2], 1};
        double out[4];
        zr_matrix_apply(matrix, v, out);
        zr_box_include(all, out);
    }
}

bool zr_recenter_is_remote(const zr_vec4 *positions, size_t count)
{
    enum { AT_ONCE = 64 };
    struct zr_box box = zr_box_empty();
    for (size_t i = 0; i < count; i++) {
        const double v[3] = {(double)positions[i].x, (double)positions[i].y, (double)positions[i].z};
        zr_box_include(&box, v);
        const bool has_size = box.low[0] < box.high[0] || box.low[1] < box.high[1] || box.low[2] < box.high[2];
        if (i % AT_ONCE == AT_ONCE - 1 && has_size && !zr_box_is_remote(&box, ZR_FAR_SIZES / 2.0)) return false;
    }
    return count > 0 && zr_box_is_remote(&box, ZR_FAR_SIZES);
}

enum zr_status zr_recenter_origin(struct zr_arena *arena, const struct zr_box *box, const struct zr_limits *limits,
                                  const double **origin, struct zr_error *error)
{
    const double limit = (double)limits->coordinate_max;
    bool is_far = false;
    *origin = NULL;
    for (int axis = 0; axis < 3; axis++) {
        const double low = box->low[axis], high = box->high[axis];
        if (low > high) return ZR_OK;
        is_far = is_far || low < -limit || high > limit;
        if ((high - low) / 2.0 > limit * ZR_FAR_HALF_EXTENTS)
            return zr_error_add(error, ZR_BAD_SCENE, NULL,
                                "the mesh extends from %.9g to %.9g along %c: more than %d times the coordinate limit "
                                "of %.9g on both sides of its middle",
                                low, high, "xyz"[axis], ZR_FAR_HALF_EXTENTS, limit);
    }
    if (!is_far && !zr_box_is_remote(box, ZR_FAR_SIZES)) return ZR_OK;
    double *middle = zr_arena_alloc(arena, 3, sizeof *middle);
    for (int axis = 0; middle && axis < 3; axis++)
        middle[axis] = box->low[axis] + (box->high[axis] - box->low[axis]) / 2.0;
    for (int axis = 0; middle && !is_far && axis < 3; axis++)
        middle[axis] = zr_rounded(middle[axis]);
    *origin = middle;
    return middle ? ZR_OK : ZR_NO_MEMORY;
}

/* Positions between two checks of `cancel`: less than a millisecond. */
enum { AT_ONCE = 1 << 14 };

enum zr_status zr_recenter_shift(const struct zr_run *run, const struct zr_limits *limits, zr_vec4 *positions,
                                 size_t count, const double **origin)
{
    struct zr_box box = zr_box_empty();
    for (size_t i = 0; i < count; i++) {
        const double v[3] = {(double)positions[i].x, (double)positions[i].y, (double)positions[i].z};
        if (i % AT_ONCE == 0 && zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
        zr_box_include(&box, v);
    }
    const enum zr_status status = zr_recenter_origin(run->arena, &box, limits, origin, run->error);
    for (size_t i = 0; status == ZR_OK && *origin && i < count; i++) {
        const double v[3] = {(double)positions[i].x, (double)positions[i].y, (double)positions[i].z};
        if (i % AT_ONCE == 0 && zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
        positions[i] = zr_recenter_position(v, *origin);
    }
    return status;
}
