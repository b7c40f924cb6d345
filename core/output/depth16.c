#include "output/depth16.h"

#include <math.h>
#include <stdatomic.h>

static const float STEP_MAX = 65535.0f;

enum { ROWS_A_RANGE = 64 };

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

/* Without branches, so that the compiler makes vectors of it; rintf would be a call. Beyond 2^22 steps the sum does not
 * round any more, and is too high anyway. */
static uint32_t make_row(const float *depth, float scale, uint32_t width, uint16_t *out)
{
    const float no_fraction = 12582912.0f; /* 1.5 * 2^23: to an integer, ties to even */
    uint32_t misfits = 0;
    for (uint32_t i = 0; i < width; i++) {
        const float step = (depth[i] / scale + no_fraction) - no_fraction;
        const bool nothing = depth[i] == INFINITY, low = !(step >= 1.0f), high = step > STEP_MAX;
        float value = low ? 1.0f : step;
        value = high ? STEP_MAX : value;
        value = nothing ? 0.0f : value;
        out[i] = (uint16_t)(int32_t)value;
        misfits += (uint32_t)((depth[i] != INFINITY) & (low | high));
    }
    return misfits;
}

struct making {
    const struct zr_frame *frame;
    float scale;
    uint16_t *out;
    atomic_uint_fast64_t misfits;
};

static void make_rows(void *context, size_t begin, size_t end)
{
    struct making *m = context;
    const size_t width = m->frame->width;
    uint64_t misfits = 0;
    for (size_t y = begin; y < end; y++)
        misfits += make_row(m->frame->depth + y * width, m->scale, m->frame->width, m->out + y * width);
    atomic_fetch_add_explicit(&m->misfits, misfits, memory_order_relaxed);
}

uint64_t zr_depth16_make(struct zr_team *team, const struct zr_frame *frame, float scale, uint16_t *out)
{
    struct making making = {.frame = frame, .scale = scale, .out = out};
    zr_team_ranges(team, frame->height, ROWS_A_RANGE, make_rows, &making);
    return making.misfits;
}
