#include "input/root/change.h"

#include <string.h>

#include "input/formats/formats.h"
#include "input/scene/json_scene.h"
#include "render_request.h"

/* The keys of a change, as written. */
struct keys {
    size_t count;
    struct zr_kept_key *items; /* ZR_SCENE_KEYS_MAX of them */
    struct zr_kept_key poses;  /* name NULL: not given */
};

static bool is_key(const struct zr_kept_key *key, enum zr_scene_key of)
{
    return strcmp(key->name, zr_scene_fields[of].key) == 0;
}

/* Adds a key of the change, or refuses it. */
static bool add(struct zr_json *json, const struct zr_kept *kept, const struct zr_kept_key *key, struct keys *keys)
{
    const struct zr_json_path *path = ZR_JSON_KEY(NULL, key->name);
    const bool has_view = zr_format_rows[kept->request->format].has_view;
    if (!has_view && is_key(key, ZR_SCENE_LOOK))
        return zr_json_fault(json, path, "the look of a bare mesh is a parameter");
    if (is_key(key, ZR_SCENE_MESHES) || is_key(key, ZR_SCENE_POLYGONS))
        return zr_json_fault(json, path, "a change keeps the geometry; read another scene for this");
    if (!has_view && (is_key(key, ZR_SCENE_NODES) || is_key(key, ZR_SCENE_MATERIALS) || is_key(key, ZR_SCENE_BASE)))
        return zr_json_fault(json, path, "a bare mesh has none; a scene in JSON may have it");
    if (is_key(key, ZR_SCENE_VIEWS) || is_key(key, ZR_SCENE_TURNTABLE) || is_key(key, ZR_SCENE_ORBIT) ||
        is_key(key, ZR_SCENE_SHEET) || is_key(key, ZR_SCENE_ANIMATE))
        return zr_json_fault(json, path, "a change has one view; the request of the scene may have several");
    if (strcmp(key->name, ZR_POSES) == 0) {
        if (!has_view) return zr_json_fault(json, path, "a bare mesh has no nodes");
        if (keys->poses.name) return zr_json_fault(json, path, "given twice");
        keys->poses = *key;
        return true;
    }
    if (keys->count == ZR_SCENE_KEYS_MAX) return zr_json_fault(json, NULL, "more keys than a scene can have");
    keys->items[keys->count++] = *key;
    return true;
}

static enum zr_status list_keys(struct zr_arena *arena, const struct zr_kept *kept, const struct zr_request *change,
                                struct keys *keys, struct zr_error *error)
{
    struct zr_limits limits = kept->limits;
    if (limits.json_depth_max > ZR_JSON_DEPTH_MAX) limits.json_depth_max = ZR_JSON_DEPTH_MAX;
    struct zr_json all = {.arena = arena, .cancel = change->cancel, .limits = &limits, .error = error}, *json = &all;
    struct zr_json_text name;
    keys->items = zr_arena_alloc(arena, ZR_SCENE_KEYS_MAX, sizeof *keys->items);
    if (!keys->items) return ZR_NO_MEMORY;
    if (change->size == 0) return ZR_OK;
    zr_json_open(json, change->bytes, change->size);
    if (zr_json_type(json) != ZR_JSON_OBJECT) {
        zr_json_expect(json, NULL, "an object");
        return zr_json_close(json);
    }
    for (zr_json_enter(json, '{'); zr_json_member(json, &name);) {
        zr_json_type(json);
        struct zr_kept_key key = {.name = zr_json_decode(json, &name), .written = name, .value = json->at};
        if (!key.name || !zr_json_skip(json)) break;
        key.size = (size_t)(json->at - key.value);
        add(json, kept, &key, keys);
    }
    zr_json_end(json);
    return zr_json_close(json);
}

static bool has(const struct keys *keys, const char *name)
{
    for (size_t i = 0; i < keys->count; i++)
        if (strcmp(keys->items[i].name, name) == 0) return true;
    return false;
}

/* Bytes of "name":value, with a comma. */
static size_t room_of(const struct zr_kept_key *keys, size_t count)
{
    size_t room = 0;
    for (size_t i = 0; i < count; i++)
        room += (size_t)(keys[i].written.end - keys[i].written.at) + strlen(keys[i].name) + keys[i].size + 4;
    return room;
}

/* Appends a key and its value. Keys of the kept scene are in the table and need no escapes; those of a change are
 * copied as written. */
static char *put(char *text, const struct zr_kept_key *key)
{
    const size_t written = (size_t)(key->written.end - key->written.at);
    if (text[-1] != '{') *text++ = ',';
    *text++ = '"';
    text = written > 0 ? mempcpy(text, key->written.at, written) : stpcpy(text, key->name);
    *text++ = '"';
    *text++ = ':';
    memcpy(text, key->value, key->size);
    return text + key->size;
}

/* Writes the text of the changed scene; its meshes are kept apart. */
static bool write_text(struct zr_arena *arena, const struct zr_kept *kept, const struct keys *keys,
                       struct zr_request *request)
{
    const size_t room = 2 + room_of(kept->keys, kept->key_count) + room_of(keys->items, keys->count);
    char *text = zr_arena_alloc(arena, room, 1), *end = text;
    if (!text) return false;
    *end++ = '{';
    for (size_t i = 0; i < kept->key_count; i++)
        if (!has(keys, kept->keys[i].name)) end = put(end, &kept->keys[i]);
    for (size_t i = 0; i < keys->count; i++)
        end = put(end, &keys->items[i]);
    *end++ = '}';
    request->bytes = text;
    request->size = (size_t)(end - text);
    return true;
}

static bool join_assets(struct zr_arena *arena, const struct zr_kept *kept, const struct zr_request *change,
                        struct zr_request *request)
{
    const size_t first = kept->request->asset_count;
    if (change->asset_count == 0) return true;
    struct zr_asset *assets = zr_arena_alloc(arena, first + change->asset_count, sizeof *assets);
    if (!assets) return false;
    if (first > 0) memcpy(assets, kept->request->assets, first * sizeof *assets);
    memcpy(assets + first, change->assets, change->asset_count * sizeof *assets);
    request->assets = assets;
    request->asset_count = first + change->asset_count;
    return true;
}

enum zr_status zr_change_read(struct zr_arena *arena, const struct zr_kept *kept, const struct zr_request *change,
                              struct zr_request *request, struct zr_keeping *keeping, struct zr_error *error)
{
    struct keys keys = {.count = 0};
    const enum zr_status status = list_keys(arena, kept, change, &keys, error);
    if (status != ZR_OK) return status;
    *request = *kept->request;
    *keeping = (struct zr_keeping){.from = kept};
    request->cancel = change->cancel;
    const char *posed = change->animation ? "animation"
                        : change->time    ? "time"
                        : change->frames  ? "frames"
                        : change->timeEnd ? "timeEnd"
                                          : NULL;
    if (posed)
        return zr_error_add(error, ZR_BAD_REQUEST, NULL,
                            "parameter %s: a change keeps the geometry; read the file again for another pose", posed);
#define REPLACE(name, ...)                                                                                             \
    if (change->name) request->name = change->name;
    ZR_PARAMETER_ROWS(REPLACE)
#undef REPLACE
    if (!write_text(arena, kept, &keys, request) || !join_assets(arena, kept, change, request)) return ZR_NO_MEMORY;
    if (!zr_format_rows[request->format].has_view) {
        keeping->keys = request->bytes;
        keeping->keys_size = request->size;
        keeping->has_view = has(&keys, zr_scene_fields[ZR_SCENE_VIEW].key);
    }
    if (keys.poses.name) {
        keeping->poses = keys.poses.value;
        keeping->poses_size = keys.poses.size;
    }
    return ZR_OK;
}
