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

/* Returns the share of light that passes the texels around x, y to a depth. Texels that are less than the bias in front
 * of it take a part of the light, so that a bias that just fails leaves no stripes. */
static inline zr_vf zr_shadow_mean_v(const struct zr_shadow_map *map, zr_vi x, zr_vi y, zr_vf depth, zr_vf bias)
{
    enum { RADIUS = ZR_SHADOW_RADIUS };
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f), steep = one / bias;
    zr_vi columns[2 * RADIUS + 1];
    zr_vf lit = zero;
    for (int dx = -RADIUS; dx <= RADIUS; dx++)
        columns[dx + RADIUS] = zr_shadow_clamp(x + zr_vi_set(dx));
    for (int dy = -RADIUS; dy <= RADIUS; dy++) {
        const zr_vi row = zr_shadow_clamp(y + zr_vi_set(dy)) * zr_vi_set(map->stride);
        for (int dx = -RADIUS; dx <= RADIUS; dx++) {
            if (dx * dx + dy * dy > 12) continue;
            const zr_vf texel = zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, map->depths, row + columns[dx + RADIUS]));
            lit = lit + zr_vf_max(zr_vf_min(one + (texel - depth) * steep, one), zero);
        }
    }
    return lit / zr_vf_set((float)ZR_SHADOW_TEXELS);
}

/* Returns how far points are moved along their normals, in biases: 1 to 3. The more surfaces turn away from the light,
 * the farther, since faces may turn more than normals that are interpolated. */
static inline zr_vf zr_shadow_lift_v(zr_vec3 depth_axis, float eye_scale, struct zr_vec3_v normal)
{
    const zr_vf one = zr_vf_set(1.0f), along = zr_shadow_along(depth_axis, normal, 0.0f) * zr_vf_set(eye_scale);
    const zr_vf turned = zr_vf_max(zr_vf_min(one + along, one), zr_vf_set(0.0f));
    const zr_vf square = turned * turned;
    return one + (square + square) * square;
}

/* Returns the share of a directional lamp's light that reaches points of the G-buffer with unit normals: 0 .. 1. Points
 * are moved along their normal, and by the bias towards the lamp. */
static inline zr_vf zr_shadow_share_v(const struct zr_shadow_map *map, struct zr_vec3_v point, struct zr_vec3_v normal)
{
    const zr_vf bias = zr_vf_set(map->bias), lift = zr_shadow_lift_v(map->depth_axis, map->eye_scale, normal);
    const zr_vf along = zr_vf_set(map->bias * map->eye_scale) * lift;
    const struct zr_vec3_v p = {point.x + normal.x * along, point.y + normal.y * along, point.z + normal.z * along};
    const zr_vf depth = zr_shadow_along(map->depth_axis, p, map->depth_offset) - bias;
    const zr_vi x = zr_shadow_texel(zr_shadow_along(map->u_axis, p, map->u_offset));
    const zr_vi y = zr_shadow_texel(zr_shadow_along(map->v_axis, p, map->v_offset));
    return zr_shadow_mean_v(map, x, y, depth, bias);
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
    return zr_shadow_mean_v(map, x, y, depth - bias, bias);
}

#endif
