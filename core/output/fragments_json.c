#include "output/fragments_json.h"

#include <string.h>

#include "base/checked.h"
#include "output/json_tree.h"

static const char *const alpha_modes[] = {
    [ZR_ALPHA_OPAQUE] = "OPAQUE", [ZR_ALPHA_MASK] = "MASK", [ZR_ALPHA_BLEND] = "BLEND"};

static cJSON *fragment_of(struct zr_tree *w, const struct zr_scene *scene, const struct zr_pixel_fragment *fragment)
{
    const struct zr_instance *instance = &scene->instances[fragment->instance];
    cJSON *object = zr_tree_check(w, cJSON_CreateObject());
    zr_tree_put(w, object, "depth", zr_tree_number(w, fragment->depth));
    zr_tree_put_count(w, object, "faceId", fragment->face_id);
    zr_tree_put_count(w, object, "instanceId", UINT64_C(1) + fragment->instance);
    zr_tree_put(w, object, "mesh", zr_tree_check(w, cJSON_CreateString(scene->meshes[instance->mesh].name)));
    if (instance->node) zr_tree_put(w, object, "node", zr_tree_check(w, cJSON_CreateString(instance->node)));
    zr_tree_put(w, object, "position", zr_tree_numbers(w, fragment->position, 3));
    zr_tree_put_count(w, object, "frontFacing", (uint64_t)fragment->front_facing);
    zr_tree_put(w, object, "alphaMode", zr_tree_check(w, cJSON_CreateString(alpha_modes[fragment->alpha_mode])));
    zr_tree_put(w, object, "shown", zr_tree_check(w, cJSON_CreateBool(fragment->is_shown)));
    return object;
}

static cJSON *build(struct zr_tree *w, const struct zr_scene *scene, const struct zr_pixel_fragments *fragments,
                    uint32_t listed)
{
    cJSON *root = zr_tree_check(w, cJSON_CreateObject());
    zr_tree_put_count(w, root, "x", fragments->x);
    zr_tree_put_count(w, root, "y", fragments->y);
    zr_tree_put_count(w, root, "count", fragments->count);
    cJSON *list = zr_tree_check(w, cJSON_CreateArray());
    for (uint32_t i = 0; i < listed; i++)
        zr_tree_append(w, list, fragment_of(w, scene, &fragments->at[i]));
    zr_tree_put(w, root, "fragments", list);
    return root;
}

static bool predict_memory(const struct zr_scene *scene, const struct zr_pixel_fragments *fragments, uint32_t listed,
                           size_t *bytes)
{
    size_t characters = 0;
    bool fits = true;
    for (uint32_t i = 0; i < listed; i++) {
        const struct zr_instance *instance = &scene->instances[fragments->at[i].instance];
        fits &= zr_add_size(characters, strlen(scene->meshes[instance->mesh].name), &characters);
        fits &= zr_add_size(characters, instance->node ? strlen(instance->node) : 0, &characters);
    }
    return fits && zr_mul_size(characters, ZR_TREE_CHARACTER_BYTES, bytes) &&
           zr_add_size(*bytes, ZR_TREE_OTHER_BYTES + (size_t)listed * ZR_TREE_LISTED_BYTES, bytes);
}

enum zr_status zr_fragments_json_write(const struct zr_scene *scene, const struct zr_frame *frame,
                                       struct zr_buffer *out)
{
    const struct zr_pixel_fragments *fragments = &frame->fragments;
    const uint32_t listed =
        fragments->count < ZR_FRAGMENTS_LISTED_MAX ? fragments->count : (uint32_t)ZR_FRAGMENTS_LISTED_MAX;
    size_t predicted;
    if (!predict_memory(scene, fragments, listed, &predicted) || !zr_arena_charge(out->arena, predicted))
        return ZR_NO_MEMORY;
    struct zr_tree w = {.ok = true};
    cJSON *root = build(&w, scene, fragments, listed);
    const bool ok = zr_tree_print(&w, root, out);
    zr_arena_refund(out->arena, predicted);
    return ok ? ZR_OK : ZR_NO_MEMORY;
}
