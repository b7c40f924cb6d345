#include "images.h"

#include <stdlib.h>
#include <string.h>

#include <nettle/sha2.h>

#include "scene/image.h"

_Static_assert(sizeof(struct zr_file_hash) == SHA256_DIGEST_SIZE, "the hash of images is SHA-256");

struct image {
    struct kept_value value;
    struct zr_kept_image kept;
    struct zr_image_levels levels;
    unsigned char texels[]; /* of the image, then room for its levels */
};

static void take(const struct kept_value *value, void *out)
{
    *(struct zr_kept_image *)out = ((const struct image *)value)->kept;
}

/* Applies the stricter limits of two decodings of one image, which another request kept meanwhile or before. */
static void widen(struct kept_value *there, const struct kept_value *other)
{
    struct zr_kept_image *kept = &((struct image *)there)->kept;
    const struct zr_kept_image *more = &((const struct image *)other)->kept;
    if (more->texels_max < kept->texels_max) kept->texels_max = more->texels_max;
    if (more->scratch_bytes > kept->scratch_bytes) kept->scratch_bytes = more->scratch_bytes;
}

struct kept *images_open(uint64_t max_bytes)
{
    static const struct kept_kind kind = {take, widen, NULL};
    return kept_open(&kind, max_bytes);
}

static bool find(void *context, const void *bytes, size_t size, struct zr_file_hash *hash, struct zr_kept_image *kept)
{
    struct images_use *use = context;
    texts_hash(use->texts, bytes, size, hash);
    if (kept_find(use->images, hash, &use->held, kept)) return true;
    kept_miss(use->images);
    return false;
}

static void keep(void *context, const struct zr_file_hash *hash, const struct zr_kept_image *kept)
{
    struct kept *images = ((struct images_use *)context)->images;
    const size_t texels = zr_image_bytes(&kept->image), room = texels + zr_image_levels_bytes(&kept->image);
    struct image *made = room <= kept_max_bytes(images) ? malloc(sizeof *made + room) : NULL;
    if (!made) return;
    *made = (struct image){.value = {.hash = *hash, .bytes = sizeof *made + room}, .kept = *kept};
    made->levels.texels = made->texels + texels;
    made->kept.image.levels = &made->levels;
    memcpy(made->texels, kept->image.texels, texels);
    made->kept.image.texels = made->texels;
    kept_add(images, &made->value, NULL);
}

struct zr_kept_images images_lend(struct images_use *use)
{
    if (!use->images || kept_max_bytes(use->images) == 0) return (struct zr_kept_images){NULL, NULL, NULL};
    return (struct zr_kept_images){find, keep, use};
}

void images_release(struct images_use *use)
{
    kept_release(use->images, &use->held);
}
