/* picks.h - scene: pixels of a view whose surfaces the output info describes (render/picks.h), and pairs of parts whose
 * distance it lists (measure/part_distance.h). */
#ifndef ZR_SCENE_PICKS_H
#define ZR_SCENE_PICKS_H

#include <stdint.h>

enum { ZR_PICKS_MAX = 64 };

/* Two parts, by name. */
struct zr_part_pair {
    const char *parts[2];
};

enum { ZR_DISTANCES_MAX = 64 };

struct zr_pick_pixels {
    uint32_t count;
    const uint32_t (*at)[2]; /* column from the left, row from the top */
};

#endif
