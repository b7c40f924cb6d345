/* gif_colors.h - output: at most 256 colours for a picture, and the number of each pixel's colour. */
#ifndef ZR_GIF_COLORS_H
#define ZR_GIF_COLORS_H

#include "output/images/gif.h"

struct zr_gif_colors {
    uint32_t count;
    int transparent; /* number of the colour of transparent pixels; -1: none */
    uint8_t colors[256][3];
    uint8_t *indices; /* one per pixel, in the arena */
};

/* Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_gif_colors_make(const struct zr_gif *gif, struct zr_arena *arena, const struct zr_cancel *cancel,
                                  struct zr_gif_colors *colors);

#endif
