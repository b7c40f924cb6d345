#include "output/images/depth16.h"

#include <math.h>
#include <string.h>

float zr_depth16_scale(const struct zr_frame *frame, float given)
{
    if (given > 0.0f) return given;
    const bool unknown = frame->camera.znear == 0.0f && frame->camera.zfar == 0.0f;
    const float scale = (unknown ? frame->deepest : frame->camera.zfar) / 65535.0f;
    return scale > 0.0f && isfinite(scale) ? scale : 1.0f;
}

/* Rounds as the kernel does. */
static uint16_t step_in_range(const struct zr_depth16 *d, float depth, uint32_t *clamped)
{
    if (depth < d->range[0]) return 0;
    if (depth > d->range[1]) return 65535;
    const float step = rintf(depth / d->scale);
    *clamped += !(step >= 1.0f) || step > 65535.0f;
    return (uint16_t)fminf(fmaxf(step, 1.0f), 65535.0f);
}

static void make_row_in_range(void *source, uint32_t y, void *row, bool again)
{
    struct zr_depth16 *d = source;
    const uint32_t width = d->frame->width;
    const float *depth = d->frame->depth + (size_t)y * width;
    uint16_t *out = row;
    uint32_t clamped = 0;
    for (uint32_t x = 0; x < width; x++)
        out[x] = step_in_range(d, depth[x], &clamped);
    if (!again && clamped > 0) atomic_fetch_add_explicit(&d->clamped, clamped, memory_order_relaxed);
}

static void make_row(void *source, uint32_t y, void *row, bool again)
{
    struct zr_depth16 *d = source;
    const uint32_t width = d->frame->width;
    const struct zr_column_span span = d->spans ? d->spans[y] : (struct zr_column_span){0, width};
    const float *depth = d->values + (size_t)y * width;
    uint16_t *out = row;
    memset(out, 0, span.begin * sizeof *out);
    const uint32_t clamped = d->quantize(depth + span.begin, d->scale, span.end - span.begin, out + span.begin);
    memset(out + span.end, 0, (width - span.end) * sizeof *out);
    if (!again && clamped > 0) atomic_fetch_add_explicit(&d->clamped, clamped, memory_order_relaxed);
}

struct zr_rows zr_depth16_rows(struct zr_depth16 *depth16)
{
    return (struct zr_rows){depth16->range ? make_row_in_range : make_row, depth16};
}
