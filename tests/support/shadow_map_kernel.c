#include "support/shadow_map_kernel.h"

#include "shade/lights/shadow_map_simd.h"

void ZR_KERNEL(shadow_shares)(const struct zr_shadow_map *map, const float *const point[3],
                              const float *const normal[3], size_t count, float *out)
{
    for (size_t i = 0; i < count; i += ZR_LANES) {
        const struct zr_vec3_v p = {zr_vf_load(point[0] + i), zr_vf_load(point[1] + i), zr_vf_load(point[2] + i)};
        const struct zr_vec3_v n = {zr_vf_load(normal[0] + i), zr_vf_load(normal[1] + i), zr_vf_load(normal[2] + i)};
        zr_vf_store(out + i, zr_shadow_share_v(map, p, n));
    }
}
