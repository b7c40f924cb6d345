/* The keys of a view. */
#include <stdio.h>
#include <string.h>

#include "input/json/json_matrix.h"
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/text/recenter.h"
#include "input/view/view_keys.h"

#define ANGLE_MAX    1e6 /* degrees: larger angles are taken for mistakes */
#define ROTATION_MAX 1e3 /* entries of R */
#define PIXELS_MAX   1e9 /* entries of K: far beyond any lens, and a finite float after division by a window's side */
#define PADDING_MAX  0.45

/* ---- values ---- */

/* double[9]: three rows of three numbers, or nine numbers row by row, as in OpenCV and ROS; magnitudes up to
 * field->high. */
static bool read_rows(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double m[9] = {0};
    bool nested;
    if (!zr_json_square(json, path, 3, path->field->high, m, &nested)) return false;
    memcpy(out, m, sizeof m);
    return true;
}

/* zr_mat4. Subtracts the origin of a far scene in doubles. */
static bool read_camera_to_world(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_matrix exact;
    zr_mat4 *rounded = out;
    if (!zr_json_affine_exact(json, path, rounded, &exact)) return false;
    for (int axis = 0; json->far && axis < 3; axis++)
        rounded->m[12 + axis] = (float)(exact.m[12 + axis] - json->far->origin[axis]);
    return true;
}

/* zr_mat4, likewise. */
static bool read_world_to_camera(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_matrix exact;
    zr_mat4 *rounded = out;
    double at[4];
    if (!zr_json_affine_exact(json, path, rounded, &exact)) return false;
    if (!json->far) return true;
    const double *o = json->far->origin, origin[4] = {o[0], o[1], o[2], 1.0};
    zr_matrix_apply(&exact, origin, at);
    for (int axis = 0; axis < 3; axis++)
        rounded->m[12 + axis] = (float)at[axis];
    return true;
}

/* The mesh is a name here, since meshes may come later in the text. */
struct given_fit {
    float padding;
    const char *mesh;
};
enum { PADDING, MESH };
static const struct zr_json_field fit_fields[] = {
    [PADDING] = {"padding", zr_json_float, offsetof(struct given_fit, padding), 0, PADDING_MAX, .otherwise = "0.05",
                 .text = "share of the window left free on each side"},
    [MESH] = {"mesh", zr_json_string, offsetof(struct given_fit, mesh), .otherwise = "all geometry",
              .text = "name of the mesh to fit, with all its instances"}};
const struct zr_json_object zr_json_object_fit = ZR_JSON_OBJECT_OF("fit", fit_fields);

static bool read_fit(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_view *given = out;
    struct given_fit fit = {given->view.fit_padding, NULL};
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_fit, &fit, &keys)) return false;
    given->view.fit_padding = fit.padding;
    given->fit_mesh = fit.mesh;
    return true;
}

/* ---- cameras of model files ---- */

/* const char *: a name, or a number as text. */
static bool read_camera(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    enum { DIGITS = 12 };
    const enum zr_json_type type = zr_json_type(json);
    uint32_t number;
    if (type == ZR_JSON_STRING) return zr_json_string(json, path, out);
    if (type != ZR_JSON_NUMBER) return zr_json_expect(json, path, "the name or the number of a camera");
    if (!zr_json_index(json, path, UINT32_MAX, "cameras", &number)) return false;
    char *text = zr_arena_alloc(json->arena, DIGITS, 1);
    if (text) snprintf(text, DIGITS, "%u", number);
    *(const char **)out = text;
    return text != NULL;
}

/* ---- keys ---- */

/* enum zr_convention */
static const char *const conventions[] = {"opengl", "opencv"};
static const struct zr_names convention_names = ZR_NAMES(2, conventions);

#define AT(member)   offsetof(struct zr_parsed_view, member)
#define VIEW(member) offsetof(struct zr_parsed_view, view.member)
const struct zr_json_field zr_view_fields[] = {
    [ZR_VIEW_EYE] = {"eye", zr_json_place, VIEW(eye), .unit = "scene units", .text = "position of the camera"},
    [ZR_VIEW_TARGET] = {"target", zr_json_place, VIEW(target), .unit = "scene units",
                        .text = "point in the middle of the view"},
    [ZR_VIEW_UP] = {"up", zr_json_vec3, VIEW(up), .otherwise = "the scene's",
                    .text = "direction that points up in the picture"},
    [ZR_VIEW_PRESET] = {"preset", zr_json_choice, AT(preset), .words = &zr_preset_names, .otherwise = "isometric",
                        .text = "side of the camera; fits the geometry"},
    [ZR_VIEW_DIRECTION] = {"direction", zr_json_vec3, VIEW(direction), .text = "viewing direction; fits the geometry",
                           .schema = ZR_SCHEMA_OF("direction")},
    [ZR_VIEW_AZIMUTH_DEGREES] = {"azimuthDegrees", zr_json_number, VIEW(azimuth_degrees), -ANGLE_MAX, ANGLE_MAX,
                                 .unit = "degrees", .otherwise = "0",
                                 .text = "angle of the camera to the right of the front"},
    [ZR_VIEW_ELEVATION_DEGREES] = {"elevationDegrees", zr_json_number, VIEW(elevation_degrees), -90, 90,
                                   .unit = "degrees", .otherwise = "0",
                                   .text = "angle of the camera above the horizon"},
    [ZR_VIEW_DISTANCE] = {"distance", zr_json_positive, VIEW(distance), .unit = "scene units",
                          .otherwise = "fitted to the geometry", .text = "distance from the camera to the target"},
    [ZR_VIEW_CAMERA_TO_WORLD] = {"cameraToWorld", read_camera_to_world, AT(camera_to_world), .text = "pose as a matrix",
                                 .schema = ZR_SCHEMA_OF("affine")},
    [ZR_VIEW_WORLD_TO_CAMERA] = {"worldToCamera", read_world_to_camera, VIEW(world_to_camera),
                                 .text = "inverse of the pose as a matrix", .schema = ZR_SCHEMA_OF("affine")},
    [ZR_VIEW_R] = {"R", read_rows, AT(r), 0, ROTATION_MAX, .text = "OpenCV's rotation from the world to the camera",
                   .schema = ZR_SCHEMA_OF("rotation")},
    [ZR_VIEW_T] = {"t", zr_json_place3, AT(t), .otherwise = "[0, 0, 0]", .text = "OpenCV's translation, used with R"},
    [ZR_VIEW_CONVENTION] = {"convention", zr_json_choice, AT(convention), .words = &convention_names,
                            .otherwise = "opengl; with R opencv",
                            .text = "axes of the camera; opencv: y down, z forward"},
    [ZR_VIEW_PERSPECTIVE] = {"perspective", zr_read_perspective, 0, .object = &zr_json_object_perspective,
                             .text = "perspective projection by an angle of view"},
    [ZR_VIEW_ORTHOGRAPHIC] = {"orthographic", zr_read_orthographic, 0, .object = &zr_json_object_orthographic,
                              .text = "orthographic projection"},
    [ZR_VIEW_INTRINSICS] = {"intrinsics", zr_read_intrinsics, 0, .object = &zr_json_object_intrinsics,
                            .text = "pinhole camera: focal lengths and principal point"},
    [ZR_VIEW_K] = {"K", read_rows, AT(k), 0, PIXELS_MAX, .unit = "pixels", .text = "pinhole camera as a 3x3 matrix",
                   .schema = ZR_SCHEMA_OF("pinhole")},
    [ZR_VIEW_PIXEL_CENTER] = {"pixelCenter", zr_json_number, AT(pixel_center), 0, 0.5, .unit = "pixels",
                              .otherwise = "0.5", .text = "coordinate of the centre of the first pixel: 0 or 0.5",
                              .schema = ZR_SCHEMA({"enum" : [ 0, 0.5 ]})},
    [ZR_VIEW_PROJECTION_MATRIX] = {"projectionMatrix", zr_json_mat4, VIEW(projection_matrix),
                                   .text = "projection from eye space to OpenGL's clip space"},
    [ZR_VIEW_DISTORTION] = {"distortion", zr_read_distortion, VIEW(lens), .object = &zr_json_object_distortion,
                            .otherwise = "none",
                            .text = "distortion of the lens, also as the list k1, k2, p1, p2, k3, k4, k5, k6 of OpenCV",
                            .schema = ZR_SCHEMA(
                                {"anyOf" : [ {"$ref" : "#/$defs/coefficientList"}, {"$ref" : "#/$defs/distortion"} ]})},
    [ZR_VIEW_ZNEAR] = {"znear", zr_json_length, VIEW(znear), .unit = "scene units",
                       .otherwise = "just in front of the geometry", .text = "distance of the near plane"},
    [ZR_VIEW_ZFAR] = {"zfar", zr_json_length, VIEW(zfar), .unit = "scene units",
                      .otherwise = "just behind the geometry", .text = "distance of the far plane"},
    [ZR_VIEW_FIT] = {"fit", read_fit, 0, .object = &zr_json_object_fit, .text = "fit of the geometry to the window"},
    [ZR_VIEW_CAMERA] =
        {"camera", read_camera, AT(camera),
         .text = "name or number of a camera of a model file; a projection, znear and zfar override the camera's",
         .schema = ZR_SCHEMA({"anyOf" : [ {"type" : "string"}, {"$ref" : "#/$defs/index"} ]})},
    {.key = "name"},
    {.key = "window"}};
#define BIT(key)   ZR_KEY(ZR_VIEW_##key)
#define ORBIT      (BIT(AZIMUTH_DEGREES) | BIT(ELEVATION_DEGREES))
#define MATRICES   (BIT(CAMERA_TO_WORLD) | BIT(WORLD_TO_CAMERA))
#define POSES      (BIT(PRESET) | BIT(EYE) | BIT(DIRECTION) | ORBIT | MATRICES | BIT(R))
#define POSE_PARTS (BIT(TARGET) | BIT(UP) | BIT(DISTANCE) | BIT(T) | BIT(CONVENTION) | BIT(FIT))
#define TWO_POSES  .text = "two poses: %s and %s"
/* Two poses or projections are refused: to ignore one would draw a wrong picture without a message. */
static const struct zr_json_rule view_rules[] = {
    {ZR_RULE_APART, .text = "two views: %s and %s", .sets = {BIT(CAMERA), POSES | POSE_PARTS}},
    {ZR_RULE_APART, TWO_POSES,
     .sets = {BIT(PRESET), BIT(EYE), BIT(DIRECTION), ORBIT, BIT(CAMERA_TO_WORLD), BIT(WORLD_TO_CAMERA), BIT(R)}},
    {ZR_RULE_AGAINST, TWO_POSES, .sets = {BIT(PRESET) | MATRICES, BIT(TARGET) | BIT(DISTANCE) | BIT(T)}},
    {ZR_RULE_AGAINST, TWO_POSES, .sets = {BIT(EYE), BIT(DISTANCE) | BIT(T)}},
    {ZR_RULE_AGAINST, TWO_POSES, .sets = {BIT(DIRECTION), BIT(TARGET) | BIT(DISTANCE) | BIT(T)}},
    {ZR_RULE_AGAINST, TWO_POSES, .sets = {ORBIT, BIT(T)}},
    {ZR_RULE_AGAINST, TWO_POSES, .sets = {BIT(R), BIT(TARGET) | BIT(DISTANCE)}},
    {ZR_RULE_NEEDS, .text = "target needs eye or azimuthDegrees, which is missing",
     .sets = {BIT(TARGET), BIT(EYE) | ORBIT}},
    {ZR_RULE_NEEDS, .text = "distance needs azimuthDegrees or elevationDegrees, which is missing",
     .sets = {BIT(DISTANCE), ORBIT}},
    {ZR_RULE_NEEDS, .text = "t needs R, which is missing", .sets = {BIT(T), BIT(R)}},
    {ZR_RULE_NEEDS, .at_key = true, .text = "belongs to the poses eye, direction and azimuthDegrees only",
     .sets = {BIT(UP), BIT(EYE) | BIT(DIRECTION) | ORBIT}},
    {ZR_RULE_APART, .text = "two projections: %s and %s",
     .sets = {BIT(PERSPECTIVE), BIT(ORTHOGRAPHIC), BIT(INTRINSICS), BIT(K), BIT(PROJECTION_MATRIX)}},
    {ZR_RULE_NEEDS, .at_key = true, .text = "belongs to intrinsics and K only",
     .sets = {BIT(PIXEL_CENTER), BIT(INTRINSICS) | BIT(K)}},
    {ZR_RULE_AGAINST, .at_key = true, .text = "projectionMatrix sets the planes itself",
     .sets = {BIT(PROJECTION_MATRIX), BIT(ZNEAR) | BIT(ZFAR)}}};
/* clang-format off */
const struct zr_json_object zr_json_object_view = {ZR_JSON_FIELDS("view", zr_view_fields), ZR_JSON_RULES(view_rules),
    .schema = ZR_SCHEMA({
        "dependentSchemas": {
            "perspective": {"properties": {"znear": {"exclusiveMinimum": 0}, "zfar": {"exclusiveMinimum": 0}}},
            "intrinsics": {"properties": {"znear": {"exclusiveMinimum": 0}, "zfar": {"exclusiveMinimum": 0}}},
            "K": {"properties": {"znear": {"exclusiveMinimum": 0}, "zfar": {"exclusiveMinimum": 0}}},
            "orthographic": {"properties": {"distortion": {"maxItems": 0}}},
            "projectionMatrix": {"properties": {"distortion": {"maxItems": 0}}},
            "convention": {
                "if": {"properties": {"convention": {"const": "opencv"}}},
                "then": {"not": {"properties": {"cameraToWorld": false, "worldToCamera": false, "R": false}}}
            }
        }
    }),
    .examples = ZR_SCHEMA([
        {"preset": "front"}, {"azimuthDegrees": 35, "elevationDegrees": 20},
        {"eye": [3, 2, 4], "target": [0, 0, 0], "perspective": {"yfovDegrees": 40}},
        {"R": [[1, 0, 0], [0, -1, 0], [0, 0, -1]], "t": [0, 0, 2], "K": [[600, 0, 320], [0, 600, 240], [0, 0, 1]]}
    ])};
/* clang-format on */
#undef BIT
#undef ORBIT
#undef MATRICES
#undef POSES
#undef POSE_PARTS
#undef TWO_POSES

void zr_parsed_find_fit_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path)
{
    struct zr_view *view = &root->scene->views[0];
    const struct zr_json_path *fit = ZR_JSON_KEY(path, zr_view_fields[ZR_VIEW_FIT].key);
    view->fit_to_mesh =
        zr_parsed_find_mesh(root, ZR_JSON_KEY(fit, fit_fields[MESH].key), root->fit_mesh, &view->fit_mesh);
}
