/* The keys of a view. */
#include <string.h>

#include "input/json_objects.h"
#include "input/json_scene.h"
#include "input/json_view.h"

#define ANGLE_MAX    1e6 /* degrees: larger angles are taken for mistakes */
#define ROTATION_MAX 1e3 /* entries of R */
#define PIXELS_MAX   1e9 /* entries of K: far beyond any lens, and a finite float after division by a window's side */
#define PADDING_MAX  0.45

/* ---- values ---- */

/* double[9]: three rows of three numbers, or nine numbers row by row, as in OpenCV and ROS; magnitudes up to
 * field->high. */
static bool read_rows(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                      void *out)
{
    double m[9] = {0};
    bool nested;
    if (!zr_json_square(json, path, 3, field->high, m, &nested)) return false;
    memcpy(out, m, sizeof m);
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
                 .text = "the share of the window left free on each side"},
    [MESH] = {"mesh", zr_json_string, offsetof(struct given_fit, mesh), .otherwise = "all geometry",
              .text = "the name of the mesh whose instances are to fill the window"}};
const struct zr_json_object zr_json_object_fit = ZR_JSON_OBJECT_OF("fit", fit_fields);

static bool read_fit(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                     void *out)
{
    struct zr_parsed_view *given = out;
    struct given_fit fit = {given->view.fit_padding, NULL};
    uint64_t keys;
    (void)field;
    if (!zr_json_fields(json, path, &zr_json_object_fit, &fit, &keys)) return false;
    given->view.fit_padding = fit.padding;
    given->fit_mesh = fit.mesh;
    return true;
}

/* ---- keys ---- */

/* enum zr_convention */
static const char *const conventions[] = {"opengl", "opencv"};
static const struct zr_names convention_names = ZR_NAMES(2, conventions);

#define AT(member)   offsetof(struct zr_parsed_view, member)
#define VIEW(member) offsetof(struct zr_parsed_view, view.member)
const struct zr_json_field zr_view_fields[] = {
    [ZR_VIEW_EYE] = {"eye", zr_json_vec3, VIEW(eye), .unit = "scene units", .text = "where the camera is"},
    [ZR_VIEW_TARGET] = {"target", zr_json_vec3, VIEW(target), .unit = "scene units",
                        .text = "what the camera looks at"},
    [ZR_VIEW_UP] = {"up", zr_json_vec3, VIEW(up), .otherwise = "the scene's", .text = "what is up in the picture"},
    [ZR_VIEW_PRESET] = {"preset", zr_json_choice, AT(preset), .words = &zr_preset_names, .otherwise = "isometric",
                        .text = "a side to look from; the geometry fills the window"},
    [ZR_VIEW_DIRECTION] = {"direction", zr_json_vec3, VIEW(direction),
                           .text = "the way the camera looks; the geometry fills the window"},
    [ZR_VIEW_AZIMUTH_DEGREES] = {"azimuthDegrees", zr_json_number, VIEW(azimuth_degrees), -ANGLE_MAX, ANGLE_MAX,
                                 .unit = "degrees", .otherwise = "0",
                                 .text = "how far the camera has gone around the target, from the front to the right"},
    [ZR_VIEW_ELEVATION_DEGREES] = {"elevationDegrees", zr_json_number, VIEW(elevation_degrees), -90, 90,
                                   .unit = "degrees", .otherwise = "0",
                                   .text = "how far the camera is above the target"},
    [ZR_VIEW_DISTANCE] = {"distance", zr_json_positive, VIEW(distance), .unit = "scene units",
                          .otherwise = "so that the geometry fills the window",
                          .text = "of the camera from the target"},
    [ZR_VIEW_CAMERA_TO_WORLD] = {"cameraToWorld", zr_json_affine, AT(camera_to_world), .text = "the pose as a matrix"},
    [ZR_VIEW_WORLD_TO_CAMERA] = {"worldToCamera", zr_json_affine, VIEW(world_to_camera),
                                 .text = "the inverse of the pose as a matrix"},
    [ZR_VIEW_R] = {"R", read_rows, AT(r), 0, ROTATION_MAX, .text = "OpenCV's rotation from the world to the camera"},
    [ZR_VIEW_T] = {"t", zr_json_vec3, AT(t), .otherwise = "[0, 0, 0]",
                   .text = "OpenCV's translation, which goes with R"},
    [ZR_VIEW_CONVENTION] = {"convention", zr_json_choice, AT(convention), .words = &convention_names,
                            .otherwise = "opengl, and opencv with R",
                            .text = "which way the camera's axes go; opencv: y down, z into the picture"},
    [ZR_VIEW_PERSPECTIVE] = {"perspective", zr_read_perspective, 0, .object = &zr_json_object_perspective,
                             .text = "an angle of view"},
    [ZR_VIEW_ORTHOGRAPHIC] = {"orthographic", zr_read_orthographic, 0, .object = &zr_json_object_orthographic,
                              .text = "no vanishing point"},
    [ZR_VIEW_INTRINSICS] = {"intrinsics", zr_read_intrinsics, 0, .object = &zr_json_object_intrinsics,
                            .text = "a pinhole camera by its numbers"},
    [ZR_VIEW_K] = {"K", read_rows, AT(k), 0, PIXELS_MAX, .unit = "pixels", .text = "a pinhole camera as a 3x3 matrix"},
    [ZR_VIEW_PIXEL_CENTER] = {"pixelCenter", zr_json_number, AT(pixel_center), 0, 0.5, .unit = "pixels",
                              .otherwise = "0.5", .text = "where the middle of the first pixel is: 0 or 0.5"},
    [ZR_VIEW_PROJECTION_MATRIX] = {"projectionMatrix", zr_json_mat4, VIEW(projection_matrix),
                                   .text = "from the camera's space to OpenGL's clip space"},
    [ZR_VIEW_ZNEAR] = {"znear", zr_json_length, VIEW(znear), .unit = "scene units",
                       .otherwise = "just before the geometry", .text = "what is nearer is cut off"},
    [ZR_VIEW_ZFAR] = {"zfar", zr_json_length, VIEW(zfar), .unit = "scene units",
                      .otherwise = "just behind the geometry", .text = "what is farther is cut off"},
    [ZR_VIEW_FIT] = {"fit", read_fit, 0, .object = &zr_json_object_fit, .text = "how the geometry fills the window"},
    {.key = "name"},
    {.key = "window"}};
const struct zr_json_object zr_json_object_view = ZR_JSON_OBJECT_OF("view", zr_view_fields);

void zr_parsed_find_fit_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path)
{
    struct zr_view *view = &root->scene->views[0];
    const struct zr_json_path *fit = ZR_JSON_KEY(path, zr_view_fields[ZR_VIEW_FIT].key);
    view->fit_to_mesh =
        zr_parsed_find_mesh(root, ZR_JSON_KEY(fit, fit_fields[MESH].key), root->fit_mesh, &view->fit_mesh);
}
