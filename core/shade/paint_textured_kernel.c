#include "shade/channels/color_simd.h"
#include "shade/channels/textures_simd.h"

void ZR_KERNEL(zr_paint_textured)(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                  const struct zr_tile_targets *to)
{
    zr_shade_colors_by(s, tile, begin, end, to, ZR_COLOR_TEXTURED_VARYINGS);
}

void ZR_KERNEL(zr_sample_textures)(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                   const struct zr_gbuffer *to)
{
    const struct zr_varying_rows rows = zr_texture_rows_of(to);
    zr_varyings_fill(s, tile, begin, end, ZR_VARY_TEXCOORDS | ZR_VARY_TANGENT | ZR_VARY_PER_PIXEL, zr_make_textures, to,
                     ZR_TEXTURE_VALUES, &rows);
}
