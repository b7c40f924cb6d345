/* gbuffer_simd.h - shade: writes the samples of a tile to a G-buffer (gbuffer.h). For the shading kernel. */
#ifndef ZR_GBUFFER_SIMD_H
#define ZR_GBUFFER_SIMD_H

#include "shade/gbuffer.h"
#include "shade/varyings_simd.h"

enum { ZR_SAMPLE_VARYINGS = ZR_VARY_NORMAL | ZR_VARY_POINT | ZR_VARY_OVER_W };

/* Returns the number of values. They are in the order of the planes behind 1/w. */
static inline int zr_sample_values(unsigned mask)
{
    return zr_plane_count(mask) - 1;
}

ZR_INLINED void zr_make_samples(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                                const void *context, zr_vf values[ZR_ROWS_MOST])
{
    const int normal = zr_first_plane(mask, ZR_VARY_NORMAL) - 1, point = zr_first_plane(mask, ZR_VARY_POINT) - 1;
    (void)s;
    (void)context;
    for (int k = 0; k < zr_sample_values(mask); k++)
        values[k] = zr_vf_set(k < point ? 0.0f : ZR_FAR_POINT);
    if (in->count == 0) return;
    const zr_vf w = zr_varying_w(in);
    const struct zr_vec3_v n = zr_normalize_v(zr_varying3(in, 1 + normal, w));
    const zr_vf unit[3] = {n.x, n.y, n.z};
    for (int k = 0; k < zr_sample_values(mask); k++) {
        const bool is_normal = k >= normal && k < point;
        values[k] = zr_vf_select(in->seen, is_normal ? unit[k - normal] : zr_varying(in, 1 + k, w), values[k]);
    }
}

/* Returns the rows of a G-buffer, with those of base colours if it has any. */
static inline struct zr_varying_rows zr_sample_rows_of(const struct zr_gbuffer *to)
{
    struct zr_varying_rows out = {.stride = to->stride};
    int count = 0;
    for (int k = 0; k < 3 && to->base[0]; k++)
        out.of[count++] = to->base[k];
    for (int k = 0; k < 3; k++)
        out.of[count++] = to->normal[k];
    for (int k = 0; k < 3; k++)
        out.of[count++] = to->point[k];
    return out;
}

static inline __attribute__((flatten)) void zr_sample_blocks(struct zr_shader *s, const struct zr_tile *tile, int begin,
                                                             int end, const struct zr_gbuffer *to)
{
    const struct zr_varying_rows rows = zr_sample_rows_of(to);
    enum { PLAIN = ZR_SAMPLE_VARYINGS, COLORED = PLAIN | ZR_VARY_COLOR };
    if (to->base[0])
        zr_varyings_fill(s, tile, begin, end, COLORED, zr_make_samples, NULL, zr_sample_values(COLORED), &rows);
    else
        zr_varyings_fill(s, tile, begin, end, PLAIN, zr_make_samples, NULL, zr_sample_values(PLAIN), &rows);
}

static inline zr_vi zr_material_words(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw,
                                      zr_vi numbers)
{
    (void)geometry;
    (void)numbers;
    return zr_vi_set((int32_t)of_draw->material);
}

#endif
