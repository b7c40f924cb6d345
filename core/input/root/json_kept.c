/* Keeps the parsed root of a JSON scene before references are resolved, and gives its meshes to changed scenes. */
#include <string.h>

#include "input/scene/json_scene.h"
#include "input/scene/kept.h"
#include "render_request.h"

/* Returns the byte after the value of a list that was read before; NULL: another key. */
static const char *end_of_list(const struct zr_parsed_scene *root, const char *name)
{
    if (strcmp(name, zr_scene_fields[ZR_SCENE_MESHES].key) == 0) return root->meshes_end;
    if (strcmp(name, zr_scene_fields[ZR_SCENE_POLYGONS].key) == 0) return root->polygons_end;
    return NULL;
}

/* True for a key that asks for several views. */
static bool is_of_views(const char *name)
{
    for (int key = ZR_SCENE_VIEWS; key <= ZR_SCENE_ANIMATE; key++)
        if (strcmp(name, zr_scene_fields[key].key) == 0) return true;
    return false;
}

bool zr_kept_save(struct zr_kept *kept, struct zr_parsed_scene *root)
{
    struct zr_json *const json = &root->json, there = zr_json_at(json, json->bytes);
    struct zr_kept_key *keys = zr_arena_alloc(json->arena, ZR_SCENE_KEYS_MAX, sizeof *keys);
    struct zr_json_text name;
    kept->keys = keys;
    kept->key_count = 0;
    there.ended = false;
    there.depth = 0;
    zr_json_type(&there);
    for (zr_json_enter(&there, '{'); keys && zr_json_member(&there, &name);) {
        zr_json_type(&there);
        struct zr_kept_key key = {.name = zr_json_decode(&there, &name), .value = there.at};
        const char *end = key.name ? end_of_list(root, key.name) : NULL;
        if (end)
            there.at = end;
        else if (!key.name || !zr_json_skip(&there) || kept->key_count == ZR_SCENE_KEYS_MAX)
            return false;
        key.size = (size_t)(there.at - key.value);
        if (is_of_views(key.name)) continue;
        key.value = end ? NULL : zr_arena_copy(json->arena, key.value, key.size);
        if (key.value) keys[kept->key_count++] = key;
    }
    uint8_t *uses = zr_arena_alloc(json->arena, root->assets.count, sizeof *uses);
    for (size_t i = 0; uses && i < root->assets.count; i++)
        uses[i] = (root->assets.uses[i] & ZR_USED_BY_GEOMETRY) != 0;
    kept->uses = uses;
    kept->meshes = root->meshes;
    kept->far = json->far;
    kept->soup = root->soup ? zr_soup_copy(json->arena, root->soup, true) : NULL;
    return zr_arena_ok(json->arena);
}

bool zr_kept_load(const struct zr_kept *kept, struct zr_parsed_scene *root)
{
    if (kept->request->asset_count > 0) memcpy(root->assets.uses, kept->uses, kept->request->asset_count);
    root->meshes = kept->meshes;
    root->json.far = kept->far;
    root->soup = kept->soup ? zr_soup_copy(root->json.arena, kept->soup, false) : NULL;
    return zr_arena_ok(root->json.arena);
}
