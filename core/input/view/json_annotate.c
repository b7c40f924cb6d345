/* Reads the annotations of a picture: annotate, title, dimensions and marks. */
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/text/names.h"

bool zr_read_annotate(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_annotate *annotate = &root->scene->views[0].annotate;
    size_t number = 0;
    bool is_good = true;
    annotate->words = 0;
    if (!zr_json_list(json, path)) return false;
    for (zr_json_enter(json, '['); zr_json_item(json); number++) {
        int word = 0;
        if (zr_json_choice_of(json, ZR_JSON_ITEM(path, number), &zr_annotation_names, &word))
            annotate->words |= 1u << word;
        else
            is_good = false;
    }
    return is_good;
}

bool zr_read_title(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    return zr_json_string(json, path, &root->scene->views[0].annotate.title);
}

static const char *const axes[] = {"x", "y", "z"};
static const struct zr_names axis_names = ZR_NAMES(3, axes);

static const char *const kinds[] = {"length", "radius", "diameter", "angle"};
static const struct zr_names kind_names = ZR_NAMES(4, kinds);

/* uint32_t[2] */
static bool read_pixel(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    uint32_t *pixel = out;
    double numbers[2];
    if (!zr_json_numbers(json, path, (struct zr_json_row){2, 2, 0.0, (double)UINT32_MAX}, numbers, NULL)) return false;
    for (size_t i = 0; i < 2; i++)
        if ((double)(uint32_t)numbers[i] != numbers[i])
            return zr_json_fault(json, ZR_JSON_ITEM(path, i), "%.9g is not a whole number", numbers[i]);
    pixel[0] = (uint32_t)numbers[0];
    pixel[1] = (uint32_t)numbers[1];
    return true;
}

#define AT(member) offsetof(struct zr_dimension_end, member)
enum { END_HOLE, END_INDEX, END_PART, END_PICK };
static const struct zr_json_field end_fields[] = {
    [END_HOLE] = {"hole", zr_json_whole, AT(hole), .text = "number of a group of holes in the features of the part"},
    [END_INDEX] = {"index", zr_json_whole, AT(index), .otherwise = "0", .text = "number of a hole in its group"},
    [END_PART] = {"part", zr_json_string, AT(part), .otherwise = "the first part with holes",
                  .text = "name of the part that has the hole"},
    [END_PICK] = {
        "pick", read_pixel, AT(pixel), .text = "pixel, whose surface has the place",
        .schema = ZR_SCHEMA(
            {"type" : "array", "items" : {"type" : "integer", "minimum" : 0}, "minItems" : 2, "maxItems" : 2})}};
#undef AT
const struct zr_json_object zr_json_object_dimensionEnd = ZR_JSON_OBJECT_OF("dimensionEnd", end_fields);

/* struct zr_dimension_end */
static bool read_end(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_dimension_end end = {.place = {0, 0, 0}};
    uint64_t keys = 0;
    if (zr_json_type(json) != ZR_JSON_OBJECT) {
        if (!zr_json_place(json, path, &end.place)) return false;
        *(struct zr_dimension_end *)out = end;
        return true;
    }
    if (!zr_json_fields(json, path, &zr_json_object_dimensionEnd, &end, &keys)) return false;
    end.is_hole = keys >> END_HOLE & 1;
    end.is_pick = keys >> END_PICK & 1;
    if (end.is_hole == end.is_pick)
        return zr_json_fault(json, path,
                             end.is_hole ? "both hole and pick; give one of them"
                                         : "neither hole nor pick; give one of them");
    if (end.is_pick && keys != (uint64_t)1 << END_PICK)
        return zr_json_fault(json, path, "index and part belong to a hole, and this is a pick");
    *(struct zr_dimension_end *)out = end;
    return true;
}

#define END_SCHEMA ZR_SCHEMA({"anyOf" : [ {"$ref" : "#/$defs/place"}, {"$ref" : "#/$defs/dimensionEnd"} ]})
#define AT(member) offsetof(struct zr_dimension, member)
enum { FROM, TO, APEX };
static const struct zr_json_field fields[] = {
    [FROM] = {"from", read_end, AT(from), .required = true, .object = &zr_json_object_dimensionEnd,
              .unit = "scene units", .schema = END_SCHEMA, .text = "first place, or an object"},
    [TO] = {"to", read_end, AT(to), .object = &zr_json_object_dimensionEnd, .unit = "scene units", .schema = END_SCHEMA,
            .otherwise = "the circle of the hole from", .text = "second place, or an object"},
    [APEX] = {"at", read_end, AT(at), .object = &zr_json_object_dimensionEnd, .unit = "scene units",
              .schema = END_SCHEMA, .otherwise = "none", .text = "apex of an angle"},
    {"type", zr_json_choice, AT(kind), .words = &kind_names, .otherwise = "length",
     .text = "length; radius or diameter of the circle around from through to; angle at the apex at"},
    {"along", zr_json_choice, AT(along), .words = &axis_names, .otherwise = "the distance",
     .text = "axis along which the distance is measured"},
    {"label", zr_json_string, AT(label), .otherwise = "the length", .text = "text instead of the length"}};
#undef AT
const struct zr_json_object zr_json_object_dimension = ZR_JSON_OBJECT_OF("dimension", fields);

/* Keys that belong to some types only. */
static bool check_type(struct zr_json *json, const struct zr_json_path *path, const struct zr_dimension *given)
{
    const bool is_angle = given->kind == ZR_DIMENSION_ANGLE;
    const bool is_round = given->kind == ZR_DIMENSION_RADIUS || given->kind == ZR_DIMENSION_DIAMETER;
    if (is_angle != given->has_at)
        return zr_json_fault(json, path,
                             is_angle ? "an angle needs the key at, its apex"
                                      : "the key at, an apex, belongs to the type angle only");
    if (!given->has_to && !(is_round && given->from.is_hole)) return zr_json_fault(json, path, "to is missing");
    if (given->along >= 0 && (is_angle || is_round))
        return zr_json_fault(json, path, "the key along belongs to the type length only");
    return true;
}

static bool read_dimension(struct zr_json *json, const struct zr_json_path *path, struct zr_dimension *out)
{
    struct zr_dimension given = {.along = -1};
    uint64_t keys;
    const size_t faults = json->error->count;
    if (!zr_json_fields(json, path, &zr_json_object_dimension, &given, &keys)) return false;
    given.has_to = keys >> TO & 1;
    given.has_at = keys >> APEX & 1;
    if (json->error->count > faults || !check_type(json, path, &given)) return false;
    *out = given;
    return true;
}

bool zr_read_dimensions(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_annotate *annotate = &root->scene->views[0].annotate;
    size_t count = 0, number = 0;
    bool is_good = true;
    annotate->dimension_count = 0;
    struct zr_dimension *at = zr_json_enter_list(json, path, "dimensions", ZR_DIMENSIONS_MAX, sizeof *at, &count);
    if (!at) return false;
    for (; zr_json_item(json); number++)
        is_good = read_dimension(json, ZR_JSON_ITEM(path, number), &at[number]) && is_good;
    annotate->dimensions = at;
    annotate->dimension_count = (uint32_t)count;
    return is_good;
}

#define AT(member) offsetof(struct zr_place_mark, member)
static const struct zr_json_field mark_fields[] = {
    {"at", zr_json_place, AT(at), .required = true, .unit = "scene units", .text = "place"},
    {"text", zr_json_string, AT(text), .required = true, .text = "number or short text beside it"}};
#undef AT
const struct zr_json_object zr_json_object_mark = ZR_JSON_OBJECT_OF("mark", mark_fields);

bool zr_read_marks(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_annotate *annotate = &root->scene->views[0].annotate;
    size_t count = 0, number = 0;
    uint64_t keys;
    bool is_good = true;
    annotate->mark_count = 0;
    struct zr_place_mark *at = zr_json_enter_list(json, path, "marks", ZR_PLACE_MARKS_MAX, sizeof *at, &count);
    if (!at) return false;
    for (; zr_json_item(json); number++)
        is_good = zr_json_fields(json, ZR_JSON_ITEM(path, number), &zr_json_object_mark, &at[number], &keys) && is_good;
    annotate->marks = at;
    annotate->mark_count = (uint32_t)count;
    return is_good;
}
