/* image.h - scene: decoded image of a texture. */
#ifndef ZR_IMAGE_H
#define ZR_IMAGE_H

#include <stdint.h>

struct zr_image {
    uint32_t width, height;
    uint32_t bits;      /* per channel: 8 or 16 */
    const void *texels; /* RGBA, row 0 on top: four uint8_t or uint16_t per texel */
};

#endif
