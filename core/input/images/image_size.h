/* image_size.h - input: limits of an image's size, checked before decoding. */
#ifndef ZR_IMAGE_SIZE_H
#define ZR_IMAGE_SIZE_H

#include "input/text/text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Texels per side, as in llvmpipe. */
enum { ZR_IMAGE_SIDE_MAX = 16384 };

/* A file that is decoded. */
struct zr_encoded_image {
    const void *bytes;
    size_t size;
    uint64_t texels_max; /* texels left for the request */
};

/* True if an image of this size may be decoded; else gives the reason. */
bool zr_image_fits(uint32_t width, uint32_t height, uint64_t texels_max, struct zr_reason *reason);

#endif
