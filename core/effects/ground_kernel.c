/* View rays are intersected with the plane in ground space, in which the plane is z = 0. Along a row, the coordinates
 * of a ray's origin and direction are linear in X. */
#include "effects/ground.h"

#include "base/simd/simd.h"
#include "shade/lights/shadow_map_simd.h"

/* A coordinate along a row of pixels: at + X * step. */
struct linear {
    float at, step;
};

/* Rays of one row, in ground space. */
struct row {
    struct linear origin[3], direction[3];
};

static inline struct linear along(zr_vec3 axis, zr_vec3 v, zr_vec3 v_x, zr_vec3 v_y, float y)
{
    return (struct linear){zr_vec3_dot(axis, v) + zr_vec3_dot(axis, v_y) * y, zr_vec3_dot(axis, v_x)};
}

static inline struct row make_row(const struct zr_ground_frame *frame, const struct zr_rays *rays, float y)
{
    const zr_vec3 axes[3] = {frame->x_axis, frame->y_axis, frame->z_axis};
    const zr_vec3 origin = zr_vec3_sub(rays->origin, frame->origin);
    struct row row;
    for (int k = 0; k < 3; k++) {
        row.origin[k] = along(axes[k], origin, rays->origin_x, rays->origin_y, y);
        row.direction[k] = along(axes[k], rays->direction, rays->direction_x, rays->direction_y, y);
    }
    return row;
}

static inline zr_vf at(const struct linear *linear, zr_vf x)
{
    return zr_vf_set(linear->at) + x * zr_vf_set(linear->step);
}

/* Equals texel_place of ground.c. The order of operands matters: NaN becomes SIDE. */
static inline zr_vf texel_place(zr_vf place, float half_size)
{
    const zr_vf side = zr_vf_set((float)ZR_GROUND_SIDE), one = zr_vf_set(1.0f);
    const zr_vf u = (place / zr_vf_set(half_size) + one) * (zr_vf_set(0.5f) * side) - zr_vf_set(0.5f);
    return zr_vf_max(zr_vf_min(u, side), zr_vf_set(-1.0f));
}

static inline zr_vi floor_of(zr_vf v)
{
    const zr_vi nearest = zr_vi_round(v);
    return zr_vi_select(zr_vf_lt(v, zr_vf_of(nearest)), nearest - zr_vi_set(1), nearest);
}

static inline zr_vm is_texel(zr_vi i)
{
    return zr_vm_and(zr_vi_lt(zr_vi_set(-1), i), zr_vi_lt(i, zr_vi_set(ZR_GROUND_SIDE)));
}

static inline zr_vf texel(const struct zr_ground *ground, zr_vm inside, zr_vi x, zr_vi y)
{
    const zr_vi i = zr_vi_select(inside, y * zr_vi_set(ZR_GROUND_SIDE) + x, zr_vi_set(0));
    return zr_vf_select(inside, zr_vf_bits(zr_vi_gather(inside, ground->light, i)), zr_vf_set(1.0f));
}

/* Equals zr_ground_at, with u and v in texels; 1 for lanes not in `met`. */
static inline zr_vf light_at(const struct zr_ground *ground, zr_vm met, zr_vf u, zr_vf v)
{
    const zr_vi i = floor_of(u), j = floor_of(v), one = zr_vi_set(1);
    const zr_vm left = zr_vm_and(met, is_texel(i)), right = zr_vm_and(met, is_texel(i + one));
    const zr_vm low_row = is_texel(j), high_row = is_texel(j + one);
    if (!zr_vm_any(zr_vm_and(zr_vm_or(left, right), zr_vm_or(low_row, high_row)))) return zr_vf_set(1.0f);
    const zr_vf a = u - zr_vf_of(i), b = v - zr_vf_of(j);
    const zr_vf t00 = texel(ground, zr_vm_and(left, low_row), i, j);
    const zr_vf t10 = texel(ground, zr_vm_and(right, low_row), i + one, j);
    const zr_vf t01 = texel(ground, zr_vm_and(left, high_row), i, j + one);
    const zr_vf t11 = texel(ground, zr_vm_and(right, high_row), i + one, j + one);
    const zr_vf low = t00 + (t10 - t00) * a, high = t01 + (t11 - t01) * a;
    return low + (high - low) * b;
}

/* Returns how far along the rays the plane is. */
static inline zr_vf distance_of(const struct row *row, zr_vf x)
{
    return zr_vf_set(0.0f) - at(&row->origin[2], x) / at(&row->direction[2], x);
}

/* Returns T where the rays meet the plane. A ray parallel to the plane gives an infinite quotient or NaN; its position
 * is clamped like any other far away. */
static inline zr_vf light_of_rays(const struct zr_ground *ground, const struct row *row, zr_vf x)
{
    const zr_vf distance = distance_of(row, x);
    const zr_vm met = zr_vf_lt(zr_vf_set(0.0f), distance);
    if (!zr_vm_any(met)) return zr_vf_set(1.0f);
    const zr_vf u = at(&row->origin[0], x) + distance * at(&row->direction[0], x);
    const zr_vf v = at(&row->origin[1], x) + distance * at(&row->direction[1], x);
    return light_at(ground, met, texel_place(u, ground->half_size), texel_place(v, ground->half_size));
}

void ZR_KERNEL(zr_ground_row)(const struct zr_ground *ground, const struct zr_ground_frame *frame,
                              const struct zr_rays *rays, int32_t y, int32_t width, float *out)
{
    const struct row row = make_row(frame, rays, (float)y + 0.5f);
    const zr_vf centres = zr_vf_ramp() + zr_vf_set(0.5f);
    for (int32_t x = 0; x < width; x += ZR_LANES) {
        const zr_vf light = light_of_rays(ground, &row, zr_vf_set((float)x) + centres);
        if (width - x >= ZR_LANES)
            zr_vf_store(out + x, light);
        else
            zr_vi_store_first(out + x, zr_vi_bits_of(light), (uint32_t)(width - x));
    }
}

/* ---- the shadow of a lamp ---- */

/* Rays of one row in eye space, from the start of points of the G-buffer. */
static inline struct row make_eye_row(const struct zr_ground_sun *sun, const struct zr_rays *rays, float y)
{
    const struct zr_ground_frame eye = {sun->start, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return make_row(&eye, rays, y);
}

/* Texels around the map in which shares are computed, more than the sampled ones. */
#define SUN_MARGIN 8.0f

static inline zr_vm is_in_map(const struct zr_shadow_map *map, struct zr_vec3_v p)
{
    const zr_vf least = zr_vf_set(-SUN_MARGIN), most = zr_vf_set((float)ZR_SHADOW_SIDE + SUN_MARGIN);
    const zr_vf u = zr_shadow_along(map->u_axis, p, map->u_offset), v = zr_shadow_along(map->v_axis, p, map->v_offset);
    return zr_vm_and(zr_vm_and(zr_vf_lt(least, u), zr_vf_lt(u, most)),
                     zr_vm_and(zr_vf_lt(least, v), zr_vf_lt(v, most)));
}

void ZR_KERNEL(zr_ground_sun_row)(const struct zr_ground_sun *sun, const struct zr_ground_frame *frame,
                                  const struct zr_rays *rays, int32_t y, int32_t width, float *out)
{
    const struct row row = make_row(frame, rays, (float)y + 0.5f), eye = make_eye_row(sun, rays, (float)y + 0.5f);
    const struct zr_vec3_v up = zr_spread_v(zr_vec3_normalize(frame->z_axis));
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f), half = zr_vf_set(0.5f);
    for (int32_t first = 0; first < width; first += ZR_LANES) {
        const zr_vf x = zr_vf_set((float)first) + zr_vf_ramp() + half, distance = distance_of(&row, x);
        const struct zr_vec3_v p = {at(&eye.origin[0], x) + distance * at(&eye.direction[0], x),
                                    at(&eye.origin[1], x) + distance * at(&eye.direction[1], x),
                                    at(&eye.origin[2], x) + distance * at(&eye.direction[2], x)};
        const zr_vm lit = zr_vm_and(zr_vf_lt(zero, distance), is_in_map(sun->map, p));
        const zr_vm seen = zr_vm_and(lit, zr_vm_first((uint32_t)(width - first)));
        if (!zr_vm_any(seen)) continue;
        const zr_vf share = half + half * zr_shadow_share_v(sun->map, p, up);
        float shares[ZR_LANES];
        zr_vf_store(shares, zr_vf_select(seen, share, one));
        for (int32_t i = 0; i < ZR_LANES && first + i < width; i++)
            out[first + i] *= shares[i];
    }
}
