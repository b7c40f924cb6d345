/* normals_simd.h - shade: the channel normals: three floats per pixel, unit length, of the visible side. */
#ifndef ZR_CHANNEL_NORMALS_SIMD_H
#define ZR_CHANNEL_NORMALS_SIMD_H

#include "shade/varyings_simd.h"

/* Makes normals. context: float[3][3], from eye space to the channel's. */
ZR_INLINED void zr_make_normals(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                                const void *context, zr_vf values[ZR_ROWS_MOST])
{
    const float(*m)[3] = (const float(*)[3])context;
    (void)s;
    for (int k = 0; k < 3; k++)
        values[k] = zr_vf_set(0.0f);
    if (in->count == 0) return;
    const struct zr_vec3_v n = zr_normalize_v(zr_varying3(in, zr_first_plane(mask, ZR_VARY_NORMAL), zr_varying_w(in)));
    const struct zr_vec3_v out =
        zr_normalize_v((struct zr_vec3_v){zr_dot_v(zr_spread_v((zr_vec3){m[0][0], m[0][1], m[0][2]}), n),
                                          zr_dot_v(zr_spread_v((zr_vec3){m[1][0], m[1][1], m[1][2]}), n),
                                          zr_dot_v(zr_spread_v((zr_vec3){m[2][0], m[2][1], m[2][2]}), n)});
    values[0] = zr_vf_select(in->seen, out.x, values[0]);
    values[1] = zr_vf_select(in->seen, out.y, values[1]);
    values[2] = zr_vf_select(in->seen, out.z, values[2]);
}

static inline __attribute__((flatten)) void zr_shade_normals(struct zr_shader *s, const struct zr_tile *tile, int begin,
                                                             int end, const struct zr_tile_targets *to)
{
    float normals[3][ZR_TILE_STRIDE * ZR_TILE_SIZE];
    const struct zr_pixel_rows *out = &to->channels[ZR_CHANNEL_NORMALS];
    const struct zr_varying_rows rows = {{normals[0], normals[1], normals[2]}, ZR_TILE_STRIDE};
    const int32_t first = zr_block_low(begin), last = zr_block_low(end);
    zr_varyings_fill(s, tile, begin, end, ZR_VARY_NORMAL, zr_make_normals, to->normals_to_space, 3, &rows);
    for (int32_t y = first; y < last && y < tile->height; y++) {
        float *to_row = (float *)out->first + y * out->stride;
        for (int32_t x = 0; x < tile->width; x++)
            for (int k = 0; k < 3; k++)
                to_row[3 * x + k] = normals[k][y * ZR_TILE_STRIDE + x];
    }
}

#endif
