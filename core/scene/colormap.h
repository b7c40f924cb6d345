/* colormap.h - scene: a number of 0..1 -> a colour, by maps that others have published.
 *
 * Source: viridis: N. Smith and S. van der Walt, matplotlib (CC0). turbo: A. Mikhailov, Google. coolwarm: K. Moreland,
 *         "Diverging Color Maps for Scientific Visualization" (2009), from (59, 76, 192) to (180, 4, 38). Each is 129
 *         colours of 8 bits a channel here, equally far apart, and linear between them: within 0.8 of 255 of what its
 *         authors define. gray is linear from black to white.
 */
#ifndef ZR_COLORMAP_H
#define ZR_COLORMAP_H

#include <stdbool.h>

#include "base/vec.h"

enum zr_colormap { ZR_COLORMAP_VIRIDIS, ZR_COLORMAP_TURBO, ZR_COLORMAP_GRAY, ZR_COLORMAP_COOLWARM, ZR_COLORMAP_COUNT };

/* 0 <= at <= 1. An opaque colour, encoded as sRGB, as those of scenes are. */
zr_vec4 zr_colormap_color(enum zr_colormap map, float at);

/* What colours of a mesh stand for: numbers from `low`, which has the first colour of the map, to `high`, which has the
 * last one. Both are finite, low <= high; where they are equal, that number has the colour of the middle. */
struct zr_color_scale {
    enum zr_colormap map;
    float low, high;
    bool is_asked; /* these ends were asked for; else they are those of the numbers that there are */
};

#endif
