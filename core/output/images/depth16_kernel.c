#include "output/images/depth16.h"

#include <math.h>
#include <string.h>

#include "base/simd/simd.h"

enum { SPAN = 64 };

/* Returns true if SPAN pixels are uncovered. Often three quarters of a picture are: this skips their division. */
static bool is_uncovered(const float *depth)
{
    const uint32_t infinity = UINT32_C(0x7f800000);
    uint32_t different = 0;
    for (int i = 0; i < SPAN; i++) {
        uint32_t bits;
        memcpy(&bits, depth + i, sizeof bits);
        different |= bits ^ infinity;
    }
    return different == 0;
}

/* Has no branches, so that the compiler vectorizes it; rintf would be a call. From 2^22 steps on, the sum no longer
 * rounds, but the result is clamped anyway. */
static uint32_t make_span(const float *depth, float scale, uint32_t count, uint16_t *out)
{
    const float no_fraction = 12582912.0f; /* 1.5 * 2^23: rounds to an integer, ties to even */
    const float most = 65535.0f;
    uint32_t clamped = 0;
    for (uint32_t i = 0; i < count; i++) {
        const float step = (depth[i] / scale + no_fraction) - no_fraction;
        const bool uncovered = depth[i] == INFINITY, low = !(step >= 1.0f), high = step > most;
        float value = low ? 1.0f : step;
        value = high ? most : value;
        value = uncovered ? 0.0f : value;
        out[i] = (uint16_t)(int32_t)value;
        clamped += (uint32_t)((depth[i] != INFINITY) & (low | high));
    }
    return clamped;
}

uint32_t ZR_KERNEL(zr_depth16)(const float *depth, float scale, uint32_t width, uint16_t *out)
{
    uint32_t clamped = 0;
    for (uint32_t x = 0; x < width; x += SPAN) {
        const uint32_t count = width - x < SPAN ? width - x : SPAN;
        if (count == SPAN && is_uncovered(depth + x))
            memset(out + x, 0, SPAN * sizeof *out);
        else
            clamped += make_span(depth + x, scale, count, out + x);
    }
    return clamped;
}
