/* Reads sections: planes that cut the scene open. */
#include "base/vec.h"
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/text/recenter.h"

enum { UNCUT_MAX = 1024 };

static const char *const axes[] = {"x", "y", "z"};
static const struct zr_names axis_names = ZR_NAMES(3, axes);

/* In the order of enum zr_section_keep. */
static const char *const sides[] = {"far", "positive", "negative"};
static const struct zr_names side_names = ZR_NAMES(ZR_SECTION_KEEPS, sides);

struct given_plane {
    int axis, keep;
    double offset, fraction, point[3];
    zr_vec3 normal;
};

/* ---- one plane ---- */

/* zr_vec3 */
static bool read_normal(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    zr_vec3 v;
    if (!zr_json_vec3(json, path, &v)) return false;
    if (v.x == 0.0f && v.y == 0.0f && v.z == 0.0f) return zr_json_fault(json, path, "the normal has the length 0");
    *(zr_vec3 *)out = v;
    return true;
}

enum { AXIS, OFFSET, FRACTION, POINT, NORMAL, KEEP };
#define AT(member) offsetof(struct given_plane, member)
static const struct zr_json_field plane_fields[] = {
    [AXIS] = {"axis", zr_json_choice, AT(axis), .words = &axis_names,
              .text = "axis across which the plane lies, instead of point and normal"},
    [OFFSET] = {"offset", zr_json_number, AT(offset), -(double)ZR_MATRIX_MAX, (double)ZR_MATRIX_MAX,
                .unit = "scene units", .text = "place of the plane on the axis"},
    [FRACTION] = {"fraction", zr_json_number, AT(fraction), 0, 1, .otherwise = "0.5, without an offset",
                  .text = "place on the axis, as a share of the bounds of the scene"},
    [POINT] = {"point", zr_json_place3, AT(point), .unit = "scene units", .otherwise = "[0,0,0]",
               .text = "point of the plane"},
    [NORMAL] = {"normal", read_normal, AT(normal), .text = "direction across the plane, of any length",
                .schema = ZR_SCHEMA_OF("direction")},
    [KEEP] = {"keep", zr_json_choice, AT(keep), .words = &side_names, .otherwise = "far",
              .text =
                  "side that stays: the far one from the camera, or the one to which normal or axis points or not"}};
#undef AT
#define EXAMPLES "{\"axis\": \"x\", \"fraction\": 0.5}, or {\"point\": [0,0,0], \"normal\": [1,0,0]}"
static const struct zr_json_rule plane_rules[] = {
    {ZR_RULE_SOME, .text = "a plane takes an axis or a normal: " EXAMPLES, .sets = {ZR_KEY(AXIS) | ZR_KEY(NORMAL)}},
    {ZR_RULE_APART, .text = "a plane takes either an axis or a normal: " EXAMPLES,
     .sets = {ZR_KEY(AXIS), ZR_KEY(NORMAL)}},
    {ZR_RULE_AGAINST, .at_key = true, .text = "belongs to a normal; an axis takes an offset or a fraction",
     .sets = {ZR_KEY(AXIS), ZR_KEY(POINT)}},
    {ZR_RULE_AGAINST, .at_key = true, .text = "belongs to an axis; a normal takes a point",
     .sets = {ZR_KEY(NORMAL), ZR_KEY(OFFSET) | ZR_KEY(FRACTION)}},
    {ZR_RULE_APART, .text = "offset and fraction are two places: give one of them",
     .sets = {ZR_KEY(OFFSET), ZR_KEY(FRACTION)}}};
#undef EXAMPLES
const struct zr_json_object zr_json_object_plane = {ZR_JSON_FIELDS("plane", plane_fields), ZR_JSON_RULES(plane_rules)};

static bool read_plane(struct zr_json *json, const struct zr_json_path *path, struct zr_section *out)
{
    struct given_plane given = {.fraction = 0.5};
    const size_t faults = json->error->count;
    double *exact = given.point;
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_plane, &given, &keys) || zr_json_failed_since(json, faults))
        return false;
    *out = (struct zr_section){
        .keep = (enum zr_section_keep)given.keep,
        .normal = {(double)given.normal.x, (double)given.normal.y, (double)given.normal.z},
        .point = {zr_rounded(given.point[0]), zr_rounded(given.point[1]), zr_rounded(given.point[2])}};
    if (!zr_json_gives(keys, NORMAL)) {
        out->normal[given.axis] = 1.0;
        out->point[given.axis] = exact[given.axis] = given.offset;
    }
    for (int axis = 0; json->far && axis < 3; axis++)
        out->point[axis] = exact[axis] - json->far->origin[axis];
    if (zr_json_gives(keys, NORMAL)) return true;
    out->fraction = given.fraction;
    out->has_fraction = !zr_json_gives(keys, OFFSET);
    return true;
}

/* ---- lists ---- */

static bool read_planes(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_sections *sections = out;
    size_t count, number = 0;
    bool is_good = true;
    if (!zr_json_count(json, path, &count)) return false;
    if (count < 1 || count > ZR_SECTION_PLANES_MAX)
        return zr_json_skip(json) &&
               zr_json_fault(json, path, "%zu planes; 1 to %d are allowed", count, ZR_SECTION_PLANES_MAX);
    for (zr_json_enter(json, '['); zr_json_item(json); number++)
        is_good = read_plane(json, ZR_JSON_ITEM(path, number), &sections->planes[number]) && is_good;
    sections->count = (uint32_t)count;
    return is_good;
}

static bool read_uncut(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_sections *sections = out;
    size_t count, number = 0;
    bool is_good = true;
    const char **names = zr_json_enter_list(json, path, "names", UNCUT_MAX, sizeof *names, &count);
    if (!names) return false;
    for (; zr_json_item(json); number++)
        is_good = zr_json_string(json, ZR_JSON_ITEM(path, number), &names[number]) && is_good;
    if (!is_good) return false;
    sections->uncut = names;
    sections->uncut_count = (uint32_t)count;
    return true;
}

/* ---- the object ---- */

#define AT(member) offsetof(struct zr_sections, member)
static const struct zr_json_field fields[] = {
    {"planes", read_planes, 0, .object = &zr_json_object_plane, .required = true,
     .text = "list of 1 to 6 cuts, such as [{\"axis\": \"x\"}]",
     .schema = ZR_SCHEMA({"type" : "array", "items" : {"$ref" : "#/$defs/plane"}, "minItems" : 1, "maxItems" : 6})},
    {"corner", zr_json_bool, AT(is_corner), .otherwise = "false",
     .text = "removes only what all planes cut away, instead of what any of them does"},
    {"hatch", zr_json_bool, AT(has_hatch), .otherwise = "true", .text = "lines on the caps, by part"},
    {"uncut", read_uncut, 0, .otherwise = "[]", .text = "names of parts that stay whole, as in info",
     .schema = ZR_SCHEMA({"type" : "array", "items" : {"type" : "string"}, "maxItems" : 1024})}};
#undef AT
const struct zr_json_object zr_json_object_sections = ZR_JSON_OBJECT_OF("sections", fields);

bool zr_read_sections(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_sections given = {.has_hatch = true};
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_sections, &given, &keys)) return false;
    root->scene->sections = given;
    return true;
}
