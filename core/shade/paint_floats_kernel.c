/* Colours as floats, textured or not. A separate kernel, so that the others' code stays as it is. */
#include "shade/per_pixel_simd.h"

/* Exact: as in color_simd.h before colours become bytes, clamped to 0..1. */
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

enum {
    COLORS = ZR_VARY_COLOR | ZR_VARY_OPACITY,
    PER_PIXEL_COLORS = COLORS | ZR_VARY_NORMAL | ZR_VARY_POINT | ZR_VARY_PER_PIXEL,
    ALL_COLORS = PER_PIXEL_COLORS | ZR_VARY_DEPTH | ZR_VARY_PLACE,
    OPACITY = ZR_VARY_OPACITY,
    TEXTURED_OPACITY = OPACITY | ZR_VARY_PLACE | ZR_VARY_PER_PIXEL
};

ZR_INLINED void fill(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                     const struct zr_tile *tile, unsigned mask, int count, const struct zr_varying_rows *rows)
{
    const int all = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT * ZR_BLOCK_COLUMNS;
    struct zr_shader s;
    s.geometry = geometry;
    s.attributes = attributes;
    s.draw = &geometry->draws[0];
    s.model = zr_model_context_of(&attributes->lighting, attributes->eye, &attributes->fog);
    for (int begin = 0, end; begin < all; begin = end) {
        end = zr_find_parts(&s, tile, begin, false);
        zr_varyings_fill(&s, tile, begin, end, mask, zr_make_floats, NULL, count, rows);
    }
}

void ZR_KERNEL(zr_paint_floats)(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                                const struct zr_tile *tile, float *const out[4])
{
    const struct zr_varying_rows rows = {{out[0], out[1], out[2], out[3]}, ZR_TILE_STRIDE};
    if (attributes->fog.is_on || attributes->textures.of)
        fill(geometry, attributes, tile, ALL_COLORS, 4, &rows);
    else if (attributes->any_per_pixel)
        fill(geometry, attributes, tile, PER_PIXEL_COLORS, 4, &rows);
    else
        fill(geometry, attributes, tile, COLORS, 4, &rows);
}

void ZR_KERNEL(zr_paint_opacity)(const struct zr_geometry *geometry, const struct zr_scene_attributes *attributes,
                                 const struct zr_tile *tile, float *out)
{
    const struct zr_varying_rows rows = {{out}, ZR_TILE_STRIDE};
    if (attributes->textures.of)
        fill(geometry, attributes, tile, TEXTURED_OPACITY, 1, &rows);
    else
        fill(geometry, attributes, tile, OPACITY, 1, &rows);
}
