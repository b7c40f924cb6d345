/* Reads the keys of parts. part_select.h compares their names with the parts once the scene is complete. */
#include <stdio.h>
#include <string.h>

#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"

enum { PATTERNS_MAX = 1000, PATTERN_BYTES_MAX = 1024, HIGHLIGHTS_MAX = 64 };

/* ---- sets of parts ---- */

static bool read_text(struct zr_json *json, const struct zr_json_path *path, struct zr_part_pattern *out)
{
    const char *text = "";
    if (!zr_json_string(json, path, &text)) return false;
    const size_t length = strlen(text);
    if (length == 0) return zr_json_fault(json, path, "the text is empty; a name, a pattern or an id is needed");
    if (length > PATTERN_BYTES_MAX)
        return zr_json_fault(json, path, "%zu bytes; up to %d are allowed", length, PATTERN_BYTES_MAX);
    *out = (struct zr_part_pattern){.text = text};
    return true;
}

static bool read_pattern(struct zr_json *json, const struct zr_json_path *path, struct zr_part_pattern *out)
{
    const enum zr_json_type type = zr_json_type(json);
    uint32_t id;
    if (type == ZR_JSON_STRING) return read_text(json, path, out);
    if (type != ZR_JSON_NUMBER) return zr_json_expect(json, path, "the name of a part, a pattern or an id");
    if (!zr_json_whole(json, path, &id)) return false;
    *out = (struct zr_part_pattern){.id = (double)id};
    return true;
}

/* Reads a list of patterns. */
static bool read_list(struct zr_json *json, const struct zr_json_path *path, struct zr_part_set *out)
{
    size_t count, read = 0;
    struct zr_part_pattern *patterns = zr_json_enter_list(json, path, "names", PATTERNS_MAX, sizeof *patterns, &count);
    if (!patterns) return false;
    bool is_good = true;
    for (; zr_json_item(json); read++)
        is_good = read_pattern(json, ZR_JSON_ITEM(path, read), &patterns[read]) && is_good;
    out->count = (uint32_t)count;
    out->patterns = patterns;
    out->is_list = true;
    return is_good;
}

bool zr_read_part_set(struct zr_json *json, const struct zr_json_path *path, struct zr_part_set *out)
{
    *out = (struct zr_part_set){.pointer = zr_json_pointer(json->arena, path)};
    if (!out->pointer) return false;
    if (zr_json_type(json) == ZR_JSON_LIST) {
        if (read_list(json, path, out)) return true;
        out->count = 0;
        return false;
    }
    struct zr_part_pattern *pattern = zr_arena_zero(json->arena, 1, sizeof *pattern);
    if (!pattern || !read_pattern(json, path, pattern)) return false;
    out->count = 1;
    out->patterns = pattern;
    return true;
}

bool zr_read_hide(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_read_part_set(json, path, &((struct zr_parsed_scene *)out)->scene->parts.hide);
}

bool zr_read_isolate(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_read_part_set(json, path, &((struct zr_parsed_scene *)out)->scene->parts.isolate);
}

bool zr_read_ghost(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_read_part_set(json, path, &((struct zr_parsed_scene *)out)->scene->parts.ghost);
}

/* ---- highlights ---- */

static const zr_vec4 highlight_color = {1.0f, 0x6a / 255.0f, 0, 1}; /* #ff6a00 */

/* struct zr_part_set */
static bool read_parts(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    return zr_read_part_set(json, path, out);
}

static const struct zr_json_field highlight_fields[] = {
    {"parts", read_parts, offsetof(struct zr_part_highlight, parts), .required = true,
     .text = "parts: a name, a pattern, an id, or a list of these", .schema = ZR_SCHEMA_OF("parts")},
    {"color", zr_json_opaque, offsetof(struct zr_part_highlight, color), .otherwise = "#ff6a00",
     .text = "colour that replaces the colours and base colour textures of these parts"}};
const struct zr_json_object zr_json_object_highlight = ZR_JSON_OBJECT_OF("highlight", highlight_fields);

/* Reads an object, or parts that get the default colour. */
static bool read_one_highlight(struct zr_json *json, const struct zr_json_path *path, struct zr_part_highlight *out)
{
    uint64_t keys;
    *out = (struct zr_part_highlight){.color = highlight_color};
    if (zr_json_type(json) != ZR_JSON_OBJECT) return zr_read_part_set(json, path, &out->parts);
    return zr_json_fields(json, path, &zr_json_object_highlight, out, &keys);
}

/* True if the next value is a list that contains an object. */
static bool has_objects(const struct zr_json *json)
{
    struct zr_json there = zr_json_at(json, json->at);
    if (zr_json_type(&there) != ZR_JSON_LIST) return false;
    zr_json_enter(&there, '[');
    while (zr_json_item(&there)) {
        if (zr_json_type(&there) == ZR_JSON_OBJECT) return true;
        if (!zr_json_skip(&there)) return false;
    }
    return false;
}

bool zr_read_highlight(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_part_keys *keys = &((struct zr_parsed_scene *)out)->scene->parts;
    size_t count = 1, read = 0;
    keys->highlight_count = 0;
    zr_json_type(json);
    const bool is_list = has_objects(json);
    if (is_list && !zr_json_count(json, path, &count)) return false;
    if (count > HIGHLIGHTS_MAX) {
        zr_json_fault(json, path, "%zu highlights; up to %d are allowed", count, HIGHLIGHTS_MAX);
        return zr_json_skip(json) && false;
    }
    struct zr_part_highlight *highlights = zr_arena_zero(json->arena, count, sizeof *highlights);
    if (!highlights) return false;
    keys->highlights = highlights;
    keys->highlight_count = (uint32_t)count;
    if (!is_list) return read_one_highlight(json, path, highlights);
    bool is_good = true;
    zr_json_enter(json, '[');
    for (; zr_json_item(json); read++)
        is_good = read_one_highlight(json, ZR_JSON_ITEM(path, read), &highlights[read]) && is_good;
    return is_good;
}

/* ---- explosion and colours ---- */

#define FACTOR_MAX 100.0

static const char *const axes[] = {"radial", "x", "y", "z"};
static const struct zr_names axis_names = ZR_NAMES(ZR_EXPLODE_AXES, axes);
static const char *const colors[] = {"own", "parts", "materials", "x", "y", "z"};
const struct zr_names zr_part_color_names = ZR_NAMES(ZR_COLORS_COUNT, colors);

struct given_explode {
    double factor;
    int axis;
};

static const struct zr_json_field explode_fields[] = {
    {"factor", zr_json_number, offsetof(struct given_explode, factor), 0, FACTOR_MAX, .required = true,
     .text = "each part moves by this factor times its distance from the middle of all parts"},
    {"axis", zr_json_choice, offsetof(struct given_explode, axis), .words = &axis_names, .otherwise = "radial",
     .text = "axis of world space along which parts move; radial: in all directions"}};
const struct zr_json_object zr_json_object_explode = ZR_JSON_OBJECT_OF("explode", explode_fields);

bool zr_read_explode(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_part_keys *keys = &((struct zr_parsed_scene *)out)->scene->parts;
    struct given_explode given = {.factor = 0.0};
    const enum zr_json_type type = zr_json_type(json);
    uint64_t set;
    if (type == ZR_JSON_NUMBER) {
        if (!zr_json_number_in(json, path, 0, FACTOR_MAX, &given.factor)) return false;
    } else if (type == ZR_JSON_OBJECT) {
        if (!zr_json_fields(json, path, &zr_json_object_explode, &given, &set)) return false;
    } else {
        return zr_json_expect(json, path, "a number or an object");
    }
    keys->explode = given.factor;
    keys->explode_axis = (enum zr_explode_axis)given.axis;
    return true;
}

bool zr_read_colors(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    int which = 0;
    if (!zr_json_choice(json, path, &which)) return false;
    ((struct zr_parsed_scene *)out)->scene->parts.colors = (enum zr_color_source)which;
    return true;
}
