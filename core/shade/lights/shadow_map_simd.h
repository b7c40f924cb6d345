/* shadow_map_simd.h - shade: share of a lamp's light that reaches points, from its depth map, for kernels. */
#ifndef ZR_SHADOW_MAP_SIMD_H
#define ZR_SHADOW_MAP_SIMD_H

#include "base/vec3_simd.h"
#include "shade/lights/shadow_map.h"

/* Texels sampled around a point: dx^2 + dy^2 <= 12. */
enum { ZR_SHADOW_RADIUS = 3, ZR_SHADOW_TEXELS = 37 };
_Static_assert((int)ZR_SHADOW_RADIUS < (int)ZR_SHADOW_BORDER, "samples around a texel beyond the border are border");

/* Returns axis . p + offset. */
static inline zr_vf zr_shadow_along(zr_vec3 axis, struct zr_vec3_v p, float offset)
{
    const struct zr_vec3_v a = {zr_vf_set(axis.x), zr_vf_set(axis.y), zr_vf_set(axis.z)};
    return zr_dot_v(a, p) + zr_vf_set(offset);
}

/* Returns the texel of a map coordinate, counted from the border's outer end. Far away or NaN: one just beyond the map
 * and its border. */
static inline zr_vi zr_shadow_texel(zr_vf place)
{
    const zr_vf least = zr_vf_set(-1.0f), most = zr_vf_set((float)(ZR_SHADOW_SIDE + 2 * ZR_SHADOW_BORDER));
    const zr_vf counted = place + zr_vf_set((float)ZR_SHADOW_BORDER);
    const zr_vf near = zr_vf_max(zr_vf_min(counted, most), least);
    const zr_vi nearest = zr_vi_round(near);
    return zr_vi_select(zr_vf_lt(near, zr_vf_of(nearest)), nearest - zr_vi_set(1), nearest);
}

static inline zr_vi zr_shadow_clamp(zr_vi texel)
{
    const zr_vi last = zr_vi_set(ZR_SHADOW_SIDE + 2 * ZR_SHADOW_BORDER - 1);
    return zr_vi_max(zr_vi_min(texel, last), zr_vi_set(0));
}

/* Returns the share of texels around x, y that are not in front of a depth. */
static inline zr_vf zr_shadow_mean_v(const struct zr_shadow_map *map, zr_vi x, zr_vi y, zr_vf depth)
{
    enum { RADIUS = ZR_SHADOW_RADIUS };
    zr_vi columns[2 * RADIUS + 1], lit = zr_vi_set(0);
    for (int dx = -RADIUS; dx <= RADIUS; dx++)
        columns[dx + RADIUS] = zr_shadow_clamp(x + zr_vi_set(dx));
    for (int dy = -RADIUS; dy <= RADIUS; dy++) {
        const zr_vi row = zr_shadow_clamp(y + zr_vi_set(dy)) * zr_vi_set(map->stride);
        for (int dx = -RADIUS; dx <= RADIUS; dx++) {
            if (dx * dx + dy * dy > 12) continue;
            const zr_vf texel = zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, map->depths, row + columns[dx + RADIUS]));
            lit = lit + zr_vi_select(zr_vf_le(depth, texel), zr_vi_set(1), zr_vi_set(0));
        }
    }
    return zr_vf_of(lit) / zr_vf_set((float)ZR_SHADOW_TEXELS);
}

/* Returns the share of a directional lamp's light that reaches points of the G-buffer with unit normals: 0 .. 1, in
 * steps of 1 / 37. Points are moved by the bias along their normal, and as far towards the lamp. */
static inline zr_vf zr_shadow_share_v(const struct zr_shadow_map *map, struct zr_vec3_v point, struct zr_vec3_v normal)
{
    const zr_vf bias = zr_vf_set(map->bias), along = zr_vf_set(map->bias * map->eye_scale);
    const struct zr_vec3_v p = {point.x + normal.x * along, point.y + normal.y * along, point.z + normal.z * along};
    const zr_vf depth = zr_shadow_along(map->depth_axis, p, map->depth_offset) - bias;
    const zr_vi x = zr_shadow_texel(zr_shadow_along(map->u_axis, p, map->u_offset));
    const zr_vi y = zr_shadow_texel(zr_shadow_along(map->v_axis, p, map->v_offset));
    return zr_shadow_mean_v(map, x, y, depth);
}

/* Returns the share of a spot's light. The bias grows with the distance, as texels do. Behind the lamp, the result is
 * arbitrary. */
static inline zr_vf zr_shadow_cone_share_v(const struct zr_shadow_map *map, struct zr_vec3_v point,
                                           struct zr_vec3_v normal)
{
    const zr_vf own = zr_vf_max(zr_shadow_along(map->depth_axis, point, map->depth_offset), zr_vf_set(0.0f));
    const zr_vf bias = own * zr_vf_set(map->bias), along = bias * zr_vf_set(map->eye_scale);
    const struct zr_vec3_v p = {point.x + normal.x * along, point.y + normal.y * along, point.z + normal.z * along};
    const zr_vf depth = zr_shadow_along(map->depth_axis, p, map->depth_offset);
    const zr_vi x = zr_shadow_texel(zr_shadow_along(map->u_axis, p, map->u_offset) / depth);
    const zr_vi y = zr_shadow_texel(zr_shadow_along(map->v_axis, p, map->v_offset) / depth);
    return zr_shadow_mean_v(map, x, y, depth - bias);
}

#endif
