/* tone_simd.h - shade: tone mapping: compresses colours to 0..1, for kernels.
 *
 * Source: Khronos PBR neutral tone mapper, with its constant F90 as the parameter `toe`: the amount of colourless
 *         reflection that is subtracted. Khronos uses 0.04.
 */
#ifndef ZR_TONE_SIMD_H
#define ZR_TONE_SIMD_H

#include "base/mutant.h"
#include "base/vec3_simd.h"
#include "scene/effects.h"

static inline zr_vf zr_clamp01_v(zr_vf v)
{
    return zr_vf_min(zr_vf_max(v, zr_vf_set(0.0f)), zr_vf_set(1.0f));
}

static inline zr_vf zr_mix_v(zr_vf a, zr_vf b, zr_vf share)
{
    return a + (b - a) * share;
}

static inline struct zr_vec3_v zr_mix3_v(struct zr_vec3_v a, struct zr_vec3_v b, zr_vf share)
{
    return (struct zr_vec3_v){zr_mix_v(a.x, b.x, share), zr_mix_v(a.y, b.y, share), zr_mix_v(a.z, b.z, share)};
}

static inline struct zr_vec3_v zr_tone_neutral_v(struct zr_vec3_v c, float toe)
{
    const zr_vf one = zr_vf_set(1.0f), start = zr_vf_set(0.8f - toe), d = zr_vf_set(1.0f - (0.8f - toe));
    const zr_vf least = zr_vf_min(zr_vf_min(c.x, c.y), c.z);
    const zr_vf offset = zr_vf_select(zr_vf_lt(least, zr_vf_set(2.0f * toe)),
                                      least - least * least * zr_vf_set(1.0f / (4.0f * toe)), zr_vf_set(toe));
    c = (struct zr_vec3_v){c.x - offset, c.y - offset, c.z - offset};
    const zr_vf peak = zr_vf_max(zr_vf_max(c.x, c.y), c.z);
    const zr_vm bright = zr_vf_le(start, peak);
    if (!zr_vm_any(bright)) return c;
    const zr_vf new_peak = one - d * d / (peak + d - start), scale = new_peak / peak;
    const zr_vf white =
        ZR_MUTANT(tone_keeps_hue, one - one / (zr_vf_set(0.15f) * (peak - new_peak) + one), zr_vf_set(0.0f));
    return zr_choose_v(bright,
                       (struct zr_vec3_v){zr_mix_v(c.x * scale, new_peak, white),
                                          zr_mix_v(c.y * scale, new_peak, white),
                                          zr_mix_v(c.z * scale, new_peak, white)},
                       c);
}

/* Maps a colour to 0..1. */
static inline struct zr_vec3_v zr_tone_v(struct zr_vec3_v c, enum zr_tone tone)
{
    if (tone == ZR_TONE_KHRONOS) c = zr_tone_neutral_v(c, 0.04f);
    if (tone == ZR_TONE_NEUTRAL) c = zr_tone_neutral_v(c, 0.02f);
    return (struct zr_vec3_v){zr_clamp01_v(c.x), zr_clamp01_v(c.y), zr_clamp01_v(c.z)};
}

#endif
