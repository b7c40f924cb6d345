/* backdrop.h - shade: the picture behind glass: that of the other surfaces, with levels for look-ups.
 *
 * Levels: level 0 has the pixels of the picture, each further one half of their number along both sides, rounded up.
 *         Texels have four floats: linear red, green and blue as they are shown, and an unused one. Row 0 is the
 *         lowest.
 */
#ifndef ZR_BACKDROP_H
#define ZR_BACKDROP_H

#include <stdint.h>

#include "base/vec.h"

enum { ZR_BACKDROP_LEVELS = 16 };

struct zr_backdrop {
    const float *texels; /* of all levels; NULL: the background is transparent, and light passes straight on */
    int32_t level_count, first[ZR_BACKDROP_LEVELS], width[ZR_BACKDROP_LEVELS], height[ZR_BACKDROP_LEVELS];
    float roughest; /* level of roughness 1 */
    /* Points of the G-buffer, and 1, to x and y in pixels, both times w, and w. */
    float to_window[3][4];
    /* Per material: length of rays in the volume, in eye space; and the power of the attenuation's colour. */
    const float *thickness, *power;
};

/* Largest power of a colour. */
#define ZR_BACKDROP_POWER_MAX 32768.0f

#endif
