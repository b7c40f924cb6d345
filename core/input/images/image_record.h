/* image_record.h - input: images that a reading decodes, for later readings of the same files in the same memory.
 *
 * While it is open, a record stands before the caller's kept images (core.h). Later it only looks up: any number of
 * threads may read at once. Files beyond its first ZR_IMAGES_RECORDED are decoded again. */
#ifndef ZR_IMAGE_RECORD_H
#define ZR_IMAGE_RECORD_H

#include "core.h"
#include "scene/image.h"
#include "scene/scene.h"

enum { ZR_IMAGES_RECORDED = 64 };

struct zr_image_record {
    struct zr_kept_images others; /* the caller's */
    uint32_t count;
    struct zr_recorded_image {
        const void *bytes; /* of the file; they stay as long as the record */
        size_t size;
        struct zr_file_hash hash; /* of the caller's */
        bool is_decoded;
        struct zr_kept_image kept;
    } items[ZR_IMAGES_RECORDED];
};

/* Begins a record of a reading; returns images for its request. */
struct zr_kept_images zr_image_record_open(struct zr_image_record *record, const struct zr_kept_images *others);

/* Returns images for later readings. */
struct zr_kept_images zr_image_record_lend(struct zr_image_record *record);

/* Makes room for the mipmaps of the scene's images, if it takes at most an eighth of the memory that is left: the first
 * drawing fills it, and later ones take them, also those of later readings. Takes a copy of the list of images. */
void zr_image_record_keep_levels(struct zr_image_record *record, struct zr_arena *arena, struct zr_scene *scene);

#endif
