#include "base/prefetch.h"
#include "base/rgba_simd.h"

void ZR_KERNEL(zr_rgba_pack)(const zr_vec4 *colors, size_t count, uint32_t *out)
{
    zr_vf red, green, blue, alpha;
    size_t i = 0;
#define COLOR(k) (&colors[i + (k)].x)
    for (; i + ZR_LANES <= count; i += ZR_LANES) {
        zr_prefetch(colors + i, ZR_PAGE, ZR_LANES * sizeof *colors);
        ZR_LOAD4(red, green, blue, alpha, COLOR);
        (void)alpha;
        zr_vi_store(out + i, zr_rgba_opaque_v(red, green, blue));
    }
#undef COLOR
    for (; i < count; i++)
        out[i] = zr_rgba_opaque(colors[i]);
}
