/* gif_colors.h - output: at most 256 colours for a picture, and the number of each pixel's colour. */
#ifndef ZR_GIF_COLORS_H
#define ZR_GIF_COLORS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/status.h"

struct zr_gif {
    uint32_t width, height; /* 1..65535 */
    const uint8_t *rgba;    /* row 0 is the top */
    bool has_alpha;         /* else alpha counts as 255 */
};

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
