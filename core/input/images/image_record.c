#include "input/images/image_record.h"

#include <string.h>

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
