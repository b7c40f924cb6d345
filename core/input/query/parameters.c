#include "input/query/parameters.h"

#include <stdio.h>
#include <string.h>

#include "input/formats/formats.h"
#include "input/json/json_writer.h"
#include "input/query/parameter_values.h"
#include "input/scene/json_objects.h"
#include "input/scene/kept.h"
#include "input/scene/outputs.h"
#include "input/text/parameter_names.h"
#include "render_request.h"
#include "scene/camera/mesh_up.h"
#include "scene/defaults.h"
#include "scene/parsed_picture.h"

/* ---- the parameter channel as a list, "color,depth", with the other parameters of outputs ---- */

static const char prefix[] = "/outputs/";

/* A JSON Pointer into outputs, with another number. */
struct output_pointer {
    char text[120];
};

static struct output_pointer output_pointer(const char *pointer, size_t number)
{
    struct output_pointer out;
    const size_t begin = sizeof prefix - 1;
    if (strncmp(pointer, prefix, begin) == 0)
        snprintf(out.text, sizeof out.text, "%s%zu%s", prefix, number,
                 pointer + begin + strspn(pointer + begin, "0123456789"));
    else
        snprintf(out.text, sizeof out.text, "%s", pointer);
    return out;
}

/* Returns the number of channels in the list, at least 1. */
static size_t count_channels(const struct zr_request *request)
{
    size_t count = 1;
    for (const char *at = request->channel; at && (at = strchr(at, ',')) != NULL; at++)
        count++;
    return count;
}

/* Returns the channel `number` of the list; *length: of its name. */
static const char *channel_at(const struct zr_request *request, size_t number, size_t *length)
{
    const char *at = request->channel;
    for (; number > 0; number--)
        at += strcspn(at, ",") + 1;
    *length = strcspn(at, ",");
    return at;
}

/* True if the parameter belongs to channel `number` of the list. */
static bool belongs(const struct zr_request *request, size_t number, const char *parameter)
{
    char name[32];
    size_t length;
    const char *at = channel_at(request, number, &length);
    snprintf(name, sizeof name, "%.*s", length < sizeof name ? (int)length : 0, at);
    const int channel = zr_names_find(&zr_channel_names, name);
    if (channel < 0 || channel >= ZR_CHANNEL_COUNT) return false;
    if (strcmp(parameter, "x") == 0 || strcmp(parameter, "y") == 0) return channel == ZR_CHANNEL_FRAGMENTS;
    const int given = request->encoding ? zr_names_find(&zr_encoding_names, request->encoding) : -1;
    const bool has_it =
        given >= 0 && given < ZR_ENCODING_COUNT && zr_channel_has((enum zr_channel)channel, (enum zr_encoding)given);
    const enum zr_encoding encoding = has_it ? (enum zr_encoding)given : zr_channel_rows[channel].encodings[0];
    if (strcmp(parameter, "scale") == 0) return zr_encoding_has(encoding, ZR_ENCODING_HAS_SCALE);
    if (strcmp(parameter, "lossless") == 0) return zr_encoding_has(encoding, ZR_ENCODING_HAS_LOSSLESS);
    if (strcmp(parameter, "quality") == 0) return zr_encoding_has(encoding, ZR_ENCODING_HAS_QUALITY);
    if (strcmp(parameter, "maxBytes") == 0) return zr_encoding_has(encoding, ZR_ENCODING_HAS_MAX_BYTES);
    if (strcmp(parameter, "dpi") == 0) return zr_encoding_has(encoding, ZR_ENCODING_HAS_DPI);
    return has_it;
}

static const char *copy(struct zr_arena *arena, const char *text, size_t length)
{
    char *copied = zr_arena_alloc(arena, length + 1, 1);
    if (!copied) return NULL;
    memcpy(copied, text, length);
    copied[length] = '\0';
    return copied;
}

/* Returns the text of an output parameter ("channel", "encoding", "scale", "quality" and so on) for the channel
 * `number` of the list; NULL if it is not given or belongs to other channels. An encoding belongs to channels that have
 * it, a scale to those with png16, a quality to those with jpeg or webp, x and y to fragments. A parameter of no listed
 * channel belongs to the first, which refuses it. The text is in the arena; NULL also without memory. */
static const char *text_of_channel(const struct zr_request *request, struct zr_arena *arena, size_t number,
                                   const char *parameter, const char *text)
{
    const size_t count = text ? count_channels(request) : 1;
    if (count == 1) return text;
    if (strcmp(parameter, "channel") == 0) {
        size_t length;
        const char *at = channel_at(request, number, &length);
        return copy(arena, at, length);
    }
    if (belongs(request, number, parameter)) return text;
    for (size_t other = 0; other < count; other++)
        if (number > 0 || belongs(request, other, parameter)) return NULL;
    return text;
}

/* ---- the tables ---- */

/* Required keys of objects, added if the query has other keys of the object. */
static const struct {
    const char *pointer, *value;
} required[] = {
    {"/outputs/0/channel", "\"color\""}, {"/materials/0/name", "\"mesh\""}, {"/lights/0/type", "\"directional\""}};

/* Keys with a default in scenes and none in queries: without them, the other keys of their objects are refused. */
static const char *const needed[] = {"/turntable/frames", "/sheet/layout"};

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
    {"materials", zr_json_choice, AT(given.keeps_materials), .words = &zr_file_material_names,
     .text = "materials of the file, in looks that are a material"},
    {"time", zr_json_number, AT(time), 0, TIME_MAX, .unit = "seconds", .text = "time of the animation"},
    {"frames", zr_json_whole, AT(frames), 1, 4096, .text = "number of views, from this time on"},
    {"timeEnd", zr_json_number, AT(time_end), 0, TIME_MAX, .unit = "seconds", .text = "time at which the frames end"}};
#undef AT
static const struct zr_json_object query_object = ZR_JSON_OBJECT_OF("query", query_fields);
static const char query_prefix[] = "/query/";

static bool is_of_query(const char *pointer)
{
    return strncmp(pointer, query_prefix, strlen(query_prefix)) == 0;
}

const struct zr_json_field *zr_parameter_field(const char *pointer)
{
    const bool is_in_query = is_of_query(pointer);
    const struct zr_json_object *object = is_in_query ? &query_object : &zr_json_object_scene;
    const struct zr_json_field *field = NULL;
    for (const char *at = is_in_query ? pointer + strlen(query_prefix) - 1 : pointer; *at;) {
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

/* ---- reading ---- */

struct reading {
    const struct zr_request *request;
    const struct zr_limits *limits;
    struct zr_query *query;
    struct zr_error *error;
};

/* Finds the first given parameter whose key is at the fault's pointer, within it or around it. NULL if there is none.
 */
static const char *name_of(const struct zr_request *request, const char *pointer)
{
    for (int i = 0; i < zr_parameter_count && *pointer; i++) {
        const char *key = zr_parameter_list[i].pointer;
        const size_t length = strlen(key) < strlen(pointer) ? strlen(key) : strlen(pointer);
        const bool is_inside = strchr("/", key[length]) && strchr("/", pointer[length]);
        if (zr_parameter_text(request, &zr_parameter_list[i]) && is_inside && memcmp(key, pointer, length) == 0)
            return zr_parameter_list[i].name;
    }
    return NULL;
}

void zr_query_report(const struct zr_request *request, enum zr_status status, const struct zr_error *faults,
                     struct zr_error *error)
{
    for (size_t i = 0; i < zr_error_held(faults); i++) {
        const struct zr_error_item *item = &faults->items[i];
        const struct output_pointer first = output_pointer(item->pointer, 0);
        const char *name = name_of(request, first.text);
        if (name)
            zr_error_add(error, status, NULL, "parameter %s: %s", name,
                         zr_parameter_names(first.text, item->detail).text);
        else
            zr_error_add(error, status, item->pointer, "%s", item->detail);
    }
}

/* Drops the faults of rows that are reported already: bit i of `reported` is row i of the object. */
static void drop_reported(struct zr_error *faults, const struct zr_parameter_row *object, uint64_t reported)
{
    size_t kept = 0;
    for (size_t k = 0; k < zr_error_held(faults); k++) {
        bool is_new = true;
        for (int i = 0; reported >> i; i++)
            if (reported >> i & 1u && strcmp(object[i].pointer, output_pointer(faults->items[k].pointer, 0).text) == 0)
                is_new = false;
        if (is_new) faults->items[kept++] = faults->items[k];
    }
    faults->count = kept;
}

/* Reads {"query": {...}}, or keys of a scene. Rows of the object in `reported` are null. */
static void read_text(const struct reading *r, const struct zr_json_writer *text, const struct zr_parameter_row *object,
                      uint64_t reported)
{
    struct zr_query *query = r->query;
    struct zr_json *json = &query->given.json;
    struct zr_error faults = {0};
    uint64_t keys = 0;
    json->error = &faults;
    zr_json_open(json, text->text, text->used);
    if (is_of_query(object->pointer)) {
        struct zr_json_text key;
        zr_json_enter(json, '{');
        zr_json_member(json, &key);
        zr_json_fields(json, ZR_JSON_KEY(NULL, query_object.name), &query_object, query, &keys);
    } else {
        zr_json_fields(json, NULL, &zr_json_object_scene, &query->given, &keys);
        query->given.keys |= keys;
    }
    drop_reported(&faults, object, reported);
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
    plain.views[0].has_visibility = view->has_visibility;
    plain.views[0].annotate = view->annotate;
    plain.views[0].picks = view->picks;
    if (keeping->has_view) *view = plain.views[0];
    given->json.error = r->error;
    zr_json_open(&given->json, keeping->keys, keeping->keys_size);
    zr_json_fields(&given->json, NULL, &zr_json_object_scene, given, &keys);
    given->keys |= keys;
}

/* Writes the rows of one object, at most 64, or of the output `number`. A wrong value becomes null; the
 * other keys are still checked. Returns the rows with wrong values, one bit each. */
static uint64_t write_object(const struct reading *r, const struct zr_parameter_row *row,
                             const struct zr_parameter_row *end, size_t number, struct zr_json_writer *json)
{
    const bool has_view = zr_format_rows[r->request->format].has_view;
    struct zr_arena *arena = r->query->given.json.arena;
    uint64_t reported = 0;
    for (const struct zr_parameter_row *at = row; at < end; at++) {
        const char *text = text_of_channel(r->request, arena, number, at->name, zr_parameter_text(r->request, at));
        if (!text) continue;
        if (at->scope == ZR_PARAMETER_OF_MESH && has_view) {
            zr_error_add(r->error, ZR_BAD_REQUEST, NULL,
                         "parameter %s belongs to bodies that are a bare mesh; a scene has keys of its own for it",
                         at->name);
            continue;
        }
        struct output_pointer *pointer = zr_arena_alloc(arena, 1, sizeof *pointer);
        if (!pointer) return reported;
        *pointer = output_pointer(at->pointer, number);
        put_required(json, pointer->text);
        zr_json_go_to(json, pointer->text);
        const size_t used = json->used;
        const struct zr_parameter parameter = {at->name, at->kind, zr_parameter_field(at->pointer), r->limits,
                                               r->error};
        if (zr_parameter_put(&parameter, text, json)) continue;
        json->used = used;
        zr_json_put(json, "null");
        reported |= UINT64_C(1) << (at - row);
    }
    return reported;
}

/* Refuses the first given row of an object without its needed key. */
static bool lacks_key(const struct reading *r, const struct zr_parameter_row *row, const struct zr_parameter_row *end)
{
    bool is_needed = false;
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++)
        is_needed = is_needed || strcmp(row->pointer, needed[i]) == 0;
    if (!is_needed || zr_parameter_text(r->request, row)) return false;
    const struct zr_parameter_row *given = row + 1;
    while (given < end && !zr_parameter_text(r->request, given))
        given++;
    return zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "parameter %s: %s is missing", given->name, row->name) != ZR_OK;
}

/* Reads the rows of one object. Those of outputs may be several objects. */
static void read_rows(const struct reading *r, const struct zr_parameter_row *row, const struct zr_parameter_row *end)
{
    const bool is_outputs = strncmp(row->pointer, "/outputs/", strlen("/outputs/")) == 0;
    const size_t count = is_outputs ? count_channels(r->request) : 1;
    size_t room = 0;
    for (const struct zr_parameter_row *at = row; at < end; at++)
        if (zr_parameter_text(r->request, at))
            room += 2 * strlen(at->pointer) + 6 * strlen(zr_parameter_text(r->request, at)) + ZR_PARAMETER_ROOM;
    if (room == 0 || lacks_key(r, row, end)) return;
    if (count > ZR_CHANNEL_COUNT) {
        zr_error_add(r->error, ZR_BAD_REQUEST, NULL, "parameter channel: %zu channels; up to %d are allowed", count,
                     ZR_CHANNEL_COUNT);
        return;
    }
    struct zr_json_writer json = {.text = zr_arena_alloc(r->query->given.json.arena, count * room, 1), .pointer = ""};
    uint64_t reported = 0;
    for (size_t number = 0; json.text && number < count; number++)
        reported |= write_object(r, row, end, number, &json);
    if (json.used == 0) return;
    zr_json_go_to(&json, "");
    read_text(r, &json, row, reported);
}

/* True if the query wants lines alone, which the look studio has not. */
static bool is_svg(const struct zr_request *request)
{
    return request->encoding && strcmp(request->encoding, "svg") == 0;
}

static void open_query(const struct zr_request *request, const struct zr_limits *limits,
                       struct zr_scene_builder *builder, struct zr_query *query)
{
    const struct zr_format_row *format = &zr_format_rows[request->format];
    struct zr_parsed_scene *given = &query->given;
    *query = (struct zr_query){.request = request,
                               .given = {.json = {.arena = builder->arena, .limits = limits},
                                         .builder = builder,
                                         .picture = zr_arena_zero(builder->arena, 1, sizeof *given->picture),
                                         .scene = format->has_view ? &query->others : builder->scene,
                                         .is_bare = !format->has_view,
                                         .face_style = zr_face_style_unset},
                               .compress = ZR_UNSET,
                               .projection = ZR_UNSET,
                               .up = ZR_UNSET};
    if (format->has_view) {
        builder->asked = &query->others;
        return;
    }
    given->scene->has_open_look = true; /* until a look with a version is read */
    /* A key of the query's view overrides that key of the look's view. */
    given->look = request->look ? zr_look_find(request->look) : NULL;
    if (!given->look) given->look = zr_look_find(is_svg(request) ? "technical" : "studio");
    zr_look_set_view(given->look, &given->scene->views[0]);
}

enum zr_status zr_query_read(const struct zr_request *request, const struct zr_limits *limits,
                             struct zr_scene_builder *builder, struct zr_query *query, struct zr_error *error)
{
    struct zr_limits deep = *limits;
    const struct reading r = {request, &deep, query, error};
    deep.json_depth_max = ZR_JSON_DEPTH_MAX;
    open_query(request, &deep, builder, query);
    if (!query->given.picture) return ZR_NO_MEMORY;
    for (int first = 0, end = 0; first < zr_parameter_count; first = end) {
        const size_t object = 1 + strcspn(zr_parameter_list[first].pointer + 1, "/");
        while (end < zr_parameter_count &&
               strncmp(zr_parameter_list[end].pointer, zr_parameter_list[first].pointer, object) == 0 &&
               strchr("/", zr_parameter_list[end].pointer[object]))
            end++;
        read_rows(&r, &zr_parameter_list[first], &zr_parameter_list[end]);
    }
    if (builder->keeping && builder->keeping->keys && error->count == 0) read_changed_keys(&r, builder->keeping);
    query->given.json.limits = limits;
    if (!zr_arena_ok(builder->arena)) return ZR_NO_MEMORY;
    return error->count > 0 ? error->status : ZR_OK;
}
