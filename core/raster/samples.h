/* samples.h - raster: visibility at every sample of a window, for algorithms that do not work tile by tile.
 *
 * Space:  window space, y up: sample x, y is at [y * width + x], row 0 the lowest. */
#ifndef ZR_SAMPLES_H
#define ZR_SAMPLES_H

#include "raster/fragments.h"
#include "raster/primitive.h"

struct zr_trace; /* textbook/trace.h */

struct zr_samples {
    uint32_t width, height;
    float *depth;                   /* window depth */
    uint32_t *owner;                /* 1 + number of the primitive, 0 if uncovered */
    enum zr_alpha_mode drawn;       /* alpha mode of the drawn primitives; others are skipped */
    struct zr_fragments *fragments; /* receives fragments in place of depth and owner; NULL for opaque primitives */
    struct zr_trace *trace;         /* receives the steps of the algorithm; NULL: they are not recorded */
};

static inline bool zr_samples_take(const struct zr_samples *samples, const struct zr_draw *draw)
{
    return zr_draw_mode(draw) == samples->drawn;
}

/* The z-buffer: stores the hit if it is nearer than the sample. At equal depth, the earlier stays. Lists of fragments
 * also get those of equal depth, which zr_visibility_fragments may need. */
static inline void zr_samples_put(struct zr_samples *samples, int32_t x, int32_t y, struct zr_hit hit)
{
    size_t i = (size_t)y * samples->width + (size_t)x;
    if (samples->fragments) {
        if (hit.depth <= samples->depth[i]) zr_fragments_put(samples->fragments, (uint32_t)i, hit.depth, hit.owner);
        return;
    }
    if (!(hit.depth < samples->depth[i])) return;
    samples->depth[i] = hit.depth;
    samples->owner[i] = hit.owner;
}

#endif
