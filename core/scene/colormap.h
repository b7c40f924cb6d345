/* colormap.h - scene: published colour maps, from a number of 0..1 to a colour.
 *
 * Source: viridis: N. Smith and S. van der Walt, matplotlib (CC0). turbo: A. Mikhailov, Google. coolwarm: K. Moreland,
 *         "Diverging Color Maps for Scientific Visualization" (2009), from (59, 76, 192) to (180, 4, 38).
 * Exact:  each is a table of 129 equidistant colours of 8 bits per channel, interpolated linearly: within 0.8 of 255 of
 *         its authors' definition. gray is linear from black to white.
 */
#ifndef ZR_COLORMAP_H
#define ZR_COLORMAP_H

#include <stdbool.h>

#include "base/vec.h"

enum zr_colormap { ZR_COLORMAP_VIRIDIS, ZR_COLORMAP_TURBO, ZR_COLORMAP_GRAY, ZR_COLORMAP_COOLWARM, ZR_COLORMAP_COUNT };

/* Returns the opaque, sRGB-encoded colour at `at`, 0 <= at <= 1. */
zr_vec4 zr_colormap_color(enum zr_colormap map, float at);

/* Scale of a mesh's scalars: `low` has the first colour of the map, `high` the last one. Both are finite, low <= high;
 * if they are equal, that number has the middle colour. */
struct zr_color_scale {
    enum zr_colormap map;
    float low, high;
    bool is_given; /* the scene gives low and high; else they are the least and the largest scalar */
};

#endif
