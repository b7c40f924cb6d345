/* A view is one pose and one projection; zr_json_object_view refuses two of either. */
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/view/view_keys.h"
#include "scene/defaults.h"

/* ---- the projection ---- */

static void check_k(struct zr_parsed_view *given)
{
    const struct zr_json_path *path = ZR_VIEW_PATH(given, ZR_VIEW_K);
    const double *k = given->k;
    if (k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0)
        zr_json_fault(given->json, path, "the last row is %.9g %.9g %.9g, not 0 0 1 (a flat list goes row by row)",
                      k[6], k[7], k[8]);
    else if (k[3] != 0.0)
        zr_json_fault(given->json, path, "the second row begins with %.9g, not 0", k[3]);
    else if (zr_view_check_focal(given->json, path, k[0]) && zr_view_check_focal(given->json, path, k[4]))
        given->intrinsics = (struct zr_intrinsics){k[0], k[4], k[1], true, true, k[2], k[5]};
}

/* Image coordinates have their origin at the corner of the picture. In the other convention it is the centre of the
 * first pixel, half a pixel further. */
static void check_pixel_center(struct zr_parsed_view *given)
{
    const struct zr_json_path *path = ZR_VIEW_PATH(given, ZR_VIEW_PIXEL_CENTER);
    const double center = given->pixel_center;
    if (center != 0.0 && center != 0.5) zr_json_fault(given->json, path, "%.9g is neither 0 nor 0.5", center);
    given->view.intrinsics.cx += 0.5 - center;
    given->view.intrinsics.cy += 0.5 - center;
}

/* The default: perspective if the camera has a given position, orthographic if it is fitted. */
static void suggest_projection(struct zr_view *view)
{
    bool placed = view->pose == ZR_POSE_LOOK_AT || view->pose == ZR_POSE_MATRIX ||
                  (view->pose == ZR_POSE_ORBIT && view->distance > 0.0f);
    view->projection = placed ? ZR_PROJECTION_PERSPECTIVE : ZR_PROJECTION_ORTHOGRAPHIC;
    if (placed) view->yfov_radians = ZR_YFOV;
}

static void find_projection(struct zr_parsed_view *given)
{
    static const struct {
        enum zr_view_key key;
        enum zr_projection projection;
    } kinds[] = {{ZR_VIEW_PERSPECTIVE, ZR_PROJECTION_PERSPECTIVE},
                 {ZR_VIEW_ORTHOGRAPHIC, ZR_PROJECTION_ORTHOGRAPHIC},
                 {ZR_VIEW_INTRINSICS, ZR_PROJECTION_INTRINSICS},
                 {ZR_VIEW_K, ZR_PROJECTION_INTRINSICS},
                 {ZR_VIEW_PROJECTION_MATRIX, ZR_PROJECTION_MATRIX}};
    if (!(given->keys & ZR_VIEW_PROJECTIONS)) suggest_projection(&given->view);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (zr_view_gives(given, kinds[i].key)) given->view.projection = kinds[i].projection;
    if (zr_view_gives(given, ZR_VIEW_K)) check_k(given);
    given->view.intrinsics = given->intrinsics;
    if (zr_view_gives(given, ZR_VIEW_PIXEL_CENTER)) check_pixel_center(given);
}

/* ---- the view ---- */

/* True if the plane is given and valid. */
static bool check_plane(struct zr_parsed_view *given, enum zr_view_key key, float distance)
{
    if (!zr_view_gives(given, key)) return false;
    return given->view.projection == ZR_PROJECTION_ORTHOGRAPHIC || distance > 0.0f ||
           zr_json_fault(given->json, ZR_VIEW_PATH(given, key), "%.9g is not greater than 0", (double)distance);
}

static void find_planes(struct zr_parsed_view *given)
{
    struct zr_view *view = &given->view;
    view->has_znear = check_plane(given, ZR_VIEW_ZNEAR, view->znear);
    view->has_zfar = check_plane(given, ZR_VIEW_ZFAR, view->zfar);
    if (view->has_znear && view->has_zfar && !(view->znear < view->zfar))
        zr_json_fault(given->json, ZR_VIEW_PATH(given, ZR_VIEW_ZFAR), "%.9g is not beyond znear, %.9g",
                      (double)view->zfar, (double)view->znear);
}

/* A camera of a model file has a pose, a projection and planes. Keys of the last two override it. */
static void find_camera(struct zr_parsed_view *given)
{
    find_projection(given);
    if (!(given->keys & ZR_VIEW_PROJECTIONS)) given->view.projection = ZR_PROJECTION_PERSPECTIVE; /* for the planes */
    find_planes(given);
}

/* Reads the object of a view, or the name of a preset. */
static bool read_keys(struct zr_json *json, const struct zr_json_path *path, struct zr_parsed_view *given)
{
    if (zr_json_type(json) != ZR_JSON_STRING)
        return zr_json_fields(json, path, &zr_json_object_view, given, &given->keys);
    given->keys = UINT64_C(1) << ZR_VIEW_PRESET;
    return zr_json_choice_of(json, path, &zr_preset_names, &given->preset);
}

bool zr_view_read(struct zr_json *json, const struct zr_json_path *path, const struct zr_view *defaults,
                  struct zr_parsed_view *given)
{
    *given = (struct zr_parsed_view){.json = json,
                                     .path = path,
                                     .view = *defaults,
                                     .preset = (int)defaults->preset,
                                     .convention = -1,
                                     .pixel_center = 0.5};
    const size_t faults = json->error->count;
    if (!read_keys(json, path, given) || json->error->count > faults) return false;
    if (zr_view_gives(given, ZR_VIEW_CAMERA)) {
        find_camera(given);
        return true;
    }
    zr_view_find_pose(given);
    find_projection(given);
    find_planes(given);
    if (zr_view_gives(given, ZR_VIEW_AZIMUTH_DEGREES) || zr_view_gives(given, ZR_VIEW_ELEVATION_DEGREES))
        given->view.suits_extent = false;
    return true;
}

bool zr_read_view(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_parsed_view given;
    if (!zr_view_read(json, path, &root->scene->views[0], &given)) return false;
    root->scene->views[0] = given.view;
    if (zr_view_gives(&given, ZR_VIEW_CAMERA)) {
        root->camera = given.camera;
        root->gives_projection = given.keys & ZR_VIEW_PROJECTIONS;
        root->gives_znear = zr_view_gives(&given, ZR_VIEW_ZNEAR);
        root->gives_zfar = zr_view_gives(&given, ZR_VIEW_ZFAR);
        return true;
    }
    root->fit_mesh = given.fit_mesh;
    root->view_has_up = zr_view_gives(&given, ZR_VIEW_UP);
    return true;
}
