#include "input/parameters.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "input/channel_list.h"
#include "input/color_text.h"
#include "input/formats.h"
#include "input/json_objects.h"
#include "input/json_writer.h"
#include "input/kept.h"
#include "input/number.h"
#include "input/parameter_names.h"
#include "input/text.h"
#include "scene/defaults.h"
#include "scene/mesh_up.h"

/* ---- the tables ---- */

enum whose { ANY, MESH };
enum kind {
#define KIND(ID, ...) KIND_##ID,
    ZR_PARAMETER_KINDS(KIND)
#undef KIND
};

static const struct row {
    const char *name, *pointer;
    enum whose whose;
    enum kind kind;
    size_t offset; /* of its text, a const char * in struct zr_request */
} rows[] = {
#define PARAMETER(name, pointer, whose, kind, help)                                                                    \
    {#name, pointer, whose, KIND_##kind, offsetof(struct zr_request, name)},
    ZR_PARAMETER_ROWS(PARAMETER)
#undef PARAMETER
};
enum { ROWS = sizeof rows / sizeof rows[0] };
_Static_assert(ROWS <= 64, "a set of rows is a uint64_t");

/* Required keys of objects, added if the query has other keys of the object. */
static const struct {
    const char *pointer, *value;
} required[] = {
    {"/outputs/0/channel", "\"color\""}, {"/materials/0/name", "\"mesh\""}, {"/lights/0/type", "\"directional\""}};

static const char *const projections[] = {"orthographic", "perspective"};
static const struct zr_names projection_names = ZR_NAMES(2, projections);

/* Parameters that are no key of a scene. */
#define TIME_MAX   1e6 /* seconds */
#define AT(member) offsetof(struct zr_query, member)
static const struct zr_json_field query_fields[] = {
    {"compress", zr_json_choice, AT(compress), .words = &zr_compress_names, .text = "compression of PNGs"},
    {"strict", zr_json_bool, AT(is_strict), .text = "errors instead of warnings"},
    {"member", zr_json_string, AT(member), .text = "model of a ZIP archive"},
    {"up", zr_json_choice, AT(up), .words = &zr_mesh_up_names, .text = "axis of the mesh that points up"},
    {"camera", zr_json_string, AT(camera), .text = "camera of the file, by name or number"},
    {"projection", zr_json_choice, AT(projection), .words = &projection_names,
     .text = "kind of projection, with the look's angle of view"},
    {"animation", zr_json_string, AT(animation), .text = "animation of the file, by name or number"},
    {"fileLights", zr_json_bool, AT(has_file_lights), .text = "lights of the file instead of the look's"},
    {"time", zr_json_number, AT(time), 0, TIME_MAX, .unit = "seconds", .text = "time of the animation"}};
#undef AT
static const struct zr_json_object query_object = ZR_JSON_OBJECT_OF("query", query_fields);
static const char query_prefix[] = "/query/";

static const char *text_of(const struct zr_request *request, const struct row *row)
{
    return *(const char *const *)(const void *)((const char *)request + row->offset);
}

/* Returns the field that a pointer into a scene refers to. */
static const struct zr_json_field *field_of(const char *pointer)
{
    const struct zr_json_object *object = &zr_json_object_scene;
    const struct zr_json_field *field = NULL;
    for (const char *at = pointer; *at;) {
        const size_t length = strcspn(++at, "/");
        for (size_t i = 0; !zr_json_is_index(at) && i < object->count; i++) {
            const char *key = object->fields[i].key;
            if (strlen(key) == length && memcmp(key, at, length) == 0) field = &object->fields[i];
        }
        if (field->object) object = field->object;
        at += length;
    }
    return field;
}

/* Adds the required key before the first value of an object. */
static void put_required(struct zr_json_writer *json, const char *pointer)
{
    for (size_t i = 0; i < sizeof required / sizeof *required; i++) {
        const char *const key = required[i].pointer;
        const size_t object = (size_t)(strrchr(key, '/') + 1 - key);
        if (zr_json_shared(key, pointer) != object || zr_json_shared(key, json->pointer) == object ||
            strcmp(key, pointer) == 0)
            continue;
        zr_json_go_to(json, key);
        zr_json_put(json, required[i].value);
    }
}

/* ---- values ---- */

struct reading {
    const struct zr_request *request;
    const struct zr_limits *limits;
    struct zr_query *query;
    struct zr_error *error;
};

static bool refuse(const struct reading *r, const struct row *row, const char *text, const char *wanted)
{
    zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "parameter %s: %s is not %s", row->name,
                 zr_quote(text, strlen(text)).text, wanted);
    return false;
}

/* True if the text is exactly one number. */
static bool is_number(const char *text, size_t length, double *value)
{
    return zr_number_read(text, text + length, value) == text + length;
}

static bool put_in_range(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    const struct zr_json_field *field = field_of(row->pointer);
    double value;
    if (is_number(text, strlen(text), &value) && value >= field->low && value <= field->high) {
        zr_json_put_number(json, value);
        return true;
    }
    char wanted[120];
    snprintf(wanted, sizeof wanted, "a number%s%s from %g to %g", field->unit ? " of " : "",
             field->unit ? field->unit : "", field->low, field->high);
    return refuse(r, row, text, wanted);
}

static bool put_seconds(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    double value;
    if (!is_number(text, strlen(text), &value) || !(value >= 0.0 && value <= TIME_MAX))
        return refuse(r, row, text, "a number of seconds from 0 to 1e+06");
    zr_json_put_number(json, value);
    return true;
}

static bool put_positive(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    double value;
    if (!is_number(text, strlen(text), &value) || !(value <= (double)FLT_MAX) || !((float)value > 0.0f))
        return refuse(r, row, text, "a number greater than 0");
    zr_json_put_number(json, value);
    return true;
}

/* True for digits alone, at least one. *value is exact up to UINT32_MAX; larger numbers give some value above it. */
static bool is_whole(const char *text, uint64_t *value)
{
    const char *at = text;
    for (*value = 0; *at >= '0' && *at <= '9'; at++)
        if (*value <= UINT32_MAX) *value = *value * 10 + (uint64_t)(*at - '0');
    return *at == '\0' && at != text;
}

static bool put_side(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    const uint32_t most = r->limits->window_side_max;
    uint64_t value;
    char wanted[80];
    snprintf(wanted, sizeof wanted, "a whole number of pixels from 1 to %u", most);
    if (!is_whole(text, &value) || value < 1) return refuse(r, row, text, wanted);
    if (value > most) { /* well-formed, but too large: the same status as in a scene */
        zr_error_add(r->error, ZR_BAD_SCENE, NULL, "parameter %s: %s pixels; 1 to %u are allowed", row->name,
                     zr_quote(text, strlen(text)).text, most);
        return false;
    }
    zr_json_put_number(json, (double)value);
    return true;
}

static bool put_pixel(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    uint64_t value;
    if (!is_whole(text, &value) || value > UINT32_MAX)
        return refuse(r, row, text, "the number of a pixel, counted from 0");
    zr_json_put_number(json, (double)value);
    return true;
}

static bool put_vector(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    const char *at = text;
    for (int i = 0; i < 3; i++) {
        const size_t length = strcspn(at, ",");
        double value;
        if (!is_number(at, length, &value) || !(value >= -(double)FLT_MAX && value <= (double)FLT_MAX) ||
            at[length] != (i < 2 ? ',' : '\0'))
            return refuse(r, row, text, "three numbers with commas between them");
        zr_json_put(json, i == 0 ? "[" : ",");
        zr_json_put_number(json, value);
        at += length + 1;
    }
    zr_json_put(json, "]");
    return true;
}

static bool put_opaque(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    zr_vec4 color;
    if (!zr_color_of_text(text, strlen(text), &color))
        return refuse(r, row, text, "a colour: #rrggbb, #rgb, or a name of CSS");
    if (color.w < 1.0f) return refuse(r, row, text, "opaque, and only the background may be transparent");
    zr_json_put_string(json, text);
    return true;
}

static bool put_background(const struct reading *r, struct zr_json_writer *json, const struct row *row,
                           const char *text)
{
    zr_vec4 color;
    const char *const value = strcmp(text, "transparent") == 0 ? "#00000000" : text;
    if (!zr_color_of_text(value, strlen(value), &color))
        return refuse(r, row, text, "a colour: transparent, #rrggbb, #rrggbbaa, #rgb, #rgba, or a name of CSS");
    zr_json_put_string(json, value);
    return true;
}

static bool put_outline(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    if (strcmp(text, "true") != 0 && strcmp(text, "false") != 0) return put_opaque(r, json, row, text);
    zr_json_put(json, text);
    return true;
}

static bool put_flag(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    static const char *const words[] = {"false", "true", "0", "1"};
    static const struct zr_names names = ZR_NAMES(4, words);
    const int found = zr_names_of_query(row->name, &names, text, r->error);
    if (found < 0) return false;
    zr_json_put(json, words[found % 2]);
    return true;
}

static bool put_count(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    if (zr_names_of_query(row->name, field_of(row->pointer)->words, text, r->error) < 0) return false;
    zr_json_put(json, text);
    return true;
}

static bool put_name(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    (void)r;
    if (row->kind == KIND_NAME_OR_FALSE && strcmp(text, "false") == 0)
        zr_json_put(json, text);
    else
        zr_json_put_string(json, text);
    return true;
}

/* Writes the value as JSON; false after reporting. */
static bool put_value(const struct reading *r, struct zr_json_writer *json, const struct row *row, const char *text)
{
    static bool (*const by_kind[])(const struct reading *, struct zr_json_writer *, const struct row *,
                                   const char *) = {
        [KIND_NAME] = put_name,        [KIND_NAME_OR_FALSE] = put_name, [KIND_AXIS] = put_name,
        [KIND_BOOL] = put_flag,        [KIND_COUNT] = put_count,        [KIND_NUMBER] = put_in_range,
        [KIND_DEGREES] = put_in_range, [KIND_PIXELS] = put_in_range,    [KIND_UNITS] = put_positive,
        [KIND_SECONDS] = put_seconds,  [KIND_SIDE] = put_side,          [KIND_PIXEL] = put_pixel,
        [KIND_VECTOR] = put_vector,    [KIND_COLOR] = put_opaque,       [KIND_BACKGROUND] = put_background,
        [KIND_OUTLINE] = put_outline};
    return by_kind[row->kind](r, json, row, text);
}

/* ---- reading ---- */

/* Finds the first given parameter whose key is at the fault's pointer, within it or around it. NULL if there is none.
 */
static const char *name_of(const struct zr_request *request, const char *pointer)
{
    for (int i = 0; i < ROWS && *pointer; i++) {
        const char *key = rows[i].pointer;
        const size_t length = strlen(key) < strlen(pointer) ? strlen(key) : strlen(pointer);
        const bool is_inside = strchr("/", key[length]) && strchr("/", pointer[length]);
        if (text_of(request, &rows[i]) && is_inside && memcmp(key, pointer, length) == 0) return rows[i].name;
    }
    return NULL;
}

void zr_query_report(const struct zr_request *request, enum zr_status status, const struct zr_error *faults,
                     struct zr_error *error)
{
    for (size_t i = 0; i < zr_error_held(faults); i++) {
        const struct zr_error_item *item = &faults->items[i];
        const struct zr_output_pointer first = zr_output_pointer(item->pointer, 0);
        const char *name = name_of(request, first.text);
        if (name)
            zr_error_add(error, status, NULL, "parameter %s: %s", name,
                         zr_parameter_names(first.text, item->detail).text);
        else
            zr_error_add(error, status, item->pointer, "%s", item->detail);
    }
}

/* Drops the faults of rows that are reported already: bit i of `reported` is row i. */
static void drop_reported(struct zr_error *faults, uint64_t reported)
{
    size_t kept = 0;
    for (size_t k = 0; k < zr_error_held(faults); k++) {
        bool is_new = true;
        for (int i = 0; i < ROWS; i++)
            if (reported >> i & 1u && strcmp(rows[i].pointer, zr_output_pointer(faults->items[k].pointer, 0).text) == 0)
                is_new = false;
        if (is_new) faults->items[kept++] = faults->items[k];
    }
    faults->count = kept;
}

/* Reads {"query": {...}}, or keys of a scene. Rows in `reported` are null. */
static void read_text(const struct reading *r, const struct zr_json_writer *text, bool is_of_query, uint64_t reported)
{
    struct zr_query *query = r->query;
    struct zr_json *json = &query->given.json;
    struct zr_error faults = {0};
    uint64_t keys = 0;
    json->error = &faults;
    zr_json_open(json, text->text, text->used);
    if (is_of_query) {
        struct zr_json_text key;
        zr_json_enter(json, '{');
        zr_json_member(json, &key);
        zr_json_fields(json, ZR_JSON_KEY(NULL, query_object.name), &query_object, query, &keys);
    } else {
        zr_json_fields(json, NULL, &zr_json_object_scene, &query->given, &keys);
        query->given.keys |= keys;
    }
    drop_reported(&faults, reported);
    zr_query_report(r->request, ZR_BAD_REQUEST, &faults, r->error);
}

/* Reads the keys of a changed bare mesh, over those of the query. A view replaces that of the query. */
static void read_changed_keys(const struct reading *r, const struct zr_keeping *keeping)
{
    struct zr_parsed_scene *given = &r->query->given;
    struct zr_view *view = &given->scene->views[0];
    struct zr_scene plain;
    uint64_t keys = 0;
    zr_scene_defaults(&plain);
    plain.views[0].width = view->width;
    plain.views[0].height = view->height;
    plain.views[0].outputs = view->outputs;
    plain.views[0].output_count = view->output_count;
    if (keeping->has_view) *view = plain.views[0];
    given->json.error = r->error;
    zr_json_open(&given->json, keeping->keys, keeping->keys_size);
    zr_json_fields(&given->json, NULL, &zr_json_object_scene, given, &keys);
    given->keys |= keys;
}

/* Writes the rows of one object, or of the output `number`. A wrong value becomes null; the
 * other keys are still checked. Returns the rows with wrong values, one bit each. */
static uint64_t put_rows(const struct reading *r, const struct row *row, const struct row *end, size_t number,
                         struct zr_json_writer *json)
{
    const bool has_view = zr_format_rows[r->request->format].has_view;
    struct zr_arena *arena = r->query->given.json.arena;
    uint64_t reported = 0;
    for (const struct row *at = row; at < end; at++) {
        const char *text = zr_channel_list_text(r->request, arena, number, at->name, text_of(r->request, at));
        if (!text) continue;
        if (at->whose == MESH && has_view) {
            zr_error_add(r->error, ZR_BAD_REQUEST, NULL,
                         "parameter %s belongs to bodies that are a bare mesh; a scene has keys of its own for it",
                         at->name);
            continue;
        }
        struct zr_output_pointer *pointer = zr_arena_alloc(arena, 1, sizeof *pointer);
        if (!pointer) return reported;
        *pointer = zr_output_pointer(at->pointer, number);
        put_required(json, pointer->text);
        zr_json_go_to(json, pointer->text);
        const size_t used = json->used;
        if (put_value(r, json, at, text)) continue;
        json->used = used;
        zr_json_put(json, "null");
        reported |= UINT64_C(1) << (at - rows);
    }
    return reported;
}

/* Reads the rows of one object. Those of outputs may be several objects. */
static void read_rows(const struct reading *r, const struct row *row, const struct row *end)
{
    const bool is_outputs = strncmp(row->pointer, "/outputs/", strlen("/outputs/")) == 0;
    const size_t count = is_outputs ? zr_channel_list_count(r->request) : 1;
    size_t room = 0;
    for (const struct row *at = row; at < end; at++)
        if (text_of(r->request, at)) room += 2 * strlen(at->pointer) + 6 * strlen(text_of(r->request, at)) + 128;
    if (room == 0) return;
    if (count > ZR_CHANNEL_COUNT) {
        zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "parameter channel: %zu channels; up to %d are allowed", count,
                     ZR_CHANNEL_COUNT);
        return;
    }
    struct zr_json_writer json = {.text = zr_arena_alloc(r->query->given.json.arena, count * room, 1), .pointer = ""};
    uint64_t reported = 0;
    for (size_t number = 0; json.text && number < count; number++)
        reported |= put_rows(r, row, end, number, &json);
    if (json.used == 0) return;
    zr_json_go_to(&json, "");
    read_text(r, &json, strncmp(row->pointer, query_prefix, strlen(query_prefix)) == 0, reported);
}

static void open_query(const struct zr_request *request, const struct zr_limits *limits,
                       struct zr_scene_builder *builder, struct zr_query *query)
{
    const struct zr_format_row *format = &zr_format_rows[request->format];
    struct zr_parsed_scene *given = &query->given;
    *query = (struct zr_query){.request = request,
                               .given = {.json = {.arena = builder->arena, .limits = limits},
                                         .builder = builder,
                                         .scene = format->has_view ? &query->others : builder->scene,
                                         .is_bare = !format->has_view,
                                         .face_style = zr_face_style_unset},
                               .compress = ZR_UNSET,
                               .projection = ZR_UNSET,
                               .up = ZR_UNSET};
    if (format->has_view) return;
    /* A key of the query's view overrides that key of the look's view. */
    given->look = request->look ? zr_look_find(request->look) : NULL;
    if (!given->look) given->look = zr_look_find("studio");
    zr_look_set_view(given->look, &given->scene->views[0]);
}

enum zr_status zr_query_read(const struct zr_request *request, const struct zr_limits *limits,
                             struct zr_scene_builder *builder, struct zr_query *query, struct zr_error *error)
{
    struct zr_limits deep = *limits;
    const struct reading r = {request, &deep, query, error};
    deep.json_depth_max = ZR_JSON_DEPTH_MAX;
    open_query(request, &deep, builder, query);
    for (int first = 0, end = 0; first < ROWS; first = end) {
        const size_t object = 1 + strcspn(rows[first].pointer + 1, "/");
        while (end < ROWS && strncmp(rows[end].pointer, rows[first].pointer, object) == 0 &&
               strchr("/", rows[end].pointer[object]))
            end++;
        read_rows(&r, &rows[first], &rows[end]);
    }
    if (builder->keeping && builder->keeping->keys && error->count == 0) read_changed_keys(&r, builder->keeping);
    query->given.json.limits = limits;
    if (!zr_arena_ok(builder->arena)) return ZR_NO_MEMORY;
    return error->count > 0 ? error->status : ZR_OK;
}
