#include "input/images/image_record.h"

#include <string.h>

/* Levels take at most this part of the memory that is left. */
enum { ROOM_SHARE = 8 };

/* Hashes of a record are numbers of its items. */
static void write_number(uint32_t number, struct zr_file_hash *hash)
{
    *hash = (struct zr_file_hash){{0}};
    memcpy(hash->bytes, &number, sizeof number);
}

static bool look_up(void *context, const void *bytes, size_t size, struct zr_file_hash *hash,
                    struct zr_kept_image *image)
{
    const struct zr_image_record *record = context;
    write_number(ZR_IMAGES_RECORDED, hash);
    for (uint32_t i = 0; i < record->count; i++) {
        const struct zr_recorded_image *item = &record->items[i];
        if (!item->is_decoded || item->size != size || (item->bytes != bytes && memcmp(item->bytes, bytes, size) != 0))
            continue;
        *image = item->kept;
        return true;
    }
    return false;
}

static bool find(void *context, const void *bytes, size_t size, struct zr_file_hash *hash, struct zr_kept_image *image)
{
    struct zr_image_record *record = context;
    struct zr_recorded_image beyond, *item = &beyond;
    write_number(record->count, hash); /* ZR_IMAGES_RECORDED without room: keep then passes it on */
    if (record->count < ZR_IMAGES_RECORDED) item = &record->items[record->count++];
    *item = (struct zr_recorded_image){.bytes = bytes, .size = size};
    if (!record->others.find) return false;
    item->is_decoded = record->others.find(record->others.context, bytes, size, &item->hash, image);
    if (item == &beyond) *hash = item->hash; /* has no item: the hash is the caller's */
    if (item->is_decoded) item->kept = *image;
    return item->is_decoded;
}

static void keep(void *context, const struct zr_file_hash *hash, const struct zr_kept_image *image)
{
    struct zr_image_record *record = context;
    uint32_t number;
    struct zr_file_hash of_number;
    memcpy(&number, hash->bytes, sizeof number);
    write_number(number, &of_number);
    if (number < record->count && memcmp(&of_number, hash, sizeof of_number) == 0) {
        record->items[number].is_decoded = true;
        record->items[number].kept = *image;
        hash = &record->items[number].hash;
    }
    if (record->others.keep) record->others.keep(record->others.context, hash, image);
}

struct zr_kept_images zr_image_record_open(struct zr_image_record *record, const struct zr_kept_images *others)
{
    record->others = *others;
    record->count = 0;
    return (struct zr_kept_images){find, keep, record};
}

struct zr_kept_images zr_image_record_lend(struct zr_image_record *record)
{
    return (struct zr_kept_images){look_up, NULL, record};
}

/* ---- room for levels ---- */

static bool has_levels(const struct zr_scene *scene, uint32_t image)
{
    for (uint32_t i = 0; i < scene->texture_count; i++)
        if (scene->textures[i].image == image && zr_filter_has_levels(scene->textures[i].minify)) return true;
    return false;
}

static bool lacks_levels(const struct zr_scene *scene, uint32_t image)
{
    return !scene->images[image].levels && has_levels(scene, image);
}

static struct zr_image_levels *reserve(struct zr_arena *arena, const struct zr_image *image)
{
    struct zr_image_levels *levels = zr_arena_alloc(arena, 1, sizeof *levels);
    void *texels = zr_arena_alloc(arena, zr_image_levels_bytes(image), 1);
    if (!zr_arena_ok(arena)) return NULL;
    atomic_init(&levels->state, ZR_LEVELS_EMPTY);
    levels->texels = texels;
    return levels;
}

static void note_levels(struct zr_image_record *record, const struct zr_image *image)
{
    for (uint32_t i = 0; i < record->count; i++)
        if (record->items[i].is_decoded && record->items[i].kept.image.texels == image->texels)
            record->items[i].kept.image.levels = image->levels;
}

void zr_image_record_keep_levels(struct zr_image_record *record, struct zr_arena *arena, struct zr_scene *scene)
{
    size_t bytes = 0;
    for (uint32_t i = 0; i < scene->image_count; i++)
        if (lacks_levels(scene, i)) bytes += zr_image_levels_bytes(&scene->images[i]);
    if (bytes == 0 || bytes > zr_arena_left(arena) / ROOM_SHARE) return;
    struct zr_image *images = zr_arena_copy(arena, scene->images, scene->image_count * sizeof *images);
    for (uint32_t i = 0; images && i < scene->image_count; i++) {
        if (!lacks_levels(scene, i)) continue;
        images[i].levels = reserve(arena, &images[i]);
        note_levels(record, &images[i]);
    }
    if (images) scene->images = images;
}
