/* environment_reference.h - tests: environments in double, written from their definitions: radiance blurred by GGX,
 * irradiance as a polynomial and as the integral that it stands for. */
#ifndef ZR_TESTS_ENVIRONMENT_REFERENCE_H
#define ZR_TESTS_ENVIRONMENT_REFERENCE_H

#include <math.h>

#include "shade/lights/environment.h"

typedef struct {
    double v[3];
} d3;

static inline d3 d3_of(zr_vec3 v)
{
    return (d3){{(double)v.x, (double)v.y, (double)v.z}};
}

static inline double d3_dot(d3 a, d3 b)
{
    return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}

static inline d3 d3_mad(d3 a, double s, d3 b)
{
    return (d3){{a.v[0] + s * b.v[0], a.v[1] + s * b.v[1], a.v[2] + s * b.v[2]}};
}

static inline d3 d3_scale(d3 a, double s)
{
    return d3_mad((d3){{0}}, s, a);
}

static inline d3 d3_unit(d3 a)
{
    const double length = sqrt(d3_dot(a, a));
    return length > 0.0 ? d3_scale(a, 1.0 / length) : a;
}

static inline d3 d3_cross(d3 a, d3 b)
{
    return (d3){
        {a.v[1] * b.v[2] - a.v[2] * b.v[1], a.v[2] * b.v[0] - a.v[0] * b.v[2], a.v[0] * b.v[1] - a.v[1] * b.v[0]}};
}

static inline d3 d3_mix(d3 a, d3 b, double share)
{
    return d3_mad(d3_scale(a, 1.0 - share), share, b);
}

/* A step at 0 as GGX blurs it. */
static inline double reference_step(double x, double w)
{
    return 0.5 + 0.5 * x / sqrt(x * x + w * w);
}

static inline double reference_box(const struct zr_environment_box *box, d3 d, double blur)
{
    const d3 m = d3_unit(d3_of(box->middle)), t = d3_unit(d3_cross((d3){{0, 1, 0}}, m));
    const double w0 = (double)box->w0, w = sqrt(w0 * w0 + blur * blur), a = (double)box->a, h = (double)box->h;
    const double u = d3_dot(d, t), v = d3_dot(d, d3_cross(m, t));
    return (reference_step(u + a, w) - reference_step(u - a, w)) *
           (reference_step(v + h, w) - reference_step(v - h, w)) * reference_step(d3_dot(d, m), w);
}

static inline double reference_lobe(const struct zr_environment_light *light, d3 d, double blur)
{
    const double w0 = (double)light->lobe_width, square = w0 * w0 + blur * blur;
    const double fall = 1.0 + 2.0 * (1.0 - d3_dot(d, d3_unit(d3_of(light->lobe)))) / square;
    return w0 * w0 / square / (fall * fall);
}

/* E, the irradiance divided by pi. */
static inline d3 reference_irradiance(const struct zr_environment_light *light, d3 n)
{
    const double x = n.v[0], y = n.v[1], z = n.v[2];
    const double f[ZR_HARMONICS] = {1, x, y, z, x * y, y * z, z * x, 3 * z * z - 1, x * x - y * y};
    d3 sum = {{0}};
    for (int i = 0; i < ZR_HARMONICS; i++)
        sum = d3_mad(sum, f[i], d3_of(light->harmonics[i]));
    return (d3){{fmax(sum.v[0], 0), fmax(sum.v[1], 0), fmax(sum.v[2], 0)}};
}

/* L. */
static inline d3 reference_radiance(const struct zr_environment_light *light, d3 d, double alpha)
{
    const double blur = 2.0 * alpha / (1.0 + 2.2 * alpha), hw = (double)light->half_width;
    const double up = reference_step(d.v[1], sqrt(hw * hw + blur * blur));
    d3 sum = d3_mix(d3_of(light->ground), d3_of(light->sky), up);
    for (uint32_t i = 0; i < light->box_count; i++)
        sum = d3_mad(sum, reference_box(&light->boxes[i], d, blur), d3_of(light->boxes[i].color));
    if (light->lobe_width > 0.0f) sum = d3_mad(sum, reference_lobe(light, d, blur), d3_of(light->lobe_color));
    return d3_mix(sum, reference_irradiance(light, d), fmin(fmax((alpha - 0.2) / 0.6, 0.0), 1.0));
}

/* Direction i of `count` that are spread evenly over the sphere. */
static inline d3 fibonacci_direction(int i, int count)
{
    const double z = 1.0 - (2.0 * i + 1.0) / count, r = sqrt(1.0 - z * z), turn = 2.39996322972865332 * i;
    return (d3){{r * cos(turn), r * sin(turn), z}};
}

/* The integral of L at alpha 0 times the cosine over the hemisphere around n, divided by pi. */
static inline d3 integrate_irradiance(const struct zr_environment_light *light, d3 n, int count)
{
    d3 sum = {{0}};
    for (int i = 0; i < count; i++) {
        const d3 d = fibonacci_direction(i, count);
        const double cosine = d3_dot(d, n);
        if (cosine > 0.0) sum = d3_mad(sum, 4.0 * cosine / count, reference_radiance(light, d, 0.0));
    }
    return sum;
}

/* What the harmonic coefficients should be: L at alpha 0 projected, times what the cosine leaves of each band. */
static inline void project_harmonics(const struct zr_environment_light *light, int count, d3 out[ZR_HARMONICS])
{
    static const double band[ZR_HARMONICS] = {1, 2.0 / 3, 2.0 / 3, 2.0 / 3, 0.25, 0.25, 0.25, 0.25, 0.25};
    static const double square[ZR_HARMONICS] = {/* the mean of f^2 over the sphere */
                                                1,        1.0 / 3,  1.0 / 3, 1.0 / 3, 1.0 / 15,
                                                1.0 / 15, 1.0 / 15, 0.8,     4.0 / 15};
    for (int k = 0; k < ZR_HARMONICS; k++)
        out[k] = (d3){{0}};
    for (int i = 0; i < count; i++) {
        const d3 d = fibonacci_direction(i, count), l = reference_radiance(light, d, 0.0);
        const double x = d.v[0], y = d.v[1], z = d.v[2];
        const double f[ZR_HARMONICS] = {1, x, y, z, x * y, y * z, z * x, 3 * z * z - 1, x * x - y * y};
        for (int k = 0; k < ZR_HARMONICS; k++)
            out[k] = d3_mad(out[k], f[k] * band[k] / (square[k] * count), l);
    }
}

#endif
