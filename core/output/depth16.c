#include "output/depth16.h"

#include <math.h>

static const float STEP_MAX = 65535.0f;

float zr_depth16_scale(const struct zr_frame *frame, float asked)
{
    if (asked > 0.0f) return asked;
    float deepest = frame->camera.zfar;
    if (frame->camera.znear == 0.0f && deepest == 0.0f) {
        size_t pixels = (size_t)frame->width * frame->height;
        for (size_t i = 0; i < pixels; i++)
            if (isfinite(frame->depth[i]) && frame->depth[i] > deepest) deepest = frame->depth[i];
    }
    float scale = deepest / STEP_MAX;
    return scale > 0.0f && isfinite(scale) ? scale : 1.0f;
}

uint64_t zr_depth16_make(const struct zr_frame *frame, float scale, uint16_t *out)
{
    size_t pixels = (size_t)frame->width * frame->height;
    uint64_t misfits = 0;
    for (size_t i = 0; i < pixels; i++) {
        float depth = frame->depth[i];
        if (depth == INFINITY) {
            out[i] = 0;
            continue;
        }
        float step = rintf(depth / scale);
        bool low = !(step >= 1.0f), high = step > STEP_MAX;
        misfits += low || high;
        out[i] = low ? 1 : high ? UINT16_MAX : (uint16_t)step;
    }
    return misfits;
}
