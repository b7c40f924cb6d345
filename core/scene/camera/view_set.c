#include "scene/camera/view_set.h"

#include <string.h>

#include "base/run.h"
#include "scene/camera/camera_parts.h"
#include "scene/camera/upright.h"
#include "scene/output.h"
#include "scene/picture.h"

const char *zr_view_set_pointer(const struct zr_view_set *set)
{
    static const char *const pointers[] = {"/views", "/turntable", "/orbit", "/animate", "/query/frames"};
    return pointers[set->kind];
}

/* ---- poses ---- */

/* Point `number` of a Fibonacci sphere, from the top to the bottom: equal steps of height, and steps of the golden
 * angle around it. Elevations are rounded, since the last bits of libm differ between systems. Source: R. Swinbank, R.
 * J. Purser, "Fibonacci grids", Q. J. R. Meteorol. Soc. 132 (2006). */
static void find_point(uint32_t number, uint32_t count, double *azimuth, double *elevation)
{
    const double golden = 137.50776405003785, height = 1.0 - (2.0 * (double)number + 1.0) / (double)count;
    const double turns = golden / 360.0 * (double)number;
    *azimuth = 360.0 * (turns - floor(turns));
    *elevation = round(asin(height) * (180.0e4 / 3.14159265358979323846)) * 1e-4;
}

static void pose_item(const struct zr_scene *scene, const struct zr_view_item *item, struct zr_view *view)
{
    if (item->preset < 0 && !item->has_angles) return;
    view->suits_extent = false;
    view->pose = item->has_angles ? ZR_POSE_ORBIT : ZR_POSE_PRESET;
    if (item->has_angles) {
        view->azimuth_degrees = item->azimuth_degrees;
        view->elevation_degrees = item->elevation_degrees;
        view->has_target = false;
        view->distance = 0.0f;
        view->up = scene->picture->z_is_up ? (zr_vec3){0, 0, 1} : (zr_vec3){0, 1, 0};
        return;
    }
    view->preset = (enum zr_preset)item->preset;
    if (scene->picture->z_is_up) zr_view_put_z_up(view, false);
}

bool zr_view_has_sheet_scale(const struct zr_view *view)
{
    return view->projection == ZR_PROJECTION_ORTHOGRAPHIC && !(view->xmag > 0.0f) && view->pose != ZR_POSE_MATRIX;
}

/* Views that a sheet names are orthographic, without a lens: perspective has no scale. */
static void use_sheet_scale(const struct zr_view_item *item, const struct zr_shared_camera *camera,
                            struct zr_view *view)
{
    if (item->preset >= 0 || item->has_angles) {
        view->projection = ZR_PROJECTION_ORTHOGRAPHIC;
        view->xmag = view->ymag = 0.0f;
        view->lens = (struct zr_lens){.model = ZR_LENS_NONE};
    }
    if (!zr_view_has_sheet_scale(view)) return;
    view->xmag = camera->xmag;
    view->ymag = camera->ymag;
}

/* Sets a camera as its matrix, and half sizes that were fitted. */
static void keep_still(const struct zr_shared_camera *camera, struct zr_view *view)
{
    view->suits_extent = false;
    view->pose = ZR_POSE_MATRIX;
    view->world_to_camera = camera->world_to_eye;
    if (!(camera->xmag > 0.0f)) return;
    view->xmag = camera->xmag;
    view->ymag = camera->ymag;
}

void zr_view_set_pose(const struct zr_scene *scene, const struct zr_view_set *set, uint32_t number,
                      const struct zr_shared_camera *camera, struct zr_view *view)
{
    if (set->kind == ZR_VIEW_SET_LIST) {
        pose_item(scene, &set->items[number], view);
        if (scene->sheet.is_on) use_sheet_scale(&set->items[number], camera, view);
        return;
    }
    if (zr_view_set_is_animation(set)) {
        if (camera->is_still) keep_still(camera, view);
        return;
    }
    view->suits_extent = false;
    view->pose = ZR_POSE_ORBIT;
    view->up = scene->picture->z_is_up ? (zr_vec3){0, 0, 1} : (zr_vec3){0, 1, 0};
    view->has_target = true;
    view->target = camera->target;
    view->distance = camera->distance;
    if (view->projection == ZR_PROJECTION_ORTHOGRAPHIC) {
        view->distance = 0.0f;
        view->xmag = camera->xmag;
        view->ymag = camera->ymag;
    }
    if (set->kind == ZR_VIEW_SET_ORBIT) {
        find_point(number, set->count, &view->azimuth_degrees, &view->elevation_degrees);
        return;
    }
    view->azimuth_degrees = camera->azimuth_degrees + 360.0 * (double)number / (double)set->count;
    view->elevation_degrees = camera->elevation_degrees;
}

/* ---- the shared camera ---- */

/* Distance from the camera to a point, along the view axis. */
static double depth_of(const struct zr_camera *camera, zr_vec3 p)
{
    const float *m = camera->world_to_eye.m;
    return -((double)m[2] * (double)p.x + (double)m[6] * (double)p.y + (double)m[10] * (double)p.z + (double)m[14]);
}

/* Angles of the scene's view, resolved, as the first angles of a turntable. */
static void find_angles(const struct zr_scene *scene, const struct zr_view_set *set, const struct zr_camera *first,
                        struct zr_shared_camera *camera)
{
    const struct zr_orbit orbit = zr_orbit_of(first, scene->picture->z_is_up);
    camera->azimuth_degrees = orbit.azimuth_degrees;
    camera->elevation_degrees = set->has_elevation ? set->elevation_degrees : orbit.elevation_degrees;
}

static zr_vec3 middle_of(const struct zr_bounds *bounds)
{
    const zr_vec3 a = bounds->min, b = bounds->max;
    if (!bounds->valid) return (zr_vec3){0, 0, 0};
    return (zr_vec3){(float)(((double)a.x + (double)b.x) * 0.5), (float)(((double)a.y + (double)b.y) * 0.5),
                     (float)(((double)a.z + (double)b.z) * 0.5)};
}

/* Sets target, and the distance or half sizes that the scene's view gives. */
static void use_given(const struct zr_view *view, const struct zr_bounds *fitted, const struct zr_view_set *set,
                      struct zr_shared_camera *camera)
{
    const bool has_target = view->pose == ZR_POSE_LOOK_AT || (view->pose == ZR_POSE_ORBIT && view->has_target);
    const zr_vec3 e = view->eye, t = view->target;
    camera->target = has_target ? t : middle_of(fitted);
    camera->distance = set->distance;
    if (view->pose == ZR_POSE_ORBIT && !(camera->distance > 0.0f)) camera->distance = view->distance;
    if (view->pose == ZR_POSE_LOOK_AT && !(camera->distance > 0.0f)) {
        const zr_dvec3 d = zr_dvec3_sub(zr_dvec3_of(e), zr_dvec3_of(t));
        camera->distance = (float)sqrt(zr_dvec3_dot(d, d));
    }
    camera->xmag = view->xmag;
    camera->ymag = view->ymag;
}

static enum zr_status check(const struct zr_view *view, const struct zr_view_set *set, struct zr_error *error)
{
    const bool is_pose = view->pose == ZR_POSE_MATRIX;
    if (!is_pose && view->projection != ZR_PROJECTION_MATRIX) return ZR_OK;
    return zr_error_add(error, ZR_BAD_SCENE, zr_view_set_pointer(set),
                        "a turntable needs a view that can turn, and this view has a %s as a matrix: give %s",
                        is_pose ? "pose" : "projection",
                        is_pose ? "eye and target, a preset or azimuthDegrees" : "perspective or orthographic");
}

/* Raises distance and half sizes to those of one view. */
static enum zr_status measure(const struct zr_run *run, const struct zr_scene *scene, const struct zr_view *view,
                              const struct zr_bounds *bounds, struct zr_shared_camera *most)
{
    struct zr_camera camera;
    const enum zr_status status = zr_camera_resolve(run, scene, view, bounds, &camera);
    if (status != ZR_OK) return status;
    most->distance = fmaxf(most->distance, (float)depth_of(&camera, view->target));
    most->xmag = fmaxf(most->xmag, 1.0f / camera.projection.m[0]);
    most->ymag = fmaxf(most->ymag, 1.0f / camera.projection.m[5]);
    return ZR_OK;
}

enum zr_status zr_view_set_fit(const struct zr_run *run, const struct zr_scene *scene, const struct zr_view_set *set,
                               struct zr_shared_camera *camera)
{
    const struct zr_view *given = &scene->views[0];
    const struct zr_points points = {.scene = scene, .view = given, .team = run->team, .cancel = run->cancel};
    struct zr_camera first;
    struct zr_bounds bounds = zr_bounds_of(scene, run->team, run->cancel);
    enum zr_status status = check(given, set, run->error);
    if (status == ZR_OK) status = zr_camera_resolve(run, scene, given, &bounds, &first);
    if (status != ZR_OK) return status;
    const struct zr_bounds fitted = zr_fit_bounds(&points, &bounds);
    *camera = (struct zr_shared_camera){.distance = 0.0f};
    find_angles(scene, set, &first, camera);
    use_given(given, &fitted, set, camera);
    const bool is_parallel = given->projection == ZR_PROJECTION_ORTHOGRAPHIC;
    if (is_parallel ? camera->xmag > 0.0f : camera->distance > 0.0f) return ZR_OK;
    struct zr_shared_camera most = {.distance = 0.0f};
    for (uint32_t i = 0; status == ZR_OK && i < set->count; i++) {
        struct zr_view view = *given;
        zr_view_set_pose(scene, set, i, camera, &view);
        status = measure(run, scene, &view, &bounds, &most);
    }
    camera->distance = most.distance;
    camera->xmag = most.xmag;
    camera->ymag = most.ymag;
    return status;
}

/* ---- sheets ---- */

#define ANGLES(text, azimuth, elevation)                                                                               \
    {                                                                                                                  \
        .name = (text), .preset = -1, .has_angles = true, .azimuth_degrees = (azimuth),                                \
        .elevation_degrees = (elevation)                                                                               \
    }
#define SLOPE 35.264389682754654 /* asin(1 / sqrt(3)) */

static const struct zr_view_item third[] = {{.name = "top", .preset = ZR_PRESET_TOP},
                                            {.name = "isometric", .preset = ZR_PRESET_ISOMETRIC},
                                            {.name = "front", .preset = ZR_PRESET_FRONT},
                                            {.name = "right", .preset = ZR_PRESET_RIGHT}};
static const struct zr_view_item first[] = {{.name = "right", .preset = ZR_PRESET_RIGHT},
                                            {.name = "front", .preset = ZR_PRESET_FRONT},
                                            {.name = "isometric", .preset = ZR_PRESET_ISOMETRIC},
                                            {.name = "top", .preset = ZR_PRESET_TOP}};
static const struct zr_view_item balanced[] = {
    ANGLES("front-right-above", 45, SLOPE), ANGLES("back-left-above", 225, SLOPE),
    ANGLES("front-left-below", -45, -SLOPE), ANGLES("back-right-below", 135, -SLOPE)};

/* A sheet is a picture of pixels, and its views have another size than the window. */
static enum zr_status check_sheet(const struct zr_scene *scene, struct zr_error *error)
{
    const struct zr_view *view = &scene->views[0];
    if (zr_view_encodes(view, ZR_ENCODING_SVG))
        return zr_error_add(
            error, ZR_BAD_SCENE, "/sheet",
            "a sheet is made of pixels, and the encoding svg has none: leave out the sheet, or choose png");
    if (zr_view_wants(view, ZR_CHANNEL_FRAGMENTS))
        return zr_error_add(error, ZR_BAD_SCENE, "/sheet",
                            "cannot be combined with the channel fragments, which describes one pixel of one view");
    if (view->picks.count > 0)
        return zr_error_add(error, ZR_BAD_SCENE, "/sheet",
                            "cannot be combined with picks, which are pixels of one view");
    if (zr_view_wants(view, ZR_CHANNEL_TRACE))
        return zr_error_add(error, ZR_BAD_SCENE, "/sheet",
                            "cannot be combined with the channel trace, which describes one view");
    if (scene->base)
        return zr_error_add(error, ZR_BAD_SCENE, "/sheet",
                            "cannot be combined with a base, whose pictures have the size of one view");
    return ZR_OK;
}

enum zr_status zr_sheet_complete(struct zr_scene *scene, struct zr_error *error)
{
    static const struct zr_view_set sets[2][2] = {{{.count = 4, .items = third}, {.count = 4, .items = first}},
                                                  {{.count = 4, .items = balanced}, {.count = 4, .items = balanced}}};
    struct zr_sheet *sheet = &scene->sheet;
    if (!sheet->is_on) return ZR_OK;
    if (check_sheet(scene, error) != ZR_OK) return ZR_BAD_SCENE;
    if (sheet->layout == ZR_SHEET_VIEWS)
        return scene->view_set
                   ? ZR_OK
                   : zr_error_add(error, ZR_BAD_SCENE, "/sheet",
                                  "the views are missing: give \"views\", or the layout threeView or balanced");
    if (scene->view_set)
        return zr_error_add(
            error, ZR_BAD_SCENE, "/sheet",
            "this layout chooses its own views, and the scene gives %s, too: give \"layout\": \"views\", "
            "or leave these out",
            strrchr(zr_view_set_pointer(scene->view_set), '/') + 1);
    scene->view_set = &sets[sheet->layout - ZR_SHEET_THREE_VIEW][sheet->angle];
    sheet->columns = 2;
    return ZR_OK;
}
