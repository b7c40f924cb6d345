#include "input/query/query_plain.h"

#include <string.h>

#include "input/json/json_writer.h"
#include "input/query/parameter_values.h"
#include "input/query/parameters.h"
#include "input/text/color_text.h"
#include "scene/looks.h"

/* Values that are the same as no parameter, for all files. */
static const struct {
    const char *name, *value;
} defaults[] = {{"compress", "\"fast\""}, {"strict", "false"}, {"fileLights", "false"}};

size_t zr_query_plain_room(const struct zr_request *request)
{
    size_t room = sizeof "{,\"mesh\":true}";
    for (const struct zr_parameter_row *row = zr_parameter_list; row < zr_parameter_list + zr_parameter_count; row++)
        if (zr_parameter_text(request, row))
            room += strlen(row->name) + 4 + 6 * strlen(zr_parameter_text(request, row)) + ZR_PARAMETER_ROOM;
    return room;
}

/* Writes a colour as its numbers. False: it is none. */
static bool put_color(enum zr_parameter_kind kind, const char *text, struct zr_json_writer *json)
{
    zr_vec4 color;
    if (kind != ZR_PARAMETER_COLOR && kind != ZR_PARAMETER_BACKGROUND && kind != ZR_PARAMETER_OUTLINE) return false;
    if (!zr_color_of_text(text, strlen(text), &color)) return false;
    const float parts[] = {color.x, color.y, color.z, color.w};
    for (int i = 0; i < 4; i++) {
        zr_json_put(json, i == 0 ? "[" : ",");
        zr_json_put_number(json, (double)parts[i]);
    }
    zr_json_put(json, "]");
    return true;
}

static void put_value(const struct zr_parameter_row *row, const char *text, const struct zr_limits *limits,
                      struct zr_error *ignored, struct zr_json_writer *json)
{
    const struct zr_parameter parameter = {row->name, row->kind, zr_parameter_field(row->pointer), limits, ignored};
    const struct zr_look *look = strcmp(row->name, "look") == 0 ? zr_look_find(text) : NULL;
    const size_t used = json->used;
    if (look)
        zr_json_put_string(json, zr_look_pin_of(look).text);
    else if (!zr_parameter_put(&parameter, text, json)) {
        json->used = used;
        zr_json_put_string(json, text);
    } else {
        char *const put = json->text + used;
        json->used = used;
        if (!put_color(row->kind, text, json)) json->used = used + strlen(put);
    }
}

static bool is_default(const struct zr_parameter_row *row, const char *value)
{
    for (size_t i = 0; i < sizeof defaults / sizeof *defaults; i++)
        if (strcmp(defaults[i].name, row->name) == 0) return strcmp(defaults[i].value, value) == 0;
    return false;
}

void zr_query_plain(const struct zr_request *request, const struct zr_limits *limits, char *room)
{
    struct zr_json_writer json = {.text = room, .pointer = ""};
    struct zr_error ignored = {0};
    bool is_of_mesh = false, has_mesh_default = false;
    zr_json_put(&json, "{");
    for (const struct zr_parameter_row *row = zr_parameter_list; row < zr_parameter_list + zr_parameter_count; row++) {
        const char *text = zr_parameter_text(request, row);
        const size_t begin = json.used;
        if (!text) continue;
        zr_json_put(&json, begin > 1 ? ",\"" : "\"");
        zr_json_put(&json, row->name);
        zr_json_put(&json, "\":");
        const size_t value = json.used;
        put_value(row, text, limits, &ignored, &json);
        const bool is_left_out = is_default(row, json.text + value);
        if (is_left_out) json.used = begin;
        if (row->scope == ZR_PARAMETER_OF_MESH) *(is_left_out ? &has_mesh_default : &is_of_mesh) = true;
    }
    /* A scene refuses parameters of meshes, those at their defaults too. */
    if (has_mesh_default && !is_of_mesh) zr_json_put(&json, json.used > 1 ? ",\"mesh\":true" : "\"mesh\":true");
    zr_json_put(&json, "}");
}
