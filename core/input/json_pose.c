/* The pose of a view: where the camera is, and which way it looks. */
#include "input/json_view.h"

#include <math.h>

/* How far R may be from a rotation: what four digits in a file may do, and no more. */
static const double ROTATION_TOLERANCE = 1e-3;

static const char *const conventions[] = {"opengl", "opencv"};
enum { OPENGL, OPENCV, CONVENTIONS };
static const struct zr_names convention_names = ZR_NAMES(CONVENTIONS, conventions);

/* ---- which pose is said ---- */

#define BIT(key) (1u << ZR_VIEW_##key)

/* What makes a pose is one of the keys `by`; the keys `with` may go with it. */
static const struct form {
    enum zr_pose pose;
    unsigned by, with;
} forms[] = {{ZR_POSE_PRESET, BIT(PRESET), 0},
             {ZR_POSE_LOOK_AT, BIT(EYE), BIT(TARGET) | BIT(UP)},
             {ZR_POSE_DIRECTION, BIT(DIRECTION), BIT(UP)},
             {ZR_POSE_ORBIT, BIT(AZIMUTH_DEGREES) | BIT(ELEVATION_DEGREES), BIT(TARGET) | BIT(UP) | BIT(DISTANCE)},
             {ZR_POSE_MATRIX, BIT(CAMERA_TO_WORLD), 0},
             {ZR_POSE_MATRIX, BIT(WORLD_TO_CAMERA), 0},
             {ZR_POSE_MATRIX, BIT(R), BIT(T)}};
enum { FORMS = sizeof forms / sizeof forms[0] };

static const struct part {
    enum zr_view_key key;
    const char *of;
} parts[] = {{ZR_VIEW_TARGET, "eye or azimuthDegrees"},
             {ZR_VIEW_DISTANCE, "azimuthDegrees or elevationDegrees"},
             {ZR_VIEW_T, "R"}};
enum { PARTS = sizeof parts / sizeof parts[0] };

static unsigned said(const struct zr_view_reader *reader, unsigned mask)
{
    unsigned bits = 0;
    for (unsigned key = 0; key < ZR_VIEW_KEYS; key++)
        if (reader->found[key]) bits |= 1u << key;
    return bits & mask;
}

static const char *first_word(unsigned bits)
{
    int key = 0;
    while (!(bits >> key & 1u))
        key++;
    return zr_view_words[key];
}

/* The one form that is said, or NULL: none is, or more than one, which is reported. */
static const struct form *find_form(struct zr_view_reader *reader)
{
    const struct form *form = NULL;
    bool many = false;
    for (int i = 0; i < FORMS; i++) {
        if (!said(reader, forms[i].by)) continue;
        if (form) {
            many = true;
            zr_json_fault(reader->json, reader->path, "two poses: %s and %s", first_word(said(reader, form->by)),
                          first_word(said(reader, forms[i].by)));
        } else {
            form = &forms[i];
        }
    }
    if (many) return NULL;
    for (int i = 0; i < PARTS; i++) {
        if (!reader->found[parts[i].key] || (form && form->with >> parts[i].key & 1u)) continue;
        const char *word = zr_view_words[parts[i].key];
        if (form)
            zr_json_fault(reader->json, reader->path, "two poses: %s and %s", first_word(said(reader, form->by)), word);
        else
            zr_json_fault(reader->json, reader->path, "%s needs %s, which is missing", word, parts[i].of);
    }
    if (reader->found[ZR_VIEW_UP] && !(form && form->with & BIT(UP)))
        zr_json_fault(reader->json, ZR_VIEW_PATH(reader, ZR_VIEW_UP),
                      "belongs to the poses eye, direction and azimuthDegrees only");
    return form;
}

/* ---- poses made of numbers ---- */

static bool read_vec3(struct zr_view_reader *reader, enum zr_view_key key, zr_vec3 *out)
{
    return reader->found[key] && zr_json_vec3(reader->json, ZR_VIEW_PATH(reader, key), reader->found[key], out);
}

static void read_preset(struct zr_view_reader *reader)
{
    int preset = 0;
    zr_json_choice(reader->json, ZR_VIEW_PATH(reader, ZR_VIEW_PRESET), reader->found[ZR_VIEW_PRESET], &zr_preset_names,
                   &preset);
    reader->view->preset = (enum zr_preset)preset;
}

/* Straight up and down there is no y in the picture to be up: where nobody says what is, it
 * is as in the presets top and bottom. */
static void read_direction(struct zr_view_reader *reader)
{
    struct zr_view *view = reader->view;
    if (!read_vec3(reader, ZR_VIEW_DIRECTION, &view->direction)) return;
    zr_vec3 d = view->direction;
    if (!reader->found[ZR_VIEW_UP] && d.x == 0.0f && d.z == 0.0f) view->up = (zr_vec3){0, 0, d.y < 0.0f ? -1.0f : 1.0f};
    if (d.x == 0.0f && d.y == 0.0f && d.z == 0.0f)
        zr_json_fault(reader->json, ZR_VIEW_PATH(reader, ZR_VIEW_DIRECTION),
                      "the direction is zero: there is none to look in");
}

static void read_angle(struct zr_view_reader *reader, enum zr_view_key key, double most, double *out)
{
    if (reader->found[key])
        zr_json_number(reader->json, ZR_VIEW_PATH(reader, key), reader->found[key], -most, most, out);
}

static void read_orbit(struct zr_view_reader *reader)
{
    struct zr_view *view = reader->view;
    read_angle(reader, ZR_VIEW_AZIMUTH_DEGREES, 1e6, &view->azimuth_degrees);
    read_angle(reader, ZR_VIEW_ELEVATION_DEGREES, 90, &view->elevation_degrees);
    view->has_target = read_vec3(reader, ZR_VIEW_TARGET, &view->target);
    if (reader->found[ZR_VIEW_DISTANCE])
        zr_json_positive(reader->json, ZR_VIEW_PATH(reader, ZR_VIEW_DISTANCE), reader->found[ZR_VIEW_DISTANCE],
                         &view->distance);
}

/* ---- poses given as matrices ---- */

static bool read_matrix(struct zr_view_reader *reader, enum zr_view_key key, zr_mat4 *out)
{
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, key);
    zr_mat4 inverse;
    if (!zr_json_affine(reader->json, path, reader->found[key], out)) return false;
    return zr_mat4_invert(out, &inverse) || zr_json_fault(reader->json, path, "the matrix has no inverse");
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

/* X_camera = R X_world + t, as OpenCV has it. */
static void read_rotation(struct zr_view_reader *reader, zr_mat4 *out)
{
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, ZR_VIEW_R);
    double r[9];
    zr_vec3 t = {0, 0, 0};
    read_vec3(reader, ZR_VIEW_T, &t);
    if (!zr_view_read_rows(reader->json, path, reader->found[ZR_VIEW_R], 1e3, r)) return;
    if (!check_rotation(reader->json, path, r)) return;
    *out = (zr_mat4){{(float)r[0], (float)r[3], (float)r[6], 0, (float)r[1], (float)r[4], (float)r[7], 0, (float)r[2],
                      (float)r[5], (float)r[8], 0, t.x, t.y, t.z, 1}};
}

/* From OpenCV's camera (y down, looks along +z) to OpenGL's: the rows y and z change sign.
 * Subtracted from zero, so that no zero becomes -0. */
static void flip_camera(zr_mat4 *world_to_camera)
{
    for (int column = 0; column < 4; column++)
        for (int row = 1; row <= 2; row++)
            world_to_camera->m[column * 4 + row] = 0.0f - world_to_camera->m[column * 4 + row];
}

static void read_matrices(struct zr_view_reader *reader, int convention)
{
    zr_mat4 *out = &reader->view->world_to_camera, camera_to_world;
    if (reader->found[ZR_VIEW_WORLD_TO_CAMERA]) read_matrix(reader, ZR_VIEW_WORLD_TO_CAMERA, out);
    if (reader->found[ZR_VIEW_R]) read_rotation(reader, out);
    if (reader->found[ZR_VIEW_CAMERA_TO_WORLD] && read_matrix(reader, ZR_VIEW_CAMERA_TO_WORLD, &camera_to_world))
        zr_mat4_invert(&camera_to_world, out);
    if (convention == OPENCV) flip_camera(out);
}

static int read_convention(struct zr_view_reader *reader, bool matrices)
{
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, ZR_VIEW_CONVENTION);
    const cJSON *node = reader->found[ZR_VIEW_CONVENTION];
    int convention = reader->found[ZR_VIEW_R] ? OPENCV : OPENGL;
    if (node && zr_json_choice(reader->json, path, node, &convention_names, &convention) && convention == OPENCV &&
        !matrices)
        zr_json_fault(reader->json, path,
                      "opencv belongs to cameraToWorld, worldToCamera and R: no other pose has axes to be told apart");
    return convention;
}

void zr_view_read_pose(struct zr_view_reader *reader)
{
    struct zr_view *view = reader->view;
    const struct form *form = find_form(reader);
    int convention = read_convention(reader, said(reader, BIT(CAMERA_TO_WORLD) | BIT(WORLD_TO_CAMERA) | BIT(R)) != 0);
    if (!form) {
        if (!reader->found[ZR_VIEW_PROJECTION_MATRIX]) return;
        view->pose = ZR_POSE_MATRIX; /* as in OpenGL: it alone leads from the world to clip space */
        view->world_to_camera = zr_mat4_identity();
        return;
    }
    view->pose = form->pose;
    if (view->pose != ZR_POSE_PRESET) read_vec3(reader, ZR_VIEW_UP, &view->up);
    switch (view->pose) {
    case ZR_POSE_PRESET:
        read_preset(reader);
        break;
    case ZR_POSE_DIRECTION:
        read_direction(reader);
        break;
    case ZR_POSE_ORBIT:
        read_orbit(reader);
        break;
    case ZR_POSE_MATRIX:
        read_matrices(reader, convention);
        break;
    case ZR_POSE_LOOK_AT:
        read_vec3(reader, ZR_VIEW_EYE, &view->eye);
        read_vec3(reader, ZR_VIEW_TARGET, &view->target);
        break;
    }
}
