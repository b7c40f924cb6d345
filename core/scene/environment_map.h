/* environment_map.h - scene: light of an environment image, gathered for several roughnesses.
 *
 * Layout: octahedral maps, one per level, one after the other. A direction (x, y, z), y up, has the place (p, q) =
 *         (x, z) / (|x| + |y| + |z|); below the horizon, it is ((1 - |q|) sign p, (1 - |p|) sign q). Texel (i, j) of a
 *         map with `side` texels is centred at p = 2 (i + 0.5) / side - 1, and likewise q. Each map has a border of one
 *         texel, which continues it: rows have side + 2 texels of four floats, RGB and 0.
 * Source: Engelhardt & Dachsbacher, "Octahedron Environment Maps", 2008.
 */
#ifndef ZR_ENVIRONMENT_MAP_H
#define ZR_ENVIRONMENT_MAP_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

/* ROW(roughness, side, side of the map that is gathered): the lobes of rougher levels need fewer texels. */
#define ZR_MAP_LEVEL_ROWS(ROW)                                                                                         \
    ROW(0.0f, 512, 512)                                                                                                \
    ROW(0.1f, 128, 256) ROW(0.2f, 64, 128) ROW(0.3f, 64, 64) ROW(0.45f, 32, 64) ROW(0.65f, 32, 32) ROW(1.0f, 32, 32)

#define ZR_MAP_COUNT_LEVEL(...)           +1
#define ZR_MAP_COUNT_TEXELS(r, side, ...) +((side) + 2) * ((side) + 2)
enum {
    ZR_MAP_LEVELS = ZR_MAP_LEVEL_ROWS(ZR_MAP_COUNT_LEVEL),
    ZR_MAP_TEXELS = ZR_MAP_LEVEL_ROWS(ZR_MAP_COUNT_TEXELS),
    ZR_MAP_HARMONICS = 9
};

struct zr_environment_map {
    uint64_t image_texels;               /* of the image that it was made from */
    const float *texels;                 /* of all levels: 4 * ZR_MAP_TEXELS floats */
    zr_vec3 harmonics[ZR_MAP_HARMONICS]; /* irradiance / pi, as in shade/lights/environment.h */
    bool has_sun;                        /* light that is too bright and small for the maps, which lack it */
    zr_vec3 sun_direction;               /* unit vector along which it travels */
    zr_vec3 sun_color;                   /* irradiance / pi */
};

#endif
