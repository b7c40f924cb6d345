/* model_map.h - overlay: the pixels of the model, with those of holes in it, for places of notes.
 *
 * Model: pixels with a face, and background that touches no border of the picture.
 * Sums:  counts of pixels above and to the left, so that a box is tested by four of them. */
#ifndef ZR_MODEL_MAP_H
#define ZR_MODEL_MAP_H

#include "overlay/annotate/layout.h"

struct zr_model_map {
    uint32_t width, height;
    const uint8_t *is_model; /* per pixel */
    const uint32_t *sums;    /* (width + 1) x (height + 1) */
};

/* Makes the map in the layout's arena. False without memory, if cancelled, or if the layout has no ids. */
bool zr_model_map_make(const struct zr_layout *layout, struct zr_model_map *out);

/* True if the box has no pixel of the model. */
bool zr_model_map_is_free(const struct zr_model_map *map, struct zr_rect rect);

/* True if the place lies on the model. */
static inline bool zr_model_map_at(const struct zr_model_map *map, double x, double y)
{
    if (!(x >= 0.0 && y >= 0.0 && x < (double)map->width && y < (double)map->height)) return false;
    return map->is_model[(size_t)y * map->width + (size_t)x] != 0;
}

#endif
