/* lighting_reference.h - tests: colours of lit surfaces in double, written from the definitions: sRGB (IEC 61966-2-1),
 * the Khronos PBR neutral tone mapper, glTF 2.0 appendix B for lamps, the split sum for what comes from all around. */
#ifndef ZR_TESTS_LIGHTING_REFERENCE_H
#define ZR_TESTS_LIGHTING_REFERENCE_H

#include "environment_reference.h"
#include "shade/lights/dfg.h"
#include "shade/lights/lighting.h"

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

/* The share of light from all around that reaches a surface in a crease: a cubic fit by Jimenez and others, 2016,
 * which ends at 1.0001: where nothing occludes, no more than all arrives. */
static inline double reference_bounced(double open, double albedo)
{
    const double a = 2.0404 * albedo - 0.3324, b = -4.7951 * albedo + 0.6417, c = 2.7552 * albedo + 0.6903;
    return fmin(fmax(open, ((open * a + b) * open + c) * open), 1.0);
}

/* ---- surfaces ---- */

struct reference_surface {
    d3 base; /* linear */
    d3 normal, to_eye;
    double open, metallic, roughness;
};

static inline d3 reference_f0(const struct reference_surface *s)
{
    return d3_mix((d3){{0.04, 0.04, 0.04}}, s->base, s->metallic);
}

/* D V of glTF 2.0 appendix B, with H between `l` and the eye. */
static inline double reference_specular_brdf(const struct reference_surface *s, d3 l, double alpha)
{
    const double pi = 3.14159265358979323846, square = alpha * alpha;
    const d3 h = d3_unit(d3_mad(l, 1.0, s->to_eye));
    const double nh = d3_dot(s->normal, h), nl = d3_dot(s->normal, l), nv = d3_dot(s->normal, s->to_eye);
    const double f = nh * nh * (square - 1.0) + 1.0;
    if (nh <= 0.0) return 0.0;
    return square / (pi * f * f) * 0.5 /
           (nl * sqrt(nv * nv * (1.0 - square) + square) + nv * sqrt(nl * nl * (1.0 - square) + square));
}

/* (1 - |V.H|)^5 */
static inline double reference_schlick(const struct reference_surface *s, d3 l)
{
    return pow(1.0 - fabs(d3_dot(s->to_eye, d3_unit(d3_mad(l, 1.0, s->to_eye)))), 5.0);
}

/* From a lamp in direction `l` whose irradiance is pi at normal incidence: the appendix's final form, with one F0 and
 * one diffuse colour for a mix of dielectric and metal. Lamps are not seen in mirrors of alpha less than 0.06. */
static inline d3 reference_lamp(const struct reference_surface *s, d3 l)
{
    const double pi = 3.14159265358979323846, nl = d3_dot(s->normal, l);
    d3 out = {{0}};
    if (nl <= 0.0) return out;
    const double specular = reference_specular_brdf(s, l, fmax(s->roughness * s->roughness, 0.06));
    const double schlick = reference_schlick(s, l);
    const d3 f0 = reference_f0(s);
    for (int k = 0; k < 3; k++) {
        const double f = f0.v[k] + (1.0 - f0.v[k]) * schlick, diffuse = s->base.v[k] * (1.0 - s->metallic) / pi;
        out.v[k] = pi * nl * (f * specular + (1.0 - f) * diffuse);
    }
    return out;
}

/* The same as the appendix begins: a mix of two whole surfaces. Between dielectric and metal it is another one. */
static inline d3 reference_lamp_of_two(const struct reference_surface *s, d3 l)
{
    struct reference_surface dielectric = *s, metal = *s;
    dielectric.metallic = 0.0;
    metal.metallic = 1.0;
    return d3_mix(reference_lamp(&dielectric, l), reference_lamp(&metal, l), s->metallic);
}

/* A and B, of the table, between its rows and columns. */
static inline void reference_split_sum(double roughness, double nv, double *a, double *b)
{
    const double row = roughness * 31.0, column = sqrt(nv) * 31.0;
    const int i = row < 30.0 ? (int)row : 30, j = column < 30.0 ? (int)column : 30;
    const double x = column - j, y = row - i;
    double out[2];
    for (int k = 0; k < 2; k++) {
        const float *here = zr_dfg_table[i][k], *next = zr_dfg_table[i + 1][k];
        out[k] = (1 - y) * ((1 - x) * (double)here[j] + x * (double)here[j + 1]) +
                 y * ((1 - x) * (double)next[j] + x * (double)next[j + 1]);
    }
    *a = out[0];
    *b = out[1];
}

/* Of irradiance (divided by pi) and mirrored radiance. */
static inline d3 reference_around(const struct reference_surface *s, d3 irradiance, d3 radiance)
{
    const d3 f0 = reference_f0(s);
    double a, b;
    d3 out;
    reference_split_sum(s->roughness, fmin(fmax(d3_dot(s->normal, s->to_eye), 1e-4), 1.0), &a, &b);
    for (int k = 0; k < 3; k++) {
        const double c = s->base.v[k] * (1.0 - s->metallic), lost = 1.0 - a - b, single = f0.v[k] * a + b;
        const double average = f0.v[k] + (1.0 - f0.v[k]) / 21.0, several = single * average / (1.0 - lost * average);
        const double open = reference_bounced(s->open, fmin(fmax(c + f0.v[k], 0.0), 1.0));
        out.v[k] = single * radiance.v[k] * s->open +
                   (several * lost + c * (1.0 - single - several * lost)) * irradiance.v[k] * open;
    }
    return out;
}

static inline d3 reference_mirrored(const struct reference_surface *s)
{
    return d3_mad(d3_scale(s->to_eye, -1.0), 2.0 * d3_dot(s->normal, s->to_eye), s->normal);
}

#endif
