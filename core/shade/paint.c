#include "shade/paint.h"

#include "raster/line.h"

const struct zr_paint *zr_paint_of(enum zr_isa isa)
{
    static const struct zr_paint *const table[ZR_ISA_COUNT] = ZR_KERNELS(&zr_paint);
    return table[isa];
}

uint32_t zr_color_byte(float value)
{
    const float no_fraction = 12582912.0f; /* 1.5 * 2^23: to an integer, ties to even */
    value = value > 0.0f ? value : 0.0f;
    value = value < 1.0f ? value : 1.0f;
    return (uint32_t)(int32_t)((value * 255.0f + no_fraction) - no_fraction);
}

uint32_t zr_color_pack(uint32_t red, uint32_t green, uint32_t blue, uint32_t alpha)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return red | green << 8 | blue << 16 | alpha << 24;
#else
    return red << 24 | green << 16 | blue << 8 | alpha;
#endif
}

void zr_paint_line(const struct zr_geometry *geometry, const struct zr_triangle *line, int32_t x, int32_t y,
                   uint32_t *pixels, uint32_t count)
{
    const zr_vec4 *colors = line->back ? geometry->back_colors : geometry->front_colors;
    const struct zr_window_vertex *v0 = &geometry->vertices[line->v[0]], *v1 = &geometry->vertices[line->v[1]];
    zr_vec4 c0 = colors[line->c[0]], c1 = colors[line->c[1]];
    const struct zr_line_basis basis = zr_line_basis_make(v0, v1);
    const struct zr_plane oow = zr_line_plane_make(&basis, v0->oow, v1->oow);
    const struct zr_plane red = zr_line_plane_make(&basis, c0.x * v0->oow, c1.x * v1->oow);
    const struct zr_plane green = zr_line_plane_make(&basis, c0.y * v0->oow, c1.y * v1->oow);
    const struct zr_plane blue = zr_line_plane_make(&basis, c0.z * v0->oow, c1.z * v1->oow);
    for (uint32_t i = 0; i < count; i++) {
        float fx = (float)(x + (int32_t)i), fy = (float)y;
        float reciprocal = 1.0f / zr_plane_at(&oow, fx, fy);
        pixels[i] = zr_color_pack(zr_color_byte(zr_plane_at(&red, fx, fy) * reciprocal),
                                  zr_color_byte(zr_plane_at(&green, fx, fy) * reciprocal),
                                  zr_color_byte(zr_plane_at(&blue, fx, fy) * reciprocal), 255);
    }
}
