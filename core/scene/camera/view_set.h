/* view_set.h - scene: several views of one scene, as a request gives them.
 *
 * List:      each item changes keys of the scene, or names a preset.
 * Turntable: the camera turns once around the scene, in equal steps.
 * Orbit:     cameras lie on a Fibonacci sphere around the scene, the first one at the top.
 * Animate:   nodes move; frames are at equal steps of time, from its start up to the step before its end.
 * File:      the same for an animation of a glTF file, which is read once for each frame.
 * Sheet:     one picture of all views, at one scale. Two layouts have views of their own.
 *
 * All cameras of a turntable or an orbit look at one target, from one distance and at one scale, which hold the
 * geometry in every view. A fitted camera of an animation stays in one place, from which it sees all frames. */
#ifndef ZR_VIEW_SET_H
#define ZR_VIEW_SET_H

#include "base/run.h"
#include "scene/camera/resolved_view.h"
#include "scene/parts/animation.h"

enum zr_view_set_kind {
    ZR_VIEW_SET_LIST,
    ZR_VIEW_SET_TURNTABLE,
    ZR_VIEW_SET_ORBIT,
    ZR_VIEW_SET_ANIMATE,
    ZR_VIEW_SET_FILE
};

struct zr_view_item {
    const char *name; /* of its files; NULL: its number */
    int preset;       /* enum zr_preset; -1: none */
    bool has_angles;  /* else both are 0 */
    double azimuth_degrees, elevation_degrees;
    const char *keys; /* JSON object of the keys that it changes; NULL: none */
    size_t keys_size;
    const char *const *key_names; /* of these keys, NULL after the last */
};

struct zr_view_set {
    enum zr_view_set_kind kind;
    uint32_t count;
    const struct zr_view_item *items; /* list */
    bool has_elevation;               /* turntable; false: that of the scene's view */
    double elevation_degrees;
    double seconds;                       /* of one turn, or of an animation; else 0 */
    float distance;                       /* orbit: from the target; 0: fitted */
    const struct zr_animation *animation; /* animate; else NULL */
    double start;                         /* file: time of the first frame, seconds */
};

/* Camera that the views of a turntable, an orbit or an animation share. */
struct zr_shared_camera {
    bool is_still; /* has a matrix and half sizes, and no angles, target and distance */
    zr_mat4 world_to_eye;
    double azimuth_degrees, elevation_degrees; /* of the first view */
    zr_vec3 target;
    float distance;   /* 0: not fitted yet */
    float xmag, ymag; /* of an orthographic projection; 0: not fitted yet */
};

/* True if the view on a sheet has the scale of all: it is orthographic, and gives no size. */
bool zr_view_has_sheet_scale(const struct zr_view *view);

/* Adds the views of a sheet's layout to the scene. ZR_BAD_SCENE if the scene gives views, too, or the sheet has none.
 */
enum zr_status zr_sheet_complete(struct zr_scene *scene, struct zr_error *error);

/* Finds the shared camera. Not for lists and animations. ZR_BAD_SCENE if the scene's view has a pose or a projection as
 * a matrix, or if one of the views has no solution; ZR_CANCELLED. */
enum zr_status zr_view_set_fit(const struct zr_run *run, const struct zr_scene *scene, const struct zr_view_set *set,
                               struct zr_shared_camera *camera);

/* Sets the pose of a view. `camera`: of a turntable, an orbit or a sheet, on which orthographic views without a size of
 * their own have one scale. */
void zr_view_set_pose(const struct zr_scene *scene, const struct zr_view_set *set, uint32_t number,
                      const struct zr_shared_camera *camera, struct zr_view *view);

/* Key of the scene that gives the set: "/views", "/turntable", "/orbit", "/animate" or "/query/frames". */
const char *zr_view_set_pointer(const struct zr_view_set *set);

/* True if the views are frames of an animation. */
static inline bool zr_view_set_is_animation(const struct zr_view_set *set)
{
    return set->kind == ZR_VIEW_SET_ANIMATE || set->kind == ZR_VIEW_SET_FILE;
}

/* True if the views are frames in time: of a turn or an animation. */
static inline bool zr_view_set_has_times(const struct zr_view_set *set)
{
    return set->seconds > 0.0;
}

#endif
