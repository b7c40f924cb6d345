#include "scene/pose_matrix.h"

#include <math.h>

/* Tolerance of lengths and cosines. */
static const double TOLERANCE = 1e-3;

static double row_product(const zr_mat4 *m, int a, int b)
{
    double sum = 0.0;
    for (int column = 0; column < 3; column++)
        sum += (double)m->m[4 * column + a] * (double)m->m[4 * column + b];
    return sum;
}

double zr_pose_matrix_scale(const zr_mat4 *m)
{
    const double square = (row_product(m, 0, 0) + row_product(m, 1, 1) + row_product(m, 2, 2)) / 3.0;
    const double scale = sqrt(square);
    for (int a = 0; a < 3; a++) {
        if (!(fabs(sqrt(row_product(m, a, a)) - scale) <= TOLERANCE * scale)) return 0.0;
        for (int b = a + 1; b < 3; b++)
            if (!(fabs(row_product(m, a, b)) <= TOLERANCE * square)) return 0.0;
    }
    return fabs(scale - 1.0) <= TOLERANCE ? 1.0 : scale;
}

/* True if an output holds eye-space lengths or positions. */
static bool measures_in_eye_space(const struct zr_view *view)
{
    return zr_view_wants(view, ZR_CHANNEL_DEPTH) || zr_view_wants(view, ZR_CHANNEL_DISTANCE) ||
           zr_view_wants(view, ZR_CHANNEL_THICKNESS) || zr_view_wants(view, ZR_CHANNEL_FRAGMENTS) ||
           (zr_view_wants(view, ZR_CHANNEL_POSITION) && zr_view_space(view, ZR_CHANNEL_POSITION) == ZR_SPACE_CAMERA);
}

void zr_pose_matrix_warn(struct zr_arena *arena, const struct zr_view *view, struct zr_warning_list *warnings)
{
    const zr_mat4 *m = &view->world_to_camera;
    if (view->pose != ZR_POSE_MATRIX) return;
    if (zr_mat4_is_mirror(m))
        zr_warning_list_add(arena, warnings,
                            "the camera's pose is a reflection (its determinant is negative): the picture is mirrored");
    if (zr_pose_matrix_scale(m) != 1.0 && measures_in_eye_space(view))
        zr_warning_list_add(
            arena, warnings,
            "the camera's pose is not a rotation: a length of 1 along its axes x, y and z becomes %.4g, "
            "%.4g and %.4g, so that depths, distances and positions in camera space are not in scene "
            "units",
            sqrt(row_product(m, 0, 0)), sqrt(row_product(m, 1, 1)), sqrt(row_product(m, 2, 2)));
}
