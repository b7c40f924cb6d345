/* Finds the files of images before the textures are read, and decodes them by several threads. */
#include "input/mesh/json_image_ahead.h"

#include <string.h>

static bool is_same(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

const struct zr_image_file *zr_parsed_ahead_name(const struct zr_parsed_ahead *ahead, const struct zr_bytes_name *name)
{
    for (size_t i = 0; ahead->names && i < ahead->count; i++)
        if (is_same(ahead->names[i].uri, name->uri) && is_same(ahead->names[i].asset, name->asset))
            return &ahead->files[i];
    return NULL;
}

const struct zr_image_file *zr_parsed_ahead_bytes(const struct zr_parsed_ahead *ahead,
                                                  const struct zr_parsed_bytes *bytes)
{
    for (size_t i = 0; i < ahead->count; i++)
        if (ahead->files[i].bytes == bytes->bytes && ahead->files[i].size == bytes->size) return &ahead->files[i];
    return NULL;
}

void zr_parsed_ahead_decode(struct zr_parsed_scene *root)
{
    const struct zr_quick *quick = root->assets.quick;
    uint64_t most = root->json.limits->image_pixels_max;
    if (quick && quick->image_pixels_max < most) most = quick->image_pixels_max;
    if (root->ahead.count < 2 || root->image_pixels > most) return;
    zr_images_read_ahead(root->json.arena, root->json.team, &root->assets.images, most - root->image_pixels,
                         root->ahead.files, root->ahead.count);
}

static bool has_bytes(const struct zr_parsed_ahead *ahead, const struct zr_parsed_bytes *bytes)
{
    for (size_t i = 0; i < ahead->count; i++)
        if (ahead->files[i].size == bytes->size &&
            (ahead->files[i].bytes == bytes->bytes || memcmp(ahead->files[i].bytes, bytes->bytes, bytes->size) == 0))
            return true;
    return false;
}

void zr_parsed_ahead_add(struct zr_parsed_scene *root, const struct zr_parsed_bytes *bytes)
{
    struct zr_parsed_ahead *ahead = &root->ahead;
    if (ahead->count == ZR_AHEAD_MAX || bytes->size == 0 || has_bytes(ahead, bytes)) return;
    if (!ahead->files) ahead->files = zr_arena_alloc(root->json.arena, ZR_AHEAD_MAX, sizeof *ahead->files);
    if (!ahead->files) return;
    ahead->files[ahead->count++] = (struct zr_image_file){.bytes = bytes->bytes, .size = bytes->size};
}

/* Adds the file of a texture unless the list has it. False if it cannot be read. */
static bool add_file(struct zr_parsed_scene *root, struct zr_bytes_name *names, const struct zr_bytes_name *name)
{
    struct zr_parsed_ahead *ahead = &root->ahead;
    struct zr_error faults = {.count = 0};
    struct zr_json quiet = root->json;
    struct zr_parsed_bytes bytes;
    if (zr_parsed_ahead_name(ahead, name)) return true;
    quiet.error = &faults;
    if (ahead->count == ZR_AHEAD_MAX || !zr_parsed_read_named(&quiet, NULL, name, &bytes)) return false;
    ahead->files[ahead->count] = (struct zr_image_file){.bytes = bytes.bytes, .size = bytes.size};
    names[ahead->count++] = *name;
    return true;
}

void zr_parsed_read_ahead(struct zr_parsed_scene *root)
{
    struct zr_arena *arena = root->json.arena;
    struct zr_bytes_name *names = NULL;
    bool good = true;
    for (size_t i = 0; good && i < root->material_count && !zr_json_stops(&root->json); i++)
        for (int slot = 0; good && slot < ZR_TEXTURE_SLOTS; slot++) {
            const struct zr_parsed_texture *texture = &root->materials[i].textures[slot];
            if (!texture->is_given) continue;
            if (!names) {
                names = zr_arena_alloc(arena, ZR_AHEAD_MAX, sizeof *names);
                root->ahead =
                    (struct zr_parsed_ahead){0, names, zr_arena_alloc(arena, ZR_AHEAD_MAX, sizeof *root->ahead.files)};
                if (!zr_arena_ok(arena)) return;
            }
            good = add_file(root, names, &texture->name);
        }
    if (names) zr_parsed_ahead_decode(root);
}
