#include "raster/triangle_simd.h"
#include "shade/paint.h"
#include "shade/planes_simd.h"

static inline void load_corner(const float *from, struct zr_corner_v *out)
{
    out->x = zr_vf_load(from);
    out->y = zr_vf_load(from + ZR_LANES);
    out->oow = zr_vf_load(from + 2 * ZR_LANES);
    out->z = zr_vf_set(0.0f); /* unused by smooth colours */
}

static inline zr_vi color_at(const struct zr_plane_v *oow, const struct zr_planes3_v *p, zr_vf x, zr_vf y)
{
    return zr_color_over_w(zr_plane_at_v(oow, x, y), zr_plane_at_v(&p->x, x, y), zr_plane_at_v(&p->y, x, y),
                           zr_plane_at_v(&p->z, x, y));
}

void ZR_KERNEL(zr_early)(const struct zr_prepaint *prepaint, const uint32_t *numbers, uint32_t turned,
                         const float *corners, const uint32_t *triangles, const float *x, const float *y,
                         uint32_t count, uint32_t *words)
{
    const struct zr_draw *draw = prepaint->draw;
    const struct zr_draw_attributes *of_draw = prepaint->context;
    const struct zr_attribute color = of_draw->attributes[ZR_ATTRIBUTE_COLOR];
    struct zr_corner_v v[3];
    struct zr_vec3_v c[3];
    zr_vf opacity[3];
    for (int k = 0; k < 3; k++)
        load_corner(corners + 3 * ZR_LANES * k, &v[k]);
#define COLOR(i, k) (&color.values[zr_smooth_number(draw, color.rate, numbers[i] - draw->first, k)].x)
#define COLOR_0(i)  COLOR(i, 0)
#define COLOR_1(i)  COLOR(i, 1)
#define COLOR_2(i)  COLOR(i, 2)
    ZR_LOAD_FOURS(c, opacity, COLOR_0, COLOR_1, COLOR_2);
#undef COLOR_0
#undef COLOR_1
#undef COLOR_2
#undef COLOR
    (void)opacity;
    const struct zr_triangle_setup_v setup = zr_triangle_setup_make(zr_vm_of(turned), v);
    const struct zr_planes3_v planes = zr_planes3_make(&setup, c);
    if (!triangles) {
        zr_vi_store(words, color_at(&setup.oow_plane, &planes, zr_vf_load(x), zr_vf_load(y)));
        return;
    }
    for (uint32_t i = 0; i < count; i += ZR_LANES) {
        const zr_vi lane = zr_vi_load(triangles + i);
        const struct zr_plane_v oow = zr_plane_pick(&setup.oow_plane, lane);
        const struct zr_planes3_v own = {zr_plane_pick(&planes.x, lane), zr_plane_pick(&planes.y, lane),
                                         zr_plane_pick(&planes.z, lane)};
        zr_vi_store(words + i, color_at(&oow, &own, zr_vf_load(x + i), zr_vf_load(y + i)));
    }
}
