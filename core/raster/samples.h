/* samples.h - raster: visibility at every sample of a window, for algorithms that do not work
 * tile by tile.
 *
 * Space:  window space, y up: sample x, y is at [y * width + x], row 0 the lowest.
 */
#ifndef ZR_SAMPLES_H
#define ZR_SAMPLES_H

#include "raster/primitive.h"

struct zr_samples {
    uint32_t width, height;
    float *depth;    /* window depth */
    uint32_t *owner; /* 1 + number of the primitive, 0 where nothing is seen */
};

/* The z-buffer: the hit is seen where it is nearer than what is there. At equal depth the earlier stays. */
static inline void zr_samples_put(struct zr_samples *samples, int32_t x, int32_t y, struct zr_hit hit)
{
    size_t i = (size_t)y * samples->width + (size_t)x;
    if (!(hit.depth < samples->depth[i])) return;
    samples->depth[i] = hit.depth;
    samples->owner[i] = hit.owner;
}

#endif
