/* Colours as floats, with whatever textures there are: in a kernel of its own, so that others keep what compilers make
 * of them. */
#include "shade/channels/floats_simd.h"

void ZR_KERNEL(zr_paint_floats)(const struct zr_geometry *geometry, const struct zr_scene_attributes *surfaces,
                                const struct zr_tile *tile, float *const out[4])
{
    enum { PLAIN = ZR_VARY_COLOR | ZR_VARY_OPACITY };
    enum { LATE = PLAIN | ZR_VARY_NORMAL | ZR_VARY_POINT | ZR_VARY_DEPTH | ZR_VARY_PLACE | ZR_VARY_LATE };
    struct zr_shader s;
    const int all = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT * ZR_BLOCK_COLUMNS;
    const struct zr_varying_rows rows = {{out[0], out[1], out[2], out[3]}, ZR_TILE_STRIDE};
    s.geometry = geometry;
    s.surfaces = surfaces;
    s.draw = &geometry->draws[0];
    s.model = zr_model_context_of(&surfaces->lighting, surfaces->eye, &surfaces->fog);
    for (int begin = 0, end; begin < all; begin = end) {
        end = zr_find_parts(&s, tile, begin, false);
        if (surfaces->any_late || surfaces->textures.of)
            zr_varyings_fill(&s, tile, begin, end, LATE, zr_make_floats, NULL, 4, &rows);
        else
            zr_varyings_fill(&s, tile, begin, end, PLAIN, zr_make_floats, NULL, 4, &rows);
    }
}
