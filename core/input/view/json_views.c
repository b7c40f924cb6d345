/* Reads the keys that ask for several views: views, turntable, orbit and sheet. */
#include <string.h>

#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "scene/camera/view_set.h"

enum { NAME_MAX = 64 };

/* ---- one view of a list ---- */

/* A value as written. */
struct given_value {
    const char *at;
    size_t size;
};

/* struct given_value */
static bool read_value(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct given_value *value = out;
    (void)path;
    zr_json_type(json);
    value->at = json->at;
    if (!zr_json_skip(json)) return false;
    value->size = (size_t)(json->at - value->at);
    return true;
}

/* const char *: a name of files. */
static bool read_name(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const char *name = NULL;
    if (!zr_json_string(json, path, &name)) return false;
    const size_t length = strlen(name), good = strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                            "0123456789_-");
    if (length == 0 || length > NAME_MAX || good != length)
        return zr_json_fault(json, path, "is part of file names: 1 to %d letters, digits, - or _ of ASCII are allowed",
                             NAME_MAX);
    *(const char **)out = name;
    return true;
}

enum { NAME, FIRST_KEY };
struct given_item {
    const char *name;
    struct given_value values[16];
};
#define VALUE(number, name, table, help)                                                                               \
    {                                                                                                                  \
        name, read_value, offsetof(struct given_item, values[number]),                                                 \
            .object = (table), .text = (help), .schema = ZR_SCHEMA_OF("scene/properties/" name)                        \
    }
static const struct zr_json_field item_fields[] = {
    [NAME] = {"name", read_name, offsetof(struct given_item, name), .otherwise = "its number, as 0001",
              .text = "begins the names of its files: letters, digits, - and _",
              .schema = ZR_SCHEMA({"type" : "string", "pattern" : "^[A-Za-z0-9_-]{1,64}$"})},
    VALUE(0, "view", &zr_json_object_view, "pose and projection of the camera"),
    VALUE(1, "window", &zr_json_object_window, "size of the picture"),
    VALUE(2, "look", NULL, "defaults of the scene, by name"),
    {"poses", read_value, offsetof(struct given_item, values[3]), .text = "matrices of nodes, by their names",
     .schema = ZR_SCHEMA({"type" : "object", "additionalProperties" : {"$ref" : "#/$defs/affine"}})},
    VALUE(4, "background", &zr_json_object_gradient, "colour of uncovered pixels"),
    VALUE(5, "hide", NULL, "parts that are not drawn"),
    VALUE(6, "isolate", NULL, "the only parts that are drawn"),
    VALUE(7, "ghost", NULL, "translucent parts"),
    VALUE(8, "highlight", &zr_json_object_highlight, "parts in one colour"),
    VALUE(9, "explode", &zr_json_object_explode, "exploded view: a factor or an object"),
    VALUE(10, "sections", &zr_json_object_sections, "planes that cut the scene open"),
    VALUE(11, "edges", &zr_json_object_edges, "lines along silhouettes and creases"),
    VALUE(12, "annotate", NULL, "marks over the picture"),
    VALUE(13, "title", NULL, "text of the title line"),
    VALUE(14, "dimensions", &zr_json_object_dimension, "dimensions between places"),
    VALUE(15, "picks", NULL, "pixels whose surfaces info describes")};
enum { VALUES = sizeof item_fields / sizeof *item_fields - FIRST_KEY };
const struct zr_json_object zr_json_object_views = ZR_JSON_OBJECT_OF("views", item_fields);

/* Writes the keys of an item as an object of their own. False without memory. */
static bool write_keys(struct zr_arena *arena, const struct given_item *given, struct zr_view_item *item)
{
    size_t room = 2;
    for (int i = 0; i < VALUES; i++)
        room += given->values[i].size + strlen(item_fields[FIRST_KEY + i].key) + 4;
    char *text = zr_arena_alloc(arena, room, 1), *end = text;
    const char **names = zr_arena_zero(arena, VALUES + 1, sizeof *names);
    item->keys = text;
    item->key_names = names;
    if (!text || !names) return false;
    *end++ = '{';
    for (int i = 0; i < VALUES; i++) {
        if (!given->values[i].at) continue;
        if (end[-1] != '{') *end++ = ',';
        *names++ = item_fields[FIRST_KEY + i].key;
        *end++ = '"';
        end = stpcpy(end, item_fields[FIRST_KEY + i].key);
        end = mempcpy(end, "\":", 2);
        end = mempcpy(end, given->values[i].at, given->values[i].size);
    }
    *end++ = '}';
    item->keys_size = (size_t)(end - text);
    return true;
}

static bool read_item(struct zr_json *json, const struct zr_json_path *path, struct zr_view_item *item)
{
    struct given_item given = {.name = NULL};
    uint64_t keys;
    *item = (struct zr_view_item){.preset = -1};
    if (zr_json_type(json) == ZR_JSON_STRING) {
        if (!zr_json_choice_of(json, path, &zr_preset_names, &item->preset)) return false;
        item->name = zr_preset_names.words[item->preset];
        return true;
    }
    if (zr_json_type(json) != ZR_JSON_OBJECT) return zr_json_expect(json, path, "the name of a preset or an object");
    if (!zr_json_fields(json, path, &zr_json_object_views, &given, &keys)) return false;
    item->name = given.name;
    return write_keys(json->arena, &given, item);
}

/* ---- the keys ---- */

struct zr_view_set *zr_view_set_add(struct zr_json *json, const struct zr_json_path *path, struct zr_scene *scene)
{
    if (scene->view_set) {
        zr_json_fault(json, path, "a scene has one of views, turntable, orbit and animate, and this one has %s, too",
                      zr_view_set_pointer(scene->view_set) + 1);
        return NULL;
    }
    struct zr_view_set *set = zr_arena_zero(json->arena, 1, sizeof *set);
    scene->view_set = set;
    return set;
}

bool zr_view_count_check(struct zr_json *json, const struct zr_json_path *path, size_t count)
{
    return (count >= 1 && count <= json->limits->views_max) ||
           zr_json_fault(json, path, "%zu views; 1 to %u are allowed", count, json->limits->views_max);
}

bool zr_read_views(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_view_set *set = NULL;
    size_t count = 0, number = 0;
    bool is_good = true;
    if (!zr_json_count(json, path, &count)) return false;
    if (!zr_view_count_check(json, path, count) || !(set = zr_view_set_add(json, path, root->scene))) {
        zr_json_skip(json);
        return false;
    }
    struct zr_view_item *items = zr_arena_alloc(json->arena, count, sizeof *items);
    for (zr_json_enter(json, '['); items && zr_json_item(json); number++)
        is_good = read_item(json, ZR_JSON_ITEM(path, number), &items[number]) && is_good;
    *set = (struct zr_view_set){.kind = ZR_VIEW_SET_LIST, .count = (uint32_t)count, .items = items};
    return is_good && items;
}

#define AT(member) offsetof(struct zr_view_set, member)
static const struct zr_json_field turntable_fields[] = {
    {"frames", zr_json_whole, AT(count), 1, 4096, .otherwise = "36", .text = "number of views in one turn"},
    {"elevation", zr_json_number, AT(elevation_degrees), -90, 90, .unit = "degrees",
     .otherwise = "that of the scene's view", .text = "angle of the camera above the horizon"},
    {"seconds", zr_json_number, AT(seconds), 0.02, 3600, .unit = "seconds", .otherwise = "4",
     .text = "time of one turn in an animation"}};
const struct zr_json_object zr_json_object_turntable = ZR_JSON_OBJECT_OF("turntable", turntable_fields);

static const struct zr_json_field orbit_fields[] = {
    {"count", zr_json_whole, AT(count), 1, 4096, .required = true, .text = "number of views"},
    {"distance", zr_json_positive, AT(distance), .unit = "scene units", .otherwise = "fitted to the geometry",
     .text = "distance from the cameras to the target"}};
const struct zr_json_object zr_json_object_orbit = ZR_JSON_OBJECT_OF("orbit", orbit_fields);
#undef AT

/* Reads a turntable or an orbit, whose first key is the number of views. */
static bool read_turn(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_object *object,
                      const struct zr_view_set *defaults, struct zr_parsed_scene *root)
{
    enum { ELEVATION = 1 };
    struct zr_view_set given = *defaults, *set;
    uint64_t keys;
    const size_t faults = json->error->count;
    if (!zr_json_fields(json, path, object, &given, &keys) || json->error->count > faults) return false;
    given.has_elevation = given.kind == ZR_VIEW_SET_TURNTABLE && zr_json_gives(keys, ELEVATION);
    if (!zr_view_count_check(json, ZR_JSON_KEY(path, object->fields[0].key), given.count)) return false;
    if (!(set = zr_view_set_add(json, path, root->scene))) return false;
    *set = given;
    return true;
}

bool zr_read_turntable(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const struct zr_view_set defaults = {.kind = ZR_VIEW_SET_TURNTABLE, .count = 36, .seconds = 4.0};
    return read_turn(json, path, &zr_json_object_turntable, &defaults, out);
}

bool zr_read_orbit(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const struct zr_view_set defaults = {.kind = ZR_VIEW_SET_ORBIT};
    return read_turn(json, path, &zr_json_object_orbit, &defaults, out);
}

static const char *const layouts[] = {"views", "threeView", "balanced"};
static const struct zr_names layout_names = ZR_NAMES(ZR_SHEET_LAYOUTS, layouts);
static const char *const angles[] = {"third", "first"};
static const struct zr_names angle_names = ZR_NAMES(2, angles);

enum { COLUMNS_MAX = 64 };
#define AT(member) offsetof(struct zr_sheet, member)
static const struct zr_json_field sheet_fields[] = {
    {"layout", zr_json_choice, AT(layout), .words = &layout_names, .otherwise = "views",
     .text =
         "views: those of the scene; threeView: front, top, right and isometric; balanced: two isometric views from "
         "above, two from below"},
    {"columns", zr_json_whole, AT(columns), 1, COLUMNS_MAX, .otherwise = "as many as rows, or one more",
     .text = "views in a row"},
    {"angle", zr_json_choice, AT(angle), .words = &angle_names, .otherwise = "third",
     .text = "projection of threeView: top view above the front view (third), or below it (first)"},
    {"captions", zr_json_bool, AT(has_captions), .otherwise = "true", .text = "name and scale below each view"}};
#undef AT
/* clang-format off */
const struct zr_json_object zr_json_object_sheet = {
    ZR_JSON_FIELDS("sheet", sheet_fields), .schema = ZR_SCHEMA({
        "dependentSchemas": {
            "columns": {"properties": {"layout": {"const": "views"}}},
            "angle": {"properties": {"layout": {"const": "threeView"}}}
        },
        "dependentRequired": {"angle": ["layout"]}
    })};
/* clang-format on */

bool zr_read_sheet(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    enum { LAYOUT, COLUMNS, ANGLE };
    struct zr_parsed_scene *root = out;
    struct zr_sheet given = {.is_on = true, .has_captions = true};
    uint64_t keys = 0;
    const size_t faults = json->error->count;
    if (zr_json_type(json) == ZR_JSON_STRING) {
        if (!zr_json_choice_of(json, path, sheet_fields[LAYOUT].words, &given.layout)) return false;
    } else if (!zr_json_fields(json, path, &zr_json_object_sheet, &given, &keys) || json->error->count > faults)
        return false;
    if (zr_json_gives(keys, COLUMNS) && (given.columns < 1 || given.columns > COLUMNS_MAX))
        return zr_json_fault(json, ZR_JSON_KEY(path, "columns"), "%u; 1 to %d are allowed", given.columns, COLUMNS_MAX);
    if (zr_json_gives(keys, COLUMNS) && given.layout != ZR_SHEET_VIEWS)
        return zr_json_fault(json, ZR_JSON_KEY(path, "columns"), "the layout %s has two", layouts[given.layout]);
    if (zr_json_gives(keys, ANGLE) && given.layout != ZR_SHEET_THREE_VIEW)
        return zr_json_fault(json, ZR_JSON_KEY(path, "angle"), "belongs to the layout threeView");
    root->scene->sheet = given;
    return true;
}
