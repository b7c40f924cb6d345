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

#define AT(member) offsetof(struct zr_dimension, member)
static const struct zr_json_field fields[] = {
    {"from", zr_json_place, AT(from), .required = true, .unit = "scene units", .text = "first place"},
    {"to", zr_json_place, AT(to), .required = true, .unit = "scene units", .text = "second place"},
    {"along", zr_json_choice, AT(along), .words = &axis_names, .otherwise = "the distance",
     .text = "axis along which the distance is measured"},
    {"label", zr_json_string, AT(label), .otherwise = "the length", .text = "text instead of the length"}};
#undef AT
const struct zr_json_object zr_json_object_dimension = ZR_JSON_OBJECT_OF("dimension", fields);

static bool read_dimension(struct zr_json *json, const struct zr_json_path *path, struct zr_dimension *out)
{
    struct zr_dimension given = {.along = -1};
    uint64_t keys;
    if (!zr_json_fields(json, path, &zr_json_object_dimension, &given, &keys)) return false;
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
    if (!zr_json_count(json, path, &count)) return false;
    if (count > ZR_DIMENSIONS_MAX) {
        zr_json_skip(json);
        return zr_json_fault(json, path, "%zu dimensions; up to %d are allowed", count, ZR_DIMENSIONS_MAX);
    }
    struct zr_dimension *at = zr_arena_zero(json->arena, count ? count : 1, sizeof *at);
    for (zr_json_enter(json, '['); at && zr_json_item(json); number++)
        is_good = read_dimension(json, ZR_JSON_ITEM(path, number), &at[number]) && is_good;
    annotate->dimensions = at;
    annotate->dimension_count = at ? (uint32_t)count : 0;
    return is_good && at;
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
    if (!zr_json_count(json, path, &count)) return false;
    if (count > ZR_PLACE_MARKS_MAX) {
        zr_json_skip(json);
        return zr_json_fault(json, path, "%zu marks; up to %d are allowed", count, ZR_PLACE_MARKS_MAX);
    }
    struct zr_place_mark *at = zr_arena_zero(json->arena, count ? count : 1, sizeof *at);
    for (zr_json_enter(json, '['); at && zr_json_item(json); number++)
        is_good = zr_json_fields(json, ZR_JSON_ITEM(path, number), &zr_json_object_mark, &at[number], &keys) && is_good;
    annotate->marks = at;
    annotate->mark_count = at ? (uint32_t)count : 0;
    return is_good && at;
}
