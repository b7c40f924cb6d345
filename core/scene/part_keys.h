/* part_keys.h - scene: the keys of a scene that change its parts (scene/parts/part_list.h), as read. */
#ifndef ZR_PART_KEYS_H
#define ZR_PART_KEYS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "scene/csg.h"
#include "scene/part_set.h"

struct zr_part_highlight {
    struct zr_part_set parts;
    zr_vec4 color; /* opaque, sRGB-encoded */
};

/* The scene's own colours, one colour per part by its name, only the base colours of materials, or by a coordinate. */
enum zr_color_source {
    ZR_COLORS_OWN,
    ZR_COLORS_PARTS,
    ZR_COLORS_MATERIALS,
    ZR_COLORS_X,
    ZR_COLORS_Y,
    ZR_COLORS_Z,
    ZR_COLORS_COUNT
};

enum zr_explode_axis { ZR_EXPLODE_RADIAL, ZR_EXPLODE_X, ZR_EXPLODE_Y, ZR_EXPLODE_Z, ZR_EXPLODE_AXES };

struct zr_part_keys {
    struct zr_part_set hide, isolate, ghost;
    uint32_t highlight_count;
    const struct zr_part_highlight *highlights;
    double explode; /* factor; 0: not exploded */
    enum zr_explode_axis explode_axis;
    enum zr_color_source colors;
    struct zr_csg_keys csg;
};

/* True if a key changes the scene. */
static inline bool zr_part_keys_are_given(const struct zr_part_keys *keys)
{
    return keys->hide.count > 0 || keys->isolate.count > 0 || keys->ghost.count > 0 || keys->highlight_count > 0 ||
           keys->explode != 0.0 || keys->colors == ZR_COLORS_PARTS || keys->csg.count > 0;
}

/* Two parts, by name, whose distance the output info lists (measure/part_distance.h). */
enum { ZR_DISTANCES_MAX = 64 };

struct zr_part_pair {
    const char *parts[2];
};

#endif
