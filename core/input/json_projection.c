/* The projection of a view. */
#include "input/defaults.h"
#include "input/json_view.h"

#define PI 3.14159265358979323846

/* Pixels: far beyond any lens, and still a float once divided by a window. */
static const double FOCAL_MIN = 1e-6, PIXELS_MAX = 1e9;

static float radians(double degrees)
{
    return (float)(degrees * PI / 180);
}

static void read_perspective(struct zr_view_reader *reader)
{
    enum { YFOV, YFOV_DEGREES, XFOV, XFOV_DEGREES, PERSPECTIVE_KEYS }; /* each in radians, then in degrees */
    static const char *const members[] = {"yfov", "yfovDegrees", "xfov", "xfovDegrees"};
    static const struct zr_names names = ZR_NAMES(PERSPECTIVE_KEYS, members);
    struct zr_json *json = reader->json;
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, ZR_VIEW_PERSPECTIVE);
    const cJSON *found[PERSPECTIVE_KEYS];
    size_t faults = json->error->count;
    int key = -1;
    if (!zr_json_object(json, path, reader->found[ZR_VIEW_PERSPECTIVE], &names, found)) return;
    for (int i = 0; i < PERSPECTIVE_KEYS; i++) {
        if (found[i] && key >= 0) zr_json_fault(json, path, "two angles: %s and %s", members[key], members[i]);
        if (found[i] && key < 0) key = i;
    }
    if (key < 0 && json->error->count == faults)
        zr_json_fault(json, path, "no angle; one of %s is needed", zr_names_join(&names).text);
    if (json->error->count > faults) return;

    bool degrees = key == YFOV_DEGREES || key == XFOV_DEGREES;
    const struct zr_json_path *at = ZR_JSON_KEY(path, members[key]);
    double value = found[key]->valuedouble; /* 0 in what is no number */
    if (!degrees && value > PI && value < 360) {
        zr_json_fault(json, at, "%.9g is more than half a turn: %s takes radians, %s takes degrees", value,
                      members[key], members[key + 1]);
        return;
    }
    if (!zr_json_number(json, at, found[key], 0, degrees ? 180 : PI, &value)) return;
    float angle = degrees ? radians(value) : (float)value;
    /* As floats: one that rounds to 0 or a half turn has no tangent to divide by. */
    if (!(angle > 0.0f) || !(angle < (float)PI))
        zr_json_fault(json, at, "%.9g: an angle between 0 and 180 degrees, both excluded, is needed", value);
    *(key == XFOV || key == XFOV_DEGREES ? &reader->view->xfov_radians : &reader->view->yfov_radians) = angle;
}

static void read_orthographic(struct zr_view_reader *reader)
{
    enum { XMAG, YMAG, ORTHOGRAPHIC_KEYS };
    static const char *const members[] = {"xmag", "ymag"};
    static const struct zr_names names = ZR_NAMES(ORTHOGRAPHIC_KEYS, members);
    struct zr_json *json = reader->json;
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, ZR_VIEW_ORTHOGRAPHIC);
    const cJSON *found[ORTHOGRAPHIC_KEYS];
    if (!zr_json_object(json, path, reader->found[ZR_VIEW_ORTHOGRAPHIC], &names, found)) return;
    if (!found[XMAG] != !found[YMAG])
        zr_json_fault(json, path, "%s is missing; give xmag and ymag, or neither to fit the geometry",
                      found[XMAG] ? "ymag" : "xmag");
    if (found[XMAG]) zr_json_positive(json, ZR_JSON_KEY(path, members[XMAG]), found[XMAG], &reader->view->xmag);
    if (found[YMAG]) zr_json_positive(json, ZR_JSON_KEY(path, members[YMAG]), found[YMAG], &reader->view->ymag);
}

/* ---- pinhole cameras ---- */

static bool check_focal(struct zr_json *json, const struct zr_json_path *path, double value)
{
    return value >= FOCAL_MIN ||
           zr_json_fault(json, path, "%.9g is no focal length in pixels: %g and more is allowed", value, FOCAL_MIN);
}

static void read_intrinsics(struct zr_view_reader *reader)
{
    enum { FX, FY, CX, CY, SKEW, INTRINSICS_KEYS };
    static const char *const members[] = {"fx", "fy", "cx", "cy", "skew"};
    static const struct zr_names names = ZR_NAMES(INTRINSICS_KEYS, members);
    struct zr_json *json = reader->json;
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, ZR_VIEW_INTRINSICS);
    const cJSON *found[INTRINSICS_KEYS];
    double values[INTRINSICS_KEYS] = {0};
    size_t faults = json->error->count;
    if (!zr_json_object(json, path, reader->found[ZR_VIEW_INTRINSICS], &names, found)) return;
    for (int i = 0; i < INTRINSICS_KEYS; i++) {
        const struct zr_json_path *at = ZR_JSON_KEY(path, members[i]);
        if (!found[i] || !zr_json_number(json, at, found[i], -PIXELS_MAX, PIXELS_MAX, &values[i])) continue;
        if (i == FX || i == FY) check_focal(json, at, values[i]);
    }
    if (!found[FX] && json->error->count == faults) zr_json_fault(json, path, "fx is missing");
    reader->view->intrinsics = (struct zr_intrinsics){.fx = values[FX],
                                                      .fy = found[FY] ? values[FY] : values[FX],
                                                      .skew = values[SKEW],
                                                      .has_cx = found[CX] != NULL,
                                                      .has_cy = found[CY] != NULL,
                                                      .cx = values[CX],
                                                      .cy = values[CY]};
}

static void read_k(struct zr_view_reader *reader)
{
    struct zr_json *json = reader->json;
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, ZR_VIEW_K);
    double k[12];
    if (!zr_view_read_rows(json, path, reader->found[ZR_VIEW_K], PIXELS_MAX, k)) return;
    if (k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0)
        zr_json_fault(json, path, "the last row is %.9g %.9g %.9g, not 0 0 1 (a flat list goes row by row)", k[6], k[7],
                      k[8]);
    else if (k[3] != 0.0)
        zr_json_fault(json, path, "the second row begins with %.9g, not 0", k[3]);
    else if (check_focal(json, path, k[0]) && check_focal(json, path, k[4]))
        reader->view->intrinsics = (struct zr_intrinsics){k[0], k[4], k[1], true, true, k[2], k[5]};
}

/* (0, 0) is the corner of the picture; in the other convention it is the centre of the first
 * pixel, which is half a pixel further. */
static void read_pixel_center(struct zr_view_reader *reader)
{
    const struct zr_json_path *path = ZR_VIEW_PATH(reader, ZR_VIEW_PIXEL_CENTER);
    double center;
    if (reader->view->projection != ZR_PROJECTION_INTRINSICS) {
        zr_json_fault(reader->json, path, "belongs to intrinsics and K only");
        return;
    }
    if (!zr_json_number(reader->json, path, reader->found[ZR_VIEW_PIXEL_CENTER], 0, 0.5, &center)) return;
    if (center != 0.0 && center != 0.5) zr_json_fault(reader->json, path, "%.9g is neither 0 nor 0.5", center);
    reader->view->intrinsics.cx += 0.5 - center;
    reader->view->intrinsics.cy += 0.5 - center;
}

/* ---- which projection is said ---- */

/* What stands at a place of its own is seen as by a lens; what is fitted, as in a drawing. */
static void suggest_projection(struct zr_view *view)
{
    bool placed = view->pose == ZR_POSE_LOOK_AT || view->pose == ZR_POSE_MATRIX ||
                  (view->pose == ZR_POSE_ORBIT && view->distance > 0.0f);
    view->projection = placed ? ZR_PROJECTION_PERSPECTIVE : ZR_PROJECTION_ORTHOGRAPHIC;
    if (placed) view->yfov_radians = ZR_YFOV;
}

void zr_view_read_projection(struct zr_view_reader *reader)
{
    static const struct {
        enum zr_view_key key;
        enum zr_projection projection;
    } kinds[] = {{ZR_VIEW_PERSPECTIVE, ZR_PROJECTION_PERSPECTIVE},
                 {ZR_VIEW_ORTHOGRAPHIC, ZR_PROJECTION_ORTHOGRAPHIC},
                 {ZR_VIEW_INTRINSICS, ZR_PROJECTION_INTRINSICS},
                 {ZR_VIEW_K, ZR_PROJECTION_INTRINSICS},
                 {ZR_VIEW_PROJECTION_MATRIX, ZR_PROJECTION_MATRIX}};
    int said = -1, count = 0;
    for (int i = 0; i < (int)(sizeof kinds / sizeof kinds[0]); i++) {
        if (!reader->found[kinds[i].key]) continue;
        if (count++ > 0)
            zr_json_fault(reader->json, reader->path, "two projections: %s and %s", zr_view_words[kinds[said].key],
                          zr_view_words[kinds[i].key]);
        else
            said = i;
    }
    if (said < 0)
        suggest_projection(reader->view);
    else
        reader->view->projection = kinds[said].projection;
    if (count == 1) {
        enum zr_view_key key = kinds[said].key;
        if (key == ZR_VIEW_PERSPECTIVE) read_perspective(reader);
        if (key == ZR_VIEW_ORTHOGRAPHIC) read_orthographic(reader);
        if (key == ZR_VIEW_INTRINSICS) read_intrinsics(reader);
        if (key == ZR_VIEW_K) read_k(reader);
        if (key == ZR_VIEW_PROJECTION_MATRIX)
            zr_json_mat4(reader->json, ZR_VIEW_PATH(reader, key), reader->found[key], &reader->view->projection_matrix);
    }
    if (count <= 1 && reader->found[ZR_VIEW_PIXEL_CENTER]) read_pixel_center(reader);
}
