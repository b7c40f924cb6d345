/* image.h - scene: decoded image of a texture. */
#ifndef ZR_IMAGE_H
#define ZR_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "base/hash.h"

struct zr_image {
    uint32_t width, height;
    uint32_t bits;      /* per channel: 8 or 16 */
    const void *texels; /* RGBA, row 0 on top: four uint8_t or uint16_t per texel */
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

#endif
