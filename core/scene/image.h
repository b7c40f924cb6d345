/* image.h - scene: a picture that textures take their texels from, decoded. */
#ifndef ZR_IMAGE_H
#define ZR_IMAGE_H

#include <stdint.h>

struct zr_image {
    uint32_t width, height;
    uint32_t bits;      /* 8 or 16 a channel */
    const void *texels; /* RGBA, row 0 on top: uint8_t or uint16_t, four a texel */
};

#endif
