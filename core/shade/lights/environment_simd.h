/* environment_simd.h - shade: light of an environment (environment.h), ZR_LANES directions at a time, for kernels. */
#ifndef ZR_ENVIRONMENT_SIMD_H
#define ZR_ENVIRONMENT_SIMD_H

#include "shade/lights/environment.h"
#include "shade/lights/environment_map_simd.h"
#include "shade/lights/tone_simd.h"

/* Returns x / sqrt(x^2 + w^2): -1 .. 1. */
static inline zr_vf zr_blurred_sign_v(zr_vf x, zr_vf square_w)
{
    return x / zr_vf_sqrt(x * x + square_w);
}

static inline struct zr_vec3_v zr_add_scaled_v(struct zr_vec3_v sum, zr_vec3 color, zr_vf share)
{
    return (struct zr_vec3_v){sum.x + zr_vf_set(color.x) * share, sum.y + zr_vf_set(color.y) * share,
                              sum.z + zr_vf_set(color.z) * share};
}

/* The fraction p / sqrt(p^2 + w^2) - q / sqrt(q^2 + w^2). */
struct zr_fraction_v {
    zr_vf above, below;
};

static inline struct zr_fraction_v zr_between_v(zr_vf x, float half, zr_vf square_w)
{
    const zr_vf p = x + zr_vf_set(half), q = x - zr_vf_set(half);
    const zr_vf p_root = zr_vf_sqrt(p * p + square_w), q_root = zr_vf_sqrt(q * q + square_w);
    return (struct zr_fraction_v){p * q_root - q * p_root, p_root * q_root};
}

/* Returns a box's share of its colour. The three factors need one division. */
static inline zr_vf zr_box_share_v(const struct zr_environment_box *box, struct zr_vec3_v d, zr_vf square_blur)
{
    const zr_vf square_w = square_blur + zr_vf_set(box->w0 * box->w0);
    const struct zr_fraction_v u = zr_between_v(zr_dot_v(d, zr_spread_v(box->across)), box->a, square_w);
    const struct zr_fraction_v v = zr_between_v(zr_dot_v(d, zr_spread_v(box->along)), box->h, square_w);
    const zr_vf m = zr_dot_v(d, zr_spread_v(box->middle)), m_root = zr_vf_sqrt(m * m + square_w);
    return (zr_vf_set(0.125f) * u.above) * v.above * (m_root + m) / (u.below * v.below * m_root);
}

/* Returns w0^2 / w^2 / (1 + 2 (1 - d.m) / w^2)^2, with one division. */
static inline zr_vf zr_lobe_share_v(const struct zr_environment_lobe *lobe, struct zr_vec3_v d, zr_vf square_blur)
{
    const zr_vf square_0 = zr_vf_set(lobe->w0 * lobe->w0), square_w = square_blur + square_0;
    const zr_vf away = zr_vf_set(2.0f) * (zr_vf_set(1.0f) - zr_dot_v(d, zr_spread_v(lobe->middle)));
    const zr_vf sum = square_w + away;
    return square_0 * square_w / (sum * sum);
}

/* Returns E: irradiance / pi. */
static inline struct zr_vec3_v zr_environment_diffuse_v(const struct zr_environment_light *light, struct zr_vec3_v n)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f), three = zr_vf_set(3.0f);
    const zr_vf f[ZR_HARMONICS] = {
        one, n.x, n.y, n.z, n.x * n.y, n.y * n.z, n.z * n.x, three * n.z * n.z - one, n.x * n.x - n.y * n.y};
    struct zr_vec3_v sum = {zero, zero, zero};
    for (int i = 0; i < ZR_HARMONICS; i++)
        sum = zr_add_scaled_v(sum, light->harmonics[i], f[i]);
    return (struct zr_vec3_v){zr_vf_max(sum.x, zero), zr_vf_max(sum.y, zero), zr_vf_max(sum.z, zero)};
}

/* Parameters of gathering, by roughness. */
struct zr_gathering_v {
    zr_vf square_blur, share; /* share: that of E, 0 .. 1 */
    bool is_sharp, is_soft;   /* share is 0, or 1, in all lanes */
    zr_vf alpha;
};

static inline struct zr_gathering_v zr_gathering_of(float alpha)
{
    const float blur = 2.0f * alpha / (1.0f + 2.2f * alpha), diffuse = (alpha - 0.2f) / 0.6f;
    return (struct zr_gathering_v){zr_vf_set(ZR_MUTANT(environment_not_blurred, blur * blur, 0.0f)), zr_vf_set(diffuse),
                                   diffuse <= 0.0f, diffuse >= 1.0f, zr_vf_set(alpha)};
}

/* Returns the parameters at each lane's alpha. */
static inline struct zr_gathering_v zr_gathering_of_each(zr_vf alpha)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    const zr_vf blur = zr_vf_set(2.0f) * alpha / (one + zr_vf_set(2.2f) * alpha);
    const zr_vf share = (alpha - zr_vf_set(0.2f)) / zr_vf_set(0.6f);
    return (struct zr_gathering_v){ZR_MUTANT(environment_not_blurred, blur * blur, zero),
                                   zr_vf_min(zr_vf_max(share, zero), one), false, false, alpha};
}

/* Returns L: the radiance gathered around d. */
static inline struct zr_vec3_v zr_environment_gathered_v(const struct zr_environment_light *light, struct zr_vec3_v d,
                                                         const struct zr_gathering_v *gathering)
{
    if (light->map) return zr_map_gathered_v(light->map, d, gathering->alpha);
    const zr_vf square_blur = gathering->square_blur, half = zr_vf_set(0.5f);
    const zr_vf up =
        half + half * zr_blurred_sign_v(d.y, zr_vf_set(light->half_width * light->half_width) + square_blur);
    const struct zr_vec3_v sky = zr_spread_v(light->sky), ground = zr_spread_v(light->ground);
    struct zr_vec3_v sharp = {zr_mix_v(ground.x, sky.x, up), zr_mix_v(ground.y, sky.y, up),
                              zr_mix_v(ground.z, sky.z, up)};
    if (gathering->is_soft) return zr_environment_diffuse_v(light, d);
    for (uint32_t i = 0; i < light->box_count; i++)
        sharp = zr_add_scaled_v(sharp, light->boxes[i].color, zr_box_share_v(&light->boxes[i], d, square_blur));
    for (uint32_t i = 0; i < light->lobe_count; i++)
        sharp = zr_add_scaled_v(sharp, light->lobes[i].color, zr_lobe_share_v(&light->lobes[i], d, square_blur));
    if (gathering->is_sharp) return sharp;
    const struct zr_vec3_v soft = zr_environment_diffuse_v(light, d);
    const zr_vf share = gathering->share;
    return (struct zr_vec3_v){zr_mix_v(sharp.x, soft.x, share), zr_mix_v(sharp.y, soft.y, share),
                              zr_mix_v(sharp.z, soft.z, share)};
}

#endif
