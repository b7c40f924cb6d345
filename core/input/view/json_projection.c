/* Readers of a view's projections. */
#include "input/scene/json_objects.h"
#include "input/view/view_keys.h"

#define PI 3.14159265358979323846

/* Pixels: the largest is far beyond any lens, and a finite float after division by a window's side. */
#define FOCAL_MIN  1e-6
#define PIXELS_MAX 1e9

/* ---- perspective ---- */

static float radians(double degrees)
{
    return (float)(degrees * PI / 180);
}

/* float, radians: field->high is half a turn, in radians or degrees. The message suggests degrees for a large number of
 * radians. */
static bool read_angle(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const bool degrees = path->field->high > 4;
    double value;
    if (zr_json_type(json) != ZR_JSON_NUMBER) return zr_json_number(json, path, out);
    if (!zr_json_take_number(json, &value)) return false;
    if (!degrees && value > PI && value < 360)
        return zr_json_fault(json, path, "%.9g is more than half a turn: %s takes radians, %sDegrees takes degrees",
                             value, path->field->key, path->field->key);
    if (!(value >= 0 && value <= path->field->high))
        return zr_json_fault(json, path, "%.10g is outside of %.10g to %.10g", value, 0.0, path->field->high);
    const float angle = degrees ? radians(value) : (float)value;
    /* In float: an angle that rounds to 0 or to half a turn has no usable tangent. */
    if (!(angle > 0.0f) || !(angle < (float)PI))
        return zr_json_fault(json, path, "%.9g: an angle between 0 and 180 degrees, both excluded, is needed", value);
    *(float *)out = angle;
    return true;
}

struct given_angles {
    float yfov, xfov;
};
#define HALF_TURN         ZR_SCHEMA({"type" : "number", "exclusiveMinimum" : 0, "exclusiveMaximum" : 3.14159265})
#define HALF_TURN_DEGREES ZR_SCHEMA({"type" : "number", "exclusiveMinimum" : 0, "exclusiveMaximum" : 180})
#define AT(member)        offsetof(struct given_angles, member)
static const struct zr_json_field angle_fields[] = {
    {"yfov", read_angle, AT(yfov), 0, PI, .unit = "radians", .text = "vertical angle of view", .schema = HALF_TURN},
    {"yfovDegrees", read_angle, AT(yfov), 0, 180, .unit = "degrees", .text = "vertical angle of view",
     .schema = HALF_TURN_DEGREES},
    {"xfov", read_angle, AT(xfov), 0, PI, .unit = "radians", .text = "horizontal angle of view", .schema = HALF_TURN},
    {"xfovDegrees", read_angle, AT(xfov), 0, 180, .unit = "degrees", .text = "horizontal angle of view",
     .schema = HALF_TURN_DEGREES}};
#undef AT
static const struct zr_json_rule angle_rules[] = {
    {ZR_RULE_APART, .text = "two angles: %s and %s", .sets = {ZR_KEY(0), ZR_KEY(1), ZR_KEY(2), ZR_KEY(3)}},
    {ZR_RULE_SOME, .text = "no angle; one of yfov, yfovDegrees, xfov, xfovDegrees is needed",
     .sets = {ZR_KEY(0) | ZR_KEY(1) | ZR_KEY(2) | ZR_KEY(3)}}};
const struct zr_json_object zr_json_object_perspective = {ZR_JSON_FIELDS("perspective", angle_fields),
                                                          ZR_JSON_RULES(angle_rules)};

bool zr_read_perspective(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_view *given = out;
    struct given_angles angles = {0, 0};
    const size_t faults = json->error->count;
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_perspective, &angles, &keys)) return false;
    given->view.yfov_radians = angles.yfov;
    given->view.xfov_radians = angles.xfov;
    return json->error->count == faults;
}

/* ---- orthographic ---- */

enum { XMAG, YMAG };
static const struct zr_json_field orthographic_fields[] = {
    [XMAG] = {"xmag", zr_json_positive, offsetof(struct zr_parsed_view, view.xmag), .unit = "scene units",
              .otherwise = "fitted to the geometry", .text = "half of the width of the view"},
    [YMAG] = {"ymag", zr_json_positive, offsetof(struct zr_parsed_view, view.ymag), .unit = "scene units",
              .otherwise = "fitted to the geometry", .text = "half of the height of the view"}};
static const struct zr_json_rule orthographic_rules[] = {
    {ZR_RULE_ALL, .text = "%s is missing; give xmag and ymag, or neither to fit the geometry",
     .sets = {ZR_KEY(XMAG) | ZR_KEY(YMAG)}}};
const struct zr_json_object zr_json_object_orthographic = {ZR_JSON_FIELDS("orthographic", orthographic_fields),
                                                           ZR_JSON_RULES(orthographic_rules)};

bool zr_read_orthographic(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    uint64_t keys;
    return zr_json_fields(json, path, &zr_json_object_orthographic, out, &keys);
}

/* ---- intrinsics ---- */

bool zr_view_check_focal(struct zr_json *json, const struct zr_json_path *path, double value)
{
    return value >= FOCAL_MIN ||
           zr_json_fault(json, path, "%.9g is no focal length in pixels: %g and more is allowed", value, FOCAL_MIN);
}

static bool read_focal(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double value;
    if (!zr_json_number(json, path, &value) || !zr_view_check_focal(json, path, value)) return false;
    *(double *)out = value;
    return true;
}

enum { FX, FY, CX, CY, SKEW };
#define PIXELS(key, read, member)                                                                                      \
    key, read, offsetof(struct zr_intrinsics, member), -PIXELS_MAX, PIXELS_MAX, .unit = "pixels"
static const struct zr_json_field intrinsics_fields[] = {
    [FX] = {PIXELS("fx", read_focal, fx), .required = true, .text = "horizontal focal length",
            .schema = ZR_SCHEMA_OF("focal")},
    [FY] = {PIXELS("fy", read_focal, fy), .otherwise = "fx", .text = "vertical focal length",
            .schema = ZR_SCHEMA_OF("focal")},
    [CX] = {PIXELS("cx", zr_json_number, cx), .otherwise = "the middle", .text = "principal point, from the left"},
    [CY] = {PIXELS("cy", zr_json_number, cy), .otherwise = "the middle", .text = "principal point, from the top"},
    [SKEW] = {PIXELS("skew", zr_json_number, skew), .otherwise = "0", .text = "change of x with y"}};
const struct zr_json_object zr_json_object_intrinsics = ZR_JSON_OBJECT_OF("intrinsics", intrinsics_fields);

bool zr_read_intrinsics(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_intrinsics *intrinsics = &((struct zr_parsed_view *)out)->intrinsics;
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_intrinsics, intrinsics, &keys)) return false;
    if (!zr_json_gives(keys, FY)) intrinsics->fy = intrinsics->fx;
    intrinsics->has_cx = zr_json_gives(keys, CX);
    intrinsics->has_cy = zr_json_gives(keys, CY);
    return true;
}
