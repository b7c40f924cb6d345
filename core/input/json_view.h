/* json_view.h - input: what the readers of a view's parts share; nobody else includes it.
 *
 * The keys of a view are found once (json_view.c); a pose (json_pose.c) and a projection
 * (json_projection.c) are then read from those that belong to them.
 */
#ifndef ZR_JSON_VIEW_H
#define ZR_JSON_VIEW_H

#include "input/json_value.h"
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
    ZR_VIEW_ZNEAR,
    ZR_VIEW_ZFAR,
    ZR_VIEW_FIT,
    ZR_VIEW_KEYS
};

extern const char *const zr_view_words[]; /* enum zr_view_key, and those that are not supported */

struct zr_view_reader {
    struct zr_json *json;
    const struct zr_json_path *path; /* of the view */
    const cJSON *found[ZR_VIEW_KEYS];
    struct zr_view *view;
};

/* The path of a member, as ZR_JSON_KEY has it. */
#define ZR_VIEW_PATH(reader, key) ZR_JSON_KEY((reader)->path, zr_view_words[key])

/* json_pose.c: the pose, and which way its axes go. */
void zr_view_read_pose(struct zr_view_reader *reader);

/* json_projection.c: the projection that is said, or else the one that the pose suggests. */
void zr_view_read_projection(struct zr_view_reader *reader);

/* Three rows of three numbers, or nine numbers row by row, as OpenCV and ROS write them:
 * magnitudes up to `limit`. */
bool zr_view_read_rows(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, double limit,
                       double out[9]);

#endif
