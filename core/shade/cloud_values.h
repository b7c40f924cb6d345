/* cloud_values.h - shade: colours of visible points of clouds, made when they are needed.
 *
 * A cloud's attribute COLOR (draw_attributes.h) is the mesh's own array, or else the material's colour. */
#ifndef ZR_CLOUD_VALUES_H
#define ZR_CLOUD_VALUES_H

#include "base/inlined.h"
#include "shade/draw_attributes.h"

/* Prefetches the values of visible points of a cloud, which lie anywhere in memory. (gcc 12 drops calls of functions
 * that only prefetch, unless they are inlined.) */
ZR_INLINED void zr_cloud_prefetch(const struct zr_draw_attributes *of_draw, const uint32_t *owners, uint32_t count)
{
    const struct zr_attribute *color = &of_draw->attributes[ZR_ATTRIBUTE_COLOR];
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t position = zr_cloud_position(of_draw->draw, owners[i] - 1);
        __builtin_prefetch(&of_draw->draw->mesh->positions[position]);
        if (color->rate == ZR_RATE_VERTEX) __builtin_prefetch(&color->values[position]);
    }
}

/* Returns the vertex colour times the material's, or the latter. */
zr_vec4 zr_cloud_color(const struct zr_draw_attributes *of_draw, uint32_t number);

#endif
