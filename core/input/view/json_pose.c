/* The pose of a view: the position and the orientation of the camera. */
#include "input/view/view_keys.h"

#include <math.h>

#include "input/text/recenter.h"
#include "scene/camera/camera.h"
#include "scene/camera/upright.h"

/* Deviation of R from a rotation: enough for four digits in a file. */
static const double ROTATION_TOLERANCE = 1e-3;

/* ---- the form of the pose ---- */

#define BIT(key) (1u << ZR_VIEW_##key)

/* The keys that select a form of a pose. */
static const struct form {
    enum zr_pose pose;
    unsigned by;
} forms[] = {{ZR_POSE_PRESET, BIT(PRESET)},
             {ZR_POSE_LOOK_AT, BIT(EYE)},
             {ZR_POSE_DIRECTION, BIT(DIRECTION)},
             {ZR_POSE_ORBIT, BIT(AZIMUTH_DEGREES) | BIT(ELEVATION_DEGREES)},
             {ZR_POSE_MATRIX, BIT(CAMERA_TO_WORLD) | BIT(WORLD_TO_CAMERA) | BIT(R)}};
enum { FORMS = sizeof forms / sizeof forms[0] };

static bool gives_any(const struct zr_parsed_view *given, unsigned mask)
{
    return (given->keys & mask) != 0;
}

/* Returns the form that the keys select, or NULL. */
static const struct form *find_form(const struct zr_parsed_view *given)
{
    for (int i = 0; i < FORMS; i++)
        if (gives_any(given, forms[i].by)) return &forms[i];
    return NULL;
}

/* ---- each pose ---- */

/* A view straight up or down cannot have y up. Without the key `up`, it has the up of the presets top and bottom. */
static void find_up(struct zr_parsed_view *given)
{
    const zr_vec3 d = zr_view_looks_along(&given->view);
    if (!zr_view_gives(given, ZR_VIEW_UP) && d.x == 0.0f && d.z == 0.0f && d.y != 0.0f)
        given->view.up = (zr_vec3){0, 0, d.y < 0.0f ? -1.0f : 1.0f};
}

static void check_direction(struct zr_parsed_view *given)
{
    const zr_vec3 d = given->view.direction;
    if (d.x == 0.0f && d.y == 0.0f && d.z == 0.0f)
        zr_json_fault(given->json, ZR_VIEW_PATH(given, ZR_VIEW_DIRECTION), "the direction is zero");
}

static bool check_inverse(struct zr_parsed_view *given, enum zr_view_key key, const zr_mat4 *matrix, zr_mat4 *inverse)
{
    return zr_mat4_invert(matrix, inverse) ||
           zr_json_fault(given->json, ZR_VIEW_PATH(given, key), "the matrix has no inverse");
}

static bool check_rotation(struct zr_json *json, const struct zr_json_path *path, const double r[9])
{
    for (int i = 0; i < 3; i++)
        for (int k = i; k < 3; k++) {
            const double *a = &r[3 * i], *b = &r[3 * k];
            double product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            if (i == k ? fabs(sqrt(product) - 1.0) <= ROTATION_TOLERANCE : fabs(product) <= ROTATION_TOLERANCE)
                continue;
            if (i == k)
                return zr_json_fault(json, path, "not a rotation: row %d has the length %.6g, not 1", i, sqrt(product));
            return zr_json_fault(json, path, "not a rotation: rows %d and %d are not at right angles", i, k);
        }
    double determinant =
        r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]);
    return determinant > 0.0 ||
           zr_json_fault(json, path, "not a rotation but a reflection: its determinant is negative");
}

/* X_camera = R X_world + t, as in OpenCV. `far`: X_world is relative to its origin; or NULL. */
static zr_mat4 matrix_of(const double r[9], const double given[3], const struct zr_far *far)
{
    double t[3] = {given[0], given[1], given[2]};
    for (int i = 0; far && i < 3; i++)
        t[i] += r[3 * i] * far->origin[0] + r[3 * i + 1] * far->origin[1] + r[3 * i + 2] * far->origin[2];
    return (zr_mat4){{(float)r[0], (float)r[3], (float)r[6], 0, (float)r[1], (float)r[4], (float)r[7], 0, (float)r[2],
                      (float)r[5], (float)r[8], 0, (float)t[0], (float)t[1], (float)t[2], 1}};
}

/* Converts from OpenCV's camera (y down, looks along +z) to OpenGL's: the rows y and z change sign. Subtraction from
 * zero avoids -0. */
static void flip_camera(zr_mat4 *world_to_camera)
{
    for (int column = 0; column < 4; column++)
        for (int row = 1; row <= 2; row++)
            world_to_camera->m[column * 4 + row] = 0.0f - world_to_camera->m[column * 4 + row];
}

static void find_matrix(struct zr_parsed_view *given)
{
    zr_mat4 *out = &given->view.world_to_camera, inverse;
    if (zr_view_gives(given, ZR_VIEW_WORLD_TO_CAMERA)) check_inverse(given, ZR_VIEW_WORLD_TO_CAMERA, out, &inverse);
    if (zr_view_gives(given, ZR_VIEW_R) && check_rotation(given->json, ZR_VIEW_PATH(given, ZR_VIEW_R), given->r))
        *out = matrix_of(given->r, given->t, given->json->far);
    if (zr_view_gives(given, ZR_VIEW_CAMERA_TO_WORLD))
        check_inverse(given, ZR_VIEW_CAMERA_TO_WORLD, &given->camera_to_world, out);
    if (given->convention == ZR_CONVENTION_OPENCV) flip_camera(out);
    if (!zr_view_gives(given, ZR_VIEW_PROJECTION_MATRIX)) zr_pose_remove_scale(out);
}

static void check_convention(struct zr_parsed_view *given)
{
    const bool matrices = gives_any(given, BIT(CAMERA_TO_WORLD) | BIT(WORLD_TO_CAMERA) | BIT(R));
    if (!zr_view_gives(given, ZR_VIEW_CONVENTION))
        given->convention = zr_view_gives(given, ZR_VIEW_R) ? ZR_CONVENTION_OPENCV : ZR_CONVENTION_OPENGL;
    else if (given->convention == ZR_CONVENTION_OPENCV && !matrices)
        zr_json_fault(given->json, ZR_VIEW_PATH(given, ZR_VIEW_CONVENTION),
                      "opencv belongs to cameraToWorld, worldToCamera and R: other poses have no convention");
}

void zr_view_find_pose(struct zr_parsed_view *given)
{
    struct zr_view *view = &given->view;
    const struct form *form = find_form(given);
    check_convention(given);
    if (!form) {
        if (!zr_view_gives(given, ZR_VIEW_PROJECTION_MATRIX)) return;
        view->pose = ZR_POSE_MATRIX; /* as in OpenGL: projectionMatrix alone maps the world to clip space */
        view->world_to_camera = zr_mat4_identity();
        for (int axis = 0; given->json->far && axis < 3; axis++)
            view->world_to_camera.m[12 + axis] = (float)given->json->far->origin[axis];
        return;
    }
    view->pose = form->pose;
    view->preset = (enum zr_preset)given->preset;
    if (given->json->far && view->pose == ZR_POSE_LOOK_AT && !zr_view_gives(given, ZR_VIEW_TARGET))
        view->target = zr_far_place(given->json->far, (const double[]){0, 0, 0});
    view->has_target = view->pose == ZR_POSE_ORBIT && zr_view_gives(given, ZR_VIEW_TARGET);
    find_up(given);
    if (view->pose == ZR_POSE_DIRECTION) check_direction(given);
    if (view->pose == ZR_POSE_MATRIX) find_matrix(given);
}
