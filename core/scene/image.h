/* image.h - scene: decoded image of a texture. */
#ifndef ZR_IMAGE_H
#define ZR_IMAGE_H

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "base/hash.h"

enum zr_levels_state { ZR_LEVELS_EMPTY, ZR_LEVELS_WRITTEN, ZR_LEVELS_PLAIN, ZR_LEVELS_LINEAR };

/* Room for the mipmap levels of an image that the caller keeps: level 1 and all smaller ones, one after the other. The
 * first thread that has made them fills it; they stay. */
struct zr_image_levels {
    atomic_int state; /* WRITTEN: a thread fills the room; PLAIN, LINEAR: averaged as they are, or in linear light */
    void *texels;
};

struct zr_image {
    uint32_t width, height;
    uint32_t bits;                  /* per channel: 8 or 16 */
    const void *texels;             /* RGBA, row 0 on top: four uint8_t or uint16_t per texel */
    struct zr_image_levels *levels; /* NULL: not kept */
};

/* A decoded image with the limits under which its file was accepted. */
struct zr_kept_image {
    struct zr_image image;
    uint64_t texels_max;  /* limit of texels at decoding; a larger limit accepts the file, too */
    size_t scratch_bytes; /* upper bound of the memory of decoding, without the texels */
};

static inline size_t zr_image_bytes(const struct zr_image *image)
{
    return (size_t)image->width * image->height * (image->bits / 2);
}

/* Returns the side of the next smaller level. */
static inline uint32_t zr_image_half(uint32_t side)
{
    return side > 1 ? side / 2 : 1;
}

/* Returns the bytes of all levels but the image itself. */
static inline size_t zr_image_levels_bytes(const struct zr_image *image)
{
    size_t bytes = 0;
    for (struct zr_image level = *image; level.width > 1 || level.height > 1; bytes += zr_image_bytes(&level)) {
        level.width = zr_image_half(level.width);
        level.height = zr_image_half(level.height);
    }
    return bytes;
}

#endif
