/* lighting_reference.h - tests: sRGB (IEC 61966-2-1) and the Khronos PBR neutral tone mapper in double, written from
 * their definitions. Surfaces have a twin in GLSL (tests/reference/look_twin.c), and digests of scenes. */
#ifndef ZR_TESTS_LIGHTING_REFERENCE_H
#define ZR_TESTS_LIGHTING_REFERENCE_H

#include <math.h>

#include "shade/lights/lighting.h"

typedef struct {
    double v[3];
} d3;

static inline d3 d3_mad(d3 a, double s, d3 b)
{
    return (d3){{a.v[0] + s * b.v[0], a.v[1] + s * b.v[1], a.v[2] + s * b.v[2]}};
}

static inline d3 d3_scale(d3 a, double s)
{
    return d3_mad((d3){{0}}, s, a);
}

static inline d3 d3_mix(d3 a, d3 b, double share)
{
    return d3_mad(d3_scale(a, 1.0 - share), share, b);
}

static inline double reference_decode(double encoded)
{
    const double e = fmin(fmax(encoded, 0.0), 1.0);
    return e <= 0.04045 ? e / 12.92 : pow((e + 0.055) / 1.055, 2.4);
}

static inline double reference_encode(double linear)
{
    const double l = fmin(fmax(linear, 0.0), 1.0);
    return l <= 0.0031308 ? 12.92 * l : 1.055 * pow(l, 1.0 / 2.4) - 0.055;
}

static inline d3 d3_clamped(d3 c)
{
    for (int k = 0; k < 3; k++)
        c.v[k] = fmin(fmax(c.v[k], 0.0), 1.0);
    return c;
}

/* Khronos has a toe of 0.04; the offset of dark colours is x - 6.25 x^2 there. */
static inline d3 reference_neutral(d3 c, double toe)
{
    const double start = 0.8 - toe, x = fmin(c.v[0], fmin(c.v[1], c.v[2]));
    const double offset = x < 2.0 * toe ? x - x * x / (4.0 * toe) : toe;
    c = (d3){{c.v[0] - offset, c.v[1] - offset, c.v[2] - offset}};
    const double peak = fmax(c.v[0], fmax(c.v[1], c.v[2]));
    if (peak < start) return c;
    const double d = 1.0 - start, new_peak = 1.0 - d * d / (peak + d - start);
    const double white = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
    return d3_mix(d3_scale(c, new_peak / peak), (d3){{new_peak, new_peak, new_peak}}, white);
}

static inline d3 reference_tone(enum zr_tone tone, d3 c)
{
    if (tone == ZR_TONE_KHRONOS) c = reference_neutral(c, 0.04);
    if (tone == ZR_TONE_NEUTRAL) c = reference_neutral(c, 0.02);
    return d3_clamped(c);
}

#endif
