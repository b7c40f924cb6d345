/* floats_simd.h - shade: colours and opacity of a tile's samples, as floats. For the shading kernel.
 *
 * Exact:  as in color_simd.h before colours become bytes, clamped to 0..1.
 */
#ifndef ZR_FLOATS_SIMD_H
#define ZR_FLOATS_SIMD_H

#include "shade/per_pixel_simd.h"

static inline zr_vf zr_within_1(zr_vf v)
{
    return zr_vf_min(zr_vf_max(v, zr_vf_set(0.0f)), zr_vf_set(1.0f));
}

/* Makes red, green and blue, if the set has ZR_VARY_COLOR, then opacity; 0 for uncovered samples. */
ZR_INLINED void zr_make_floats(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                               const void *context, zr_vf values[ZR_ROWS_MOST])
{
    const int last = mask & ZR_VARY_COLOR ? 3 : 0;
    (void)context;
    for (int k = 0; k <= last; k++)
        values[k] = zr_vf_set(0.0f);
    if (in->count == 0) return;
    const zr_vf w = zr_color_w(s, in, mask, zr_varying_w(in));
    zr_vf opacity = zr_varying(in, zr_first_plane(mask, ZR_VARY_OPACITY), w);
    struct zr_vec3_v color = zr_spread_v((zr_vec3){0.0f, 0.0f, 0.0f});
    if (mask & ZR_VARY_COLOR) color = zr_varying3(in, zr_first_plane(mask, ZR_VARY_COLOR), w);
    if (mask & ZR_VARY_PER_PIXEL) zr_shade_per_pixel(s, in, mask, &color, &opacity);
    values[last] = zr_within_1(opacity);
    if (last == 0) return;
    values[0] = zr_within_1(color.x);
    values[1] = zr_within_1(color.y);
    values[2] = zr_within_1(color.z);
}

#endif
