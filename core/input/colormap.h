/* colormap.h - input: a number of 0..1 -> a colour, by maps that others have published.
 *
 * Source: viridis: N. Smith and S. van der Walt, matplotlib (CC0). turbo: A. Mikhailov, Google. coolwarm: K. Moreland,
 *         "Diverging Color Maps for Scientific Visualization" (2009), from (59, 76, 192) to (180, 4, 38). Each is 129
 *         colours of 8 bits a channel here, equally far apart, and linear between them: within 0.8 of 255 of what its
 *         authors define. gray is linear from black to white.
 */
#ifndef ZR_COLORMAP_H
#define ZR_COLORMAP_H

#include "base/vec.h"
#include "input/names.h"

enum zr_colormap { ZR_COLORMAP_VIRIDIS, ZR_COLORMAP_TURBO, ZR_COLORMAP_GRAY, ZR_COLORMAP_COOLWARM, ZR_COLORMAP_COUNT };

extern const struct zr_names zr_colormap_names;

/* 0 <= at <= 1. An opaque colour, encoded as sRGB, as those of scenes are. */
zr_vec4 zr_colormap_color(enum zr_colormap map, float at);

#endif
