/* Axes of the camera from a pose. */
#include <math.h>

#include "base/trig.h"
#include "scene/camera/camera_parts.h"
#include "scene/output.h"

/* Scales `v` to unit length. False if its length is at most `least`. */
static bool normalize(zr_dvec3 *v, double least)
{
    double length = sqrt(zr_dvec3_dot(*v, *v));
    if (!(length > least)) return false;
    *v = (zr_dvec3){v->x / length, v->y / length, v->z / length};
    return true;
}

static void preset_axes(enum zr_preset preset, struct zr_axes *axes)
{
    static const struct {
        zr_dvec3 back, up;
    } table[ZR_PRESET_COUNT] = {
        [ZR_PRESET_FRONT] = {{0, 0, 1}, {0, 1, 0}},    [ZR_PRESET_BACK] = {{0, 0, -1}, {0, 1, 0}},
        [ZR_PRESET_LEFT] = {{-1, 0, 0}, {0, 1, 0}},    [ZR_PRESET_RIGHT] = {{1, 0, 0}, {0, 1, 0}},
        [ZR_PRESET_TOP] = {{0, 1, 0}, {0, 0, -1}},     [ZR_PRESET_BOTTOM] = {{0, -1, 0}, {0, 0, 1}},
        [ZR_PRESET_ISOMETRIC] = {{1, 1, 1}, {0, 1, 0}}};
    axes->back = table[preset].back;
    normalize(&axes->back, 0.0);
    axes->right = zr_dvec3_cross(table[preset].up, axes->back);
    normalize(&axes->right, 0.0);
    axes->up = zr_dvec3_cross(axes->back, axes->right);
}

/* Completes the axes from `back`, of unit length, and the view's up. */
static enum zr_status upright_axes(const struct zr_view *view, struct zr_axes *axes, struct zr_error *error)
{
    zr_dvec3 up = zr_dvec3_of(view->up);
    axes->right = normalize(&up, 0.0) ? zr_dvec3_cross(up, axes->back) : up;
    if (!normalize(&axes->right, 1e-9))
        return zr_error_add(error, ZR_BAD_SCENE, "/view/up", "up is zero or along the line of sight");
    axes->up = zr_dvec3_cross(axes->back, axes->right);
    return ZR_OK;
}

static enum zr_status look_at_axes(const struct zr_view *view, struct zr_axes *axes, struct zr_error *error)
{
    axes->eye = zr_dvec3_of(view->eye);
    axes->back = zr_dvec3_sub(axes->eye, zr_dvec3_of(view->target));
    if (!normalize(&axes->back, 0.0))
        return zr_error_add(error, ZR_BAD_SCENE, "/view/eye",
                            "the eye is at the target: there is no direction to look in");
    return upright_axes(view, axes, error);
}

static enum zr_status direction_axes(const struct zr_view *view, struct zr_axes *axes, struct zr_error *error)
{
    axes->back = zr_dvec3_sub((zr_dvec3){0, 0, 0}, zr_dvec3_of(view->direction));
    if (!normalize(&axes->back, 0.0))
        return zr_error_add(error, ZR_BAD_SCENE, "/view/direction", "the direction is zero");
    return upright_axes(view, axes, error);
}

/* Shortest rotation of +y to a unit vector: v + a x v + (a x (a x v)) / (1 + cosine) with a = y x up, whose length is
 * the sine (Rodrigues' formula). */
struct turn {
    zr_dvec3 axis;
    double factor;
    bool half; /* up is -y: half a turn about x */
};

static struct turn turn_to(zr_dvec3 up)
{
    struct turn turn = {.axis = {up.z, 0.0, 0.0 - up.x}};
    double square = zr_dvec3_dot(turn.axis, turn.axis);
    turn.half = up.y < 0.0 && square == 0.0;
    /* 1 / (1 + cosine) cancels near a half turn, so it is computed as (1 - cosine) / sine^2 there. */
    turn.factor = up.y < 0.0 && square > 0.0 ? (1.0 - up.y) / square : 1.0 / (1.0 + fabs(up.y));
    return turn;
}

static zr_dvec3 turned(const struct turn *turn, zr_dvec3 v)
{
    if (turn->half) return (zr_dvec3){v.x, 0.0 - v.y, 0.0 - v.z};
    zr_dvec3 once = zr_dvec3_cross(turn->axis, v), twice = zr_dvec3_cross(turn->axis, once);
    return zr_dvec3_add_scaled(zr_dvec3_add_scaled(v, once, 1.0), twice, turn->factor);
}

/* Computes all axes from the angles, so that views from straight above need no special case. */
static enum zr_status orbit_axes(const struct zr_view *view, struct zr_axes *axes, struct zr_error *error)
{
    zr_dvec3 up = zr_dvec3_of(view->up);
    if (!normalize(&up, 0.0))
        return zr_error_add(error, ZR_BAD_SCENE, "/view/up", "up is zero: there is no axis to turn around");
    double sa, ca, se, ce;
    zr_sine_cosine(view->azimuth_degrees, &sa, &ca);
    zr_sine_cosine(view->elevation_degrees, &se, &ce);
    struct turn turn = turn_to(up);
    axes->right = turned(&turn, (zr_dvec3){ca, 0.0, 0.0 - sa});
    axes->up = turned(&turn, (zr_dvec3){0.0 - sa * se, ce, 0.0 - ca * se});
    axes->back = turned(&turn, (zr_dvec3){sa * ce, se, ca * ce});
    return ZR_OK;
}

enum zr_status zr_axes_of(const struct zr_view *view, struct zr_axes *axes, struct zr_error *error)
{
    *axes = (struct zr_axes){.eye = {0, 0, 0}};
    switch (view->pose) {
    case ZR_POSE_LOOK_AT:
        return look_at_axes(view, axes, error);
    case ZR_POSE_DIRECTION:
        return direction_axes(view, axes, error);
    case ZR_POSE_ORBIT:
        return orbit_axes(view, axes, error);
    case ZR_POSE_PRESET:
    case ZR_POSE_MATRIX:
        break;
    }
    preset_axes(view->preset, axes);
    return ZR_OK;
}

zr_mat4 zr_axes_to_matrix(const struct zr_axes *axes)
{
    const zr_dvec3 r = axes->right, u = axes->up, b = axes->back, eye = axes->eye;
    return (zr_mat4){{(float)r.x, (float)u.x, (float)b.x, 0.0f, (float)r.y, (float)u.y, (float)b.y, 0.0f, (float)r.z,
                      (float)u.z, (float)b.z, 0.0f, (float)-zr_dvec3_dot(r, eye), (float)-zr_dvec3_dot(u, eye),
                      (float)-zr_dvec3_dot(b, eye), 1.0f}};
}

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
           zr_view_wants(view, ZR_CHANNEL_THICKNESS) || zr_view_wants(view, ZR_CHANNEL_FRAGMENTS) || zr_view_picks(view) ||
           (zr_view_wants(view, ZR_CHANNEL_POSITION) && zr_view_space(view, ZR_CHANNEL_POSITION) == ZR_SPACE_CAMERA);
}

void zr_view_matrices_warn(struct zr_arena *arena, const struct zr_view *view, struct zr_warning_list *warnings)
{
    const zr_mat4 *m = &view->world_to_camera, *projection = &view->projection_matrix;
    const bool has_pose = view->pose == ZR_POSE_MATRIX, has_projection = view->projection == ZR_PROJECTION_MATRIX;
    const bool pose_mirrors = has_pose && zr_mat4_is_mirror(m),
               projection_mirrors = has_projection && zr_projection_is_mirror(projection);
    if (pose_mirrors && !projection_mirrors)
        zr_warning_list_add(arena, warnings,
                            "the camera's pose is a reflection (its determinant is negative): the picture is mirrored");
    if (projection_mirrors && !pose_mirrors)
        zr_warning_list_add(arena, warnings,
                            "projectionMatrix is a reflection, as matrices made for Vulkan are: the picture is "
                            "mirrored; to undo this, negate the row of y, or of x");
    if (has_projection && zr_projection_is_reversed(projection))
        zr_warning_list_add(arena, warnings,
                            "projectionMatrix gives farther points smaller depths (a reversed z): far faces hide "
                            "near ones");
    if (has_pose && zr_pose_matrix_scale(m) != 1.0 && measures_in_eye_space(view))
        zr_warning_list_add(
            arena, warnings,
            "the camera's pose is not a rotation: a length of 1 along its axes x, y and z becomes %.4g, "
            "%.4g and %.4g, so that depths, distances and positions in camera space are not in scene "
            "units",
            sqrt(row_product(m, 0, 0)), sqrt(row_product(m, 1, 1)), sqrt(row_product(m, 2, 2)));
}

void zr_pose_remove_scale(zr_mat4 *world_to_camera)
{
    const double scale = zr_pose_matrix_scale(world_to_camera);
    if (scale == 1.0 || scale == 0.0) return;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 3; row++)
            world_to_camera->m[column * 4 + row] = (float)((double)world_to_camera->m[column * 4 + row] / scale);
}
