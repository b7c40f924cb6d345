/* Finds the images of textures by the names of their bytes. Before that, several threads decode them. */
#include "input/json/json_bytes.h"
#include "input/scene/json_scene.h"

bool zr_parsed_find_image(struct zr_parsed_scene *root, const struct zr_json_path *path,
                          const struct zr_bytes_name *name, uint32_t *number)
{
    struct zr_image_list *images = &root->images;
    const struct zr_json_path *at = ZR_JSON_KEY(path, name->asset ? ZR_BYTES_ASSET : ZR_BYTES_URI);
    struct zr_parsed_bytes bytes;
    struct zr_reason reason;
    if (zr_json_stops(&root->json)) return false;
    if (zr_image_list_find(images, name, number)) return true;
    if (zr_image_list_is_full(images, &reason)) return zr_json_fault(&root->json, at, "%s", reason.text);
    const struct zr_image_file *ahead = zr_image_list_ahead(images, name);
    if (ahead)
        bytes = (struct zr_parsed_bytes){ahead->bytes, ahead->size};
    else if (!zr_parsed_read_named(&root->json, path, name, &bytes))
        return false;
    return zr_json_check_read(&root->json, at, zr_image_list_add_named(images, name, &bytes, number, &reason), &reason);
}

/* Adds the file of a texture unless the list has it. False if it cannot be read. */
static bool add_file(struct zr_parsed_scene *root, struct zr_bytes_name *names, const struct zr_bytes_name *name)
{
    struct zr_image_list *images = &root->images;
    struct zr_error faults = {.count = 0};
    struct zr_json quiet = root->json;
    struct zr_parsed_bytes bytes;
    if (zr_image_list_ahead(images, name)) return true;
    quiet.error = &faults;
    if (images->ahead_count == ZR_AHEAD_MAX || !zr_parsed_read_named(&quiet, NULL, name, &bytes)) return false;
    images->ahead[images->ahead_count] = (struct zr_image_file){.bytes = bytes.bytes, .size = bytes.size};
    names[images->ahead_count++] = *name;
    return true;
}

void zr_parsed_read_ahead(struct zr_parsed_scene *root)
{
    struct zr_arena *arena = root->json.arena;
    struct zr_image_list *images = &root->images;
    struct zr_bytes_name *names = NULL;
    bool good = true;
    for (size_t i = 0; good && i < root->material_count && !zr_json_stops(&root->json); i++)
        for (int slot = 0; good && slot < ZR_TEXTURE_SLOTS; slot++) {
            const struct zr_parsed_texture *texture = &root->materials[i].textures[slot];
            if (!texture->is_given) continue;
            if (!names) {
                images->ahead_names = names = zr_arena_alloc(arena, ZR_AHEAD_MAX, sizeof *names);
                images->ahead = zr_arena_alloc(arena, ZR_AHEAD_MAX, sizeof *images->ahead);
                if (!zr_arena_ok(arena)) return;
            }
            good = add_file(root, names, &texture->name);
        }
    if (names) zr_image_list_decode(images);
}
