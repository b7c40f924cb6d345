#define ZR_WITH_TEXTURES true

#include "shade/channels/color_simd.h"
#include "shade/channels/textures_simd.h"

void ZR_KERNEL(zr_paint_textured)(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                  const struct zr_tile_targets *to)
{
    zr_shade_colors_by(s, tile, begin, end, to, 1 + ZR_VALUES_MOST);
}

void ZR_KERNEL(zr_sample_textures)(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                   const struct zr_gbuffer *to)
{
    zr_texture_blocks(s, tile, begin, end, to);
}
