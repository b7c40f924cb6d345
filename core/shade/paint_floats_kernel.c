/* Colours as floats, with whatever textures there are: in a kernel of its own, so that others keep what compilers make
 * of them. */
#define ZR_WITH_TEXTURES true

#include "shade/channels/floats_simd.h"

void ZR_KERNEL(zr_paint_floats)(const struct zr_geometry *geometry, const struct zr_scene_attributes *surfaces,
                                const struct zr_tile *tile, float *const out[4])
{
    struct zr_shader s;
    const int all = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT * ZR_BLOCK_COLUMNS;
    s.geometry = geometry;
    s.surfaces = surfaces;
    s.draw = &geometry->draws[0];
    s.model = zr_model_context_of(&surfaces->lighting, surfaces->eye, &surfaces->fog);
    for (int begin = 0, end; begin < all; begin = end) {
        end = zr_find_parts(&s, tile, begin, false);
        zr_float_blocks(&s, tile, begin, end, out);
    }
}
