/* Colours as floats, textured or not. A separate kernel, so that the others' code stays as it is. */
#include "shade/channels/floats_simd.h"

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
