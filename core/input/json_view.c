/* A view is one pose and one projection. Two of a kind are refused by name: to
 * follow one and drop the other would draw a wrong picture without a word. */
#include "input/defaults.h"
#include "input/json_scene.h"

#include <string.h>

#define PI 3.14159265358979323846

enum {
    EYE,
    TARGET,
    UP,
    PRESET,
    CAMERA_TO_WORLD,
    WORLD_TO_CAMERA,
    PERSPECTIVE,
    ORTHOGRAPHIC,
    PROJECTION_MATRIX,
    ZNEAR,
    ZFAR,
    FIT,
    CONVENTION,
    KEYS
};
static const char *const words[] = {"eye",
                                    "target",
                                    "up",
                                    "preset",
                                    "cameraToWorld",
                                    "worldToCamera",
                                    "perspective",
                                    "orthographic",
                                    "projectionMatrix",
                                    "znear",
                                    "zfar",
                                    "fit",
                                    "convention",
                                    "direction",
                                    "azimuthDegrees",
                                    "elevationDegrees",
                                    "distance",
                                    "intrinsics",
                                    "K",
                                    "R",
                                    "t",
                                    "pixelCenter",
                                    "name",
                                    "window"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

static const char *const conventions[] = {"opengl", "opencv"};
static const struct zr_names convention_names = ZR_NAMES(1, conventions);

struct reader {
    struct zr_json *json;
    const struct zr_json_path *path;
    const cJSON *found[KEYS];
    struct zr_view *view;
};

/* Reports each further one of the keys, beside the first that is there. False
 * where there was more than one. */
static bool at_most_one(struct reader *reader, const int *candidates, size_t count, const char *what)
{
    int first = -1;
    bool good = true;
    for (size_t i = 0; i < count; i++) {
        if (!reader->found[candidates[i]]) continue;
        if (first < 0)
            first = candidates[i];
        else
            good = zr_json_fault(reader->json, reader->path, "two %s: %s and %s", what, words[first],
                                 words[candidates[i]]);
    }
    return good;
}

static void read_look_at(struct reader *reader)
{
    struct zr_view *view = reader->view;
    view->pose = ZR_POSE_LOOK_AT;
    if (!reader->found[EYE])
        zr_json_fault(reader->json, reader->path, "target needs eye, which is missing");
    else
        zr_json_vec3(reader->json, ZR_JSON_KEY(reader->path, words[EYE]), reader->found[EYE], &view->eye);
    if (reader->found[TARGET])
        zr_json_vec3(reader->json, ZR_JSON_KEY(reader->path, words[TARGET]), reader->found[TARGET], &view->target);
    if (reader->found[UP])
        zr_json_vec3(reader->json, ZR_JSON_KEY(reader->path, words[UP]), reader->found[UP], &view->up);
}

static bool read_pose_matrix(struct reader *reader, int key, zr_mat4 *out)
{
    const struct zr_json_path *path = ZR_JSON_KEY(reader->path, words[key]);
    zr_mat4 inverse;
    reader->view->pose = ZR_POSE_MATRIX;
    if (!zr_json_affine(reader->json, path, reader->found[key], out)) return false;
    return zr_mat4_invert(out, &inverse) || zr_json_fault(reader->json, path, "the matrix has no inverse");
}

static void read_camera_to_world(struct reader *reader)
{
    zr_mat4 matrix;
    if (read_pose_matrix(reader, CAMERA_TO_WORLD, &matrix)) zr_mat4_invert(&matrix, &reader->view->world_to_camera);
}

static void read_pose(struct reader *reader)
{
    static const int poses[] = {PRESET, EYE, CAMERA_TO_WORLD, WORLD_TO_CAMERA};
    static const int poses_by_target[] = {PRESET, TARGET, CAMERA_TO_WORLD, WORLD_TO_CAMERA};
    const cJSON *const *found = reader->found;
    bool look_at = found[EYE] || found[TARGET];
    if (!at_most_one(reader, found[EYE] ? poses : poses_by_target, 4, "poses")) return;
    if (found[UP] && !look_at)
        zr_json_fault(reader->json, ZR_JSON_KEY(reader->path, words[UP]), "belongs to the pose eye and target only");
    if (look_at) read_look_at(reader);
    if (found[PRESET]) {
        int preset = 0;
        zr_json_choice(reader->json, ZR_JSON_KEY(reader->path, words[PRESET]), found[PRESET], &zr_preset_names,
                       &preset);
        reader->view->preset = (enum zr_preset)preset;
    }
    if (found[CAMERA_TO_WORLD]) read_camera_to_world(reader);
    if (found[PROJECTION_MATRIX] && !look_at && !found[PRESET] && !found[CAMERA_TO_WORLD] && !found[WORLD_TO_CAMERA]) {
        reader->view->pose = ZR_POSE_MATRIX; /* as in OpenGL: it alone leads from the world to clip space */
        reader->view->world_to_camera = zr_mat4_identity();
    }
    if (found[WORLD_TO_CAMERA]) read_pose_matrix(reader, WORLD_TO_CAMERA, &reader->view->world_to_camera);
}

static float radians(double degrees)
{
    return (float)(degrees * PI / 180);
}

static void read_perspective(struct reader *reader)
{
    enum { YFOV, YFOV_DEGREES, PERSPECTIVE_KEYS };
    static const char *const members[] = {"yfov", "yfovDegrees", "xfov", "xfovDegrees"};
    static const struct zr_names names = ZR_NAMES(PERSPECTIVE_KEYS, members);
    struct zr_json *json = reader->json;
    const struct zr_json_path *path = ZR_JSON_KEY(reader->path, words[PERSPECTIVE]);
    const cJSON *found[PERSPECTIVE_KEYS];
    size_t faults = json->error->count;
    reader->view->projection = ZR_PROJECTION_PERSPECTIVE;
    if (!zr_json_object(json, path, reader->found[PERSPECTIVE], &names, found)) return;
    if (found[YFOV] && found[YFOV_DEGREES])
        zr_json_fault(json, path, "two angles: yfov and yfovDegrees");
    else if (found[YFOV] || found[YFOV_DEGREES]) {
        int key = found[YFOV] ? YFOV : YFOV_DEGREES;
        const struct zr_json_path *at = ZR_JSON_KEY(path, members[key]);
        double angle;
        if (!zr_json_number(json, at, found[key], 0, found[YFOV] ? PI : 180, &angle)) return;
        float yfov = found[YFOV] ? (float)angle : radians(angle);
        /* As floats: one that rounds to 0 or a half turn has no tangent to divide by. */
        if (!(yfov > 0.0f) || !(yfov < (float)PI))
            zr_json_fault(json, at, "%.9g: an angle between 0 and 180 degrees, both excluded, is needed", angle);
        reader->view->yfov_radians = yfov;
    } else if (json->error->count == faults) {
        zr_json_fault(json, path, "yfov or yfovDegrees is missing");
    }
}

static void read_orthographic(struct reader *reader)
{
    enum { XMAG, YMAG, ORTHOGRAPHIC_KEYS };
    static const char *const members[] = {"xmag", "ymag"};
    static const struct zr_names names = ZR_NAMES(ORTHOGRAPHIC_KEYS, members);
    struct zr_json *json = reader->json;
    const struct zr_json_path *path = ZR_JSON_KEY(reader->path, words[ORTHOGRAPHIC]);
    const cJSON *found[ORTHOGRAPHIC_KEYS];
    reader->view->projection = ZR_PROJECTION_ORTHOGRAPHIC;
    if (!zr_json_object(json, path, reader->found[ORTHOGRAPHIC], &names, found)) return;
    if (!found[XMAG] != !found[YMAG])
        zr_json_fault(json, path, "%s is missing; give xmag and ymag, or neither to fit the geometry",
                      found[XMAG] ? "ymag" : "xmag");
    if (found[XMAG]) zr_json_positive(json, ZR_JSON_KEY(path, members[XMAG]), found[XMAG], &reader->view->xmag);
    if (found[YMAG]) zr_json_positive(json, ZR_JSON_KEY(path, members[YMAG]), found[YMAG], &reader->view->ymag);
}

static void read_projection(struct reader *reader)
{
    static const int projections[] = {PERSPECTIVE, ORTHOGRAPHIC, PROJECTION_MATRIX};
    struct zr_view *view = reader->view;
    if (!at_most_one(reader, projections, 3, "projections")) return;
    if (reader->found[PERSPECTIVE])
        read_perspective(reader);
    else if (reader->found[ORTHOGRAPHIC])
        read_orthographic(reader);
    else if (reader->found[PROJECTION_MATRIX]) {
        view->projection = ZR_PROJECTION_MATRIX;
        zr_json_mat4(reader->json, ZR_JSON_KEY(reader->path, words[PROJECTION_MATRIX]),
                     reader->found[PROJECTION_MATRIX], &view->projection_matrix);
    } else if (view->pose != ZR_POSE_PRESET) {
        view->projection = ZR_PROJECTION_PERSPECTIVE;
        view->yfov_radians = radians(45);
    }
}

static bool read_plane(struct reader *reader, int key, float *out)
{
    const cJSON *node = reader->found[key];
    const struct zr_json_path *path = ZR_JSON_KEY(reader->path, words[key]);
    if (!node) return false;
    if (reader->view->projection == ZR_PROJECTION_MATRIX)
        return zr_json_fault(reader->json, path, "projectionMatrix has planes of its own");
    return reader->view->projection == ZR_PROJECTION_PERSPECTIVE ? zr_json_positive(reader->json, path, node, out)
                                                                 : zr_json_coordinate(reader->json, path, node, out);
}

static void read_planes(struct reader *reader)
{
    struct zr_view *view = reader->view;
    view->has_znear = read_plane(reader, ZNEAR, &view->znear);
    view->has_zfar = read_plane(reader, ZFAR, &view->zfar);
    if (view->has_znear && view->has_zfar && !(view->znear < view->zfar))
        zr_json_fault(reader->json, ZR_JSON_KEY(reader->path, words[ZFAR]), "%.9g is not beyond znear, %.9g",
                      (double)view->zfar, (double)view->znear);
}

static void read_fit(struct reader *reader)
{
    enum { PADDING, FIT_KEYS };
    static const char *const members[] = {"padding", "mesh"};
    static const struct zr_names names = ZR_NAMES(FIT_KEYS, members);
    const struct zr_json_path *path = ZR_JSON_KEY(reader->path, words[FIT]);
    const cJSON *found[FIT_KEYS];
    double padding;
    if (!zr_json_object(reader->json, path, reader->found[FIT], &names, found) || !found[PADDING]) return;
    if (zr_json_number(reader->json, ZR_JSON_KEY(path, members[PADDING]), found[PADDING], 0, 0.45, &padding))
        reader->view->fit_padding = (float)padding;
}

void zr_draft_read_view(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node)
{
    struct reader reader = {.json = &draft->json, .path = path, .view = &draft->scene->view};
    if (!zr_json_object(reader.json, path, node, &keys, reader.found)) return;
    read_pose(&reader);
    read_projection(&reader);
    read_planes(&reader);
    if (reader.found[FIT]) read_fit(&reader);
    int convention;
    if (reader.found[CONVENTION])
        zr_json_choice(reader.json, ZR_JSON_KEY(path, words[CONVENTION]), reader.found[CONVENTION], &convention_names,
                       &convention);
}
