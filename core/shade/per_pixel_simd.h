/* per_pixel_simd.h - shade: colours and opacities of samples that are shaded per pixel: by a model, by a texture with
 * GL 2.1's look-up, and by fog. For the shading kernel. */
#ifndef ZR_PER_PIXEL_SIMD_H
#define ZR_PER_PIXEL_SIMD_H

#include "shade/models/models_simd.h"
#include "shade/texture_simd.h"
#include "shade/varyings_simd.h"

/* ---- textures ---- */

/* Texture coordinates of a sample. GL's fixed functions also divide by the fourth coordinate, which is 1 at all corners
 * and, after rounding, not always in between. Programs, as used for phong, do not. */
struct zr_texture_place_v {
    zr_vf s, t;
};

static inline struct zr_texture_place_v zr_texture_place_of(zr_vf (*planes)[3], int first, bool is_projected, zr_vf x,
                                                            zr_vf y)
{
    const zr_vf one = zr_vf_set(1.0f), oow = zr_shaded_value(planes, 0, x, y), w = one / oow;
    const zr_vf s = zr_shaded_value(planes, first, x, y) * w, t = zr_shaded_value(planes, first + 1, x, y) * w;
    if (!is_projected) return (struct zr_texture_place_v){s, t};
    const zr_vf over_q = one / (oow * w);
    return (struct zr_texture_place_v){s * over_q, t * over_q};
}

/* Returns rho squared from differences within quads of 2x2, as the reference does: from the lowest row and the left
 * column, for all four pixels alike. */
static inline zr_vf zr_rho_of_quads_v(const struct zr_texture_map *map, zr_vf (*planes)[3], int first,
                                      bool is_projected, zr_vf x, zr_vf y)
{
    const zr_vf half = zr_vf_set(0.5f), two = zr_vf_set(2.0f), one = zr_vf_set(1.0f);
    const zr_vf left = zr_floor_v(x * half) * two, low = zr_floor_v(y * half) * two;
    const struct zr_texture_place_v at = zr_texture_place_of(planes, first, is_projected, left, low),
                                    right = zr_texture_place_of(planes, first, is_projected, left + one, low),
                                    above = zr_texture_place_of(planes, first, is_projected, left, low + one);
    return zr_rho_squared_v(map, right.s - at.s, right.t - at.t, above.s - at.s, above.t - at.t);
}

/* Samples a texture at the group PLACE, whose first plane is `first`. */
static inline struct zr_vec3_v zr_texel_at_place_v(const struct zr_texture_map *map, const struct zr_material *material,
                                                   zr_vf (*planes)[3], int first, zr_vf x, zr_vf y)
{
    const bool is_projected = material->shading != ZR_SHADING_PHONG;
    const struct zr_texture_place_v at = zr_texture_place_of(planes, first, is_projected, x, y);
    zr_vf rho = zr_vf_set(0.0f);
    if (zr_texture_needs_rho(map)) rho = zr_rho_of_quads_v(map, planes, first, is_projected, x, y);
    const struct zr_alike_maps maps = {{map}, 1};
    struct zr_vec3_v color = zr_spread_v((zr_vec3){0, 0, 0});
    zr_texture_colors_v(&maps, at.s, at.t, rho, true, &color);
    return color;
}

/* ---- materials ---- */

/* Returns w, or 1 for parts whose colours are constants. */
ZR_INLINED zr_vf zr_color_w(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask, zr_vf w)
{
    zr_vf out = w;
    for (uint32_t i = in->first; zr_mixes_constants(mask) && i < in->first + in->count; i++)
        if (s->is_constant[i])
            out = zr_vf_select(zr_vi_eq(in->owner, zr_vi_set((int32_t)s->parts.owners[i])), zr_vf_set(1.0f), out);
    return out;
}

/* Shades samples of parts that are shaded per pixel: their model's colour, and their opacity times the texture's.
 * Samples of other parts keep both. `color` is used only with ZR_VARY_COLOR, `opacity` only with ZR_VARY_OPACITY. */
ZR_INLINED void zr_shade_per_pixel(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask,
                                   struct zr_vec3_v *color, zr_vf *opacity)
{
    const struct zr_texture_maps *maps = &s->attributes->textures;
    const int place = zr_first_plane(mask, ZR_VARY_PLACE), depth = zr_first_plane(mask, ZR_VARY_DEPTH);
    const zr_vf w = zr_varying_w(in);
    struct zr_model_inputs own; /* inputs before shading: a material may recur after others */
    zr_vf own_opacity;
    if (mask & ZR_VARY_COLOR) {
        own = (struct zr_model_inputs){*color, zr_varying3(in, zr_first_plane(mask, ZR_VARY_NORMAL), w),
                                       zr_varying3(in, zr_first_plane(mask, ZR_VARY_POINT), w)};
    }
    if (mask & ZR_VARY_OPACITY) own_opacity = *opacity;
    const struct zr_material *done = NULL; /* usually there is one */
    for (uint32_t i = in->first; i < in->first + in->count; i++) {
        const struct zr_material *material = s->materials[i];
        if (!material || material == done) continue;
        const zr_vm of_it = zr_samples_of_material(s, in, i);
        if (mask & ZR_VARY_OPACITY && mask & ZR_VARY_PLACE) {
            const struct zr_texture_map *map = zr_opacity_map_of(maps, material);
            if (map)
                *opacity = zr_vf_select(
                    of_it, own_opacity * zr_texel_at_place_v(map, material, in->planes, place, in->x, in->y).x,
                    *opacity);
        }
        if (mask & ZR_VARY_COLOR) {
            struct zr_model_inputs of_material = own;
            const struct zr_texture_map *map =
                mask & ZR_VARY_PLACE ? zr_texture_map_of(maps, material, ZR_TEXTURE_BASE_COLOR) : NULL;
            if (map)
                of_material.color =
                    zr_mul_v(own.color, zr_texel_at_place_v(map, material, in->planes, place, in->x, in->y));
            struct zr_vec3_v shaded = zr_model_color(&s->model, material, &of_material);
            if (mask & ZR_VARY_DEPTH && s->attributes->fog.is_on)
                shaded = zr_fogged_v(&s->model, shaded, zr_varying(in, depth, w));
            *color = zr_choose_v(of_it, shaded, *color);
        }
        done = material;
    }
}

#endif
