/* view_keys.h - input: shared by the readers of a view's parts, private to them.
 *
 * json_view_fields.c has the table of keys, json_projection.c the readers of projections. Once all keys are read,
 * json_pose.c finds the pose, and json_view.c the projection and the planes.
 */
#ifndef ZR_VIEW_KEYS_H
#define ZR_VIEW_KEYS_H

#include "input/json/json_value.h"
#include "scene/scene.h"

enum zr_view_key {
    ZR_VIEW_EYE,
    ZR_VIEW_TARGET,
    ZR_VIEW_UP,
    ZR_VIEW_PRESET,
    ZR_VIEW_DIRECTION,
    ZR_VIEW_AZIMUTH_DEGREES,
    ZR_VIEW_ELEVATION_DEGREES,
    ZR_VIEW_DISTANCE,
    ZR_VIEW_CAMERA_TO_WORLD,
    ZR_VIEW_WORLD_TO_CAMERA,
    ZR_VIEW_R,
    ZR_VIEW_T,
    ZR_VIEW_CONVENTION,
    ZR_VIEW_PERSPECTIVE,
    ZR_VIEW_ORTHOGRAPHIC,
    ZR_VIEW_INTRINSICS,
    ZR_VIEW_K,
    ZR_VIEW_PIXEL_CENTER,
    ZR_VIEW_PROJECTION_MATRIX,
    ZR_VIEW_DISTORTION,
    ZR_VIEW_ZNEAR,
    ZR_VIEW_ZFAR,
    ZR_VIEW_FIT,
    ZR_VIEW_CAMERA,
    ZR_VIEW_KEYS
};

/* Axes of a camera: y up and looking along -z, or y down and looking along +z. */
enum zr_convention { ZR_CONVENTION_OPENGL, ZR_CONVENTION_OPENCV };

/* A view as read, before its values are checked against each other. */
struct zr_parsed_view {
    struct zr_json *json;
    const struct zr_json_path *path; /* the view's */
    uint64_t keys;                   /* bit i: key i is given */
    struct zr_view view;             /* defaults, overridden by the keys */
    int preset, convention;
    zr_mat4 camera_to_world;
    double r[9], k[9], t[3];
    double pixel_center;
    struct zr_intrinsics intrinsics;
    const char *fit_mesh; /* name of the mesh to fit; NULL: all geometry */
    const char *camera;   /* name or number of a camera of a model file; NULL: the view gives pose and projection */
};

extern const struct zr_json_field zr_view_fields[]; /* enum zr_view_key, then the keys that are not supported */

static inline bool zr_view_gives(const struct zr_parsed_view *given, enum zr_view_key key)
{
    return zr_json_gives(given->keys, (int)key);
}

#define ZR_VIEW_BIT(key) (UINT64_C(1) << (key))

/* The keys that are projections, one bit each. */
#define ZR_VIEW_PROJECTIONS                                                                                            \
    (ZR_VIEW_BIT(ZR_VIEW_PERSPECTIVE) | ZR_VIEW_BIT(ZR_VIEW_ORTHOGRAPHIC) | ZR_VIEW_BIT(ZR_VIEW_INTRINSICS) |          \
     ZR_VIEW_BIT(ZR_VIEW_K) | ZR_VIEW_BIT(ZR_VIEW_PROJECTION_MATRIX))

/* The path of a key of the view. */
#define ZR_VIEW_PATH(given, which) ZR_JSON_KEY((given)->path, zr_view_fields[which].key)

/* json_view.c: reads a view over `defaults`, and checks its keys against each other. A view with the key `camera` has
 * a projection and planes only. Sets `given` even if a fault returns false. */
bool zr_view_read(struct zr_json *json, const struct zr_json_path *path, const struct zr_view *defaults,
                  struct zr_parsed_view *given);

/* json_pose.c: finds the pose from the keys, in OpenGL's axes. */
void zr_view_find_pose(struct zr_parsed_view *given);

/* json_projection.c */
zr_json_read_fn zr_read_perspective, zr_read_orthographic, zr_read_intrinsics; /* struct zr_parsed_view */

/* json_distortion.c */
zr_json_read_fn zr_read_distortion; /* struct zr_lens */

/* Reports a focal length, pixels, that is too short; returns false. */
bool zr_view_check_focal(struct zr_json *json, const struct zr_json_path *path, double value);

#endif
