/* finish_simd.h - shade: finishes of pbr surfaces (struct zr_finish), for kernels. Films: film_simd.h.
 *
 * Clear coat: a layer with the index of refraction 1.5, whose share of the light is Fc = factor (.04 + .96 (1 -
 *             N.V)^5), by the surface's normal with the normal map of the coat alone. The light is (1 - Fc) below +
 *             Fc of the coat: L(R) at the coat's roughness, and GGX's specular term of lamps.
 * Sheen:      fibres, below the coat: colour (T E(N) + lamps) + (1 - max(colour) T) below. T is that of sheen.h. Lamps:
 *             Charlie's distribution and Ashikhmin's visibility.
 * Glass:      light of the backdrop that refraction_simd.h finds is added to that of the surface, which is opaque.
 *             Thin and smooth glass, and glass without a backdrop, is blended instead: its opacity is that of
 *             glass_opacity_v. The colour is divided by it, so that reflections keep their strength. The least channel
 *             of a tint attenuates the background; the rest of the others is the light all around.
 * Uniform light from everywhere stays as it is below coats and white sheens.
 * Source:     KHR_materials_clearcoat, KHR_materials_sheen, KHR_materials_transmission.
 */
#ifndef ZR_FINISH_SIMD_H
#define ZR_FINISH_SIMD_H

#include "shade/lights/sheen.h"
#include "shade/models/glass_simd.h"
#include "shade/models/pbr_simd.h"
#include "shade/models/refraction_simd.h"

static inline zr_vf zr_facing_v(struct zr_vec3_v normal, struct zr_vec3_v to_eye)
{
    return zr_vf_min(zr_vf_max(zr_dot_v(normal, to_eye), zr_vf_set(1e-4f)), zr_vf_set(1.0f));
}

/* True for lamps that a finish reflects one by one. */
static inline bool zr_lamp_is_single(const struct zr_lamp *lamp)
{
    return lamp->lights_pbr && !lamp->is_hemisphere;
}

/* ---- clear coats ---- */

/* Returns the specular light of a layer that reflects everything. */
static inline struct zr_vec3_v zr_layer_light_v(const struct zr_linear_lighting *lighting, const struct zr_pbr_v *layer,
                                                const struct zr_shading_v *s)
{
    const struct zr_vec3_v mirrored = zr_pbr_gather_v(lighting, layer, s).specular;
    struct zr_vec3_v sum = zr_scale_v(mirrored, s->ao * s->textured->occlusion);
    for (uint32_t i = 0; i < lighting->lights.count; i++)
        if (zr_lamp_is_single(&lighting->lights.lamps[i]))
            sum = zr_add_v(sum, zr_pbr_from_lamp_v(&lighting->lights.lamps[i], layer, s));
    return sum;
}

static inline struct zr_vec3_v zr_coated_v(const struct zr_linear_lighting *lighting, const struct zr_shading_v *s,
                                           struct zr_vec3_v below)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    struct zr_shading_v top = *s;
    top.normal = s->textured->coat_normal;
    const struct zr_pbr_v coat = {.diffuse = {zero, zero, zero},
                                  .f0 = {one, one, one},
                                  .f90 = one,
                                  .metallic = one,
                                  .facing = zr_facing_v(top.normal, s->to_eye),
                                  .finished_f0 = one,
                                  .alphas = s->textured->coat_roughness * s->textured->coat_roughness};
    const zr_vf fresnel = zr_mix_v(zr_vf_set(0.04f), one, zr_fifth_power_v(one - coat.facing));
    const zr_vf share = s->textured->coat * fresnel, through = ZR_MUTANT(coat_adds_light, one - share, one);
    return zr_add_v(zr_scale_v(below, through), zr_scale_v(zr_layer_light_v(lighting, &coat, &top), share));
}

/* ---- sheens ---- */

static inline zr_vf zr_sheen_albedo_v(float roughness, zr_vf facing)
{
    const float row = roughness * (float)(ZR_SHEEN_SIDE - 1);
    const int low = row < (float)(ZR_SHEEN_SIDE - 2) ? (int)row : ZR_SHEEN_SIDE - 2;
    const zr_vf column = zr_vf_sqrt(facing) * zr_vf_set((float)(ZR_SHEEN_SIDE - 1)), half = zr_vf_set(0.5f);
    const zr_vi last = zr_vi_set(ZR_SHEEN_SIDE - 2);
    const zr_vi left = zr_vi_min(zr_vi_max(zr_vi_round(column - half), zr_vi_set(0)), last);
    const zr_vf right = column - zr_vf_of(left), down = zr_vf_set(row - (float)low);
    zr_vf corners[2][2];
    for (int i = 0; i < 4; i++)
        corners[i / 2][i % 2] =
            zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, zr_sheen_table[low + i / 2], left + zr_vi_set(i % 2)));
    return zr_mix_v(zr_mix_v(corners[0][0], corners[0][1], right), zr_mix_v(corners[1][0], corners[1][1], right), down);
}

/* Returns the light that white fibres reflect from a lamp. over_alpha: 1 / alpha. */
static inline struct zr_vec3_v zr_sheen_lamp_v(const struct zr_lamp *lamp, const struct zr_shading_v *s, zr_vf facing,
                                               float over_alpha)
{
    const struct zr_arriving_v arriving = zr_lit_by_v(lamp, s);
    const struct zr_vec3_v half = zr_normalize_v(zr_add_v(arriving.to_light, s->to_eye));
    const zr_vf nl = zr_clamp01_v(zr_dot_v(s->normal, arriving.to_light));
    const zr_vf square_sine = zr_clamp01_v(zr_square_sine_v(s->normal, half));
    const zr_vf distribution =
        zr_vf_set(1.0f + 0.5f * over_alpha) * zr_pow_v(square_sine, zr_vf_set(0.5f * over_alpha));
    const zr_vf visible = zr_vf_set(0.25f) / (nl + facing - nl * facing);
    return zr_scale_v(zr_spread_v(lamp->color), arriving.share * distribution * visible * nl);
}

static inline struct zr_vec3_v zr_with_sheen_v(const struct zr_linear_lighting *lighting,
                                               const struct zr_finish *finish, const struct zr_shading_v *s,
                                               struct zr_vec3_v below)
{
    const float given = finish->sheen_roughness,
                roughness = given > ZR_SHEEN_ROUGHNESS_LEAST ? given : ZR_SHEEN_ROUGHNESS_LEAST;
    const zr_vf facing = zr_facing_v(s->normal, s->to_eye), albedo = zr_sheen_albedo_v(given, facing);
    const struct zr_pbr_v soft = {.facing = facing, .alphas = zr_vf_set(1.0f)};
    struct zr_vec3_v sum =
        zr_scale_v(zr_pbr_gather_v(lighting, &soft, s).diffuse, albedo * s->ao * s->textured->occlusion);
    for (uint32_t i = 0; i < lighting->lights.count; i++)
        if (zr_lamp_is_single(&lighting->lights.lamps[i]))
            sum = zr_add_v(sum, zr_sheen_lamp_v(&lighting->lights.lamps[i], s, facing, 1.0f / (roughness * roughness)));
    const struct zr_vec3_v color = s->textured->sheen;
    const zr_vf through = zr_vf_set(1.0f) - zr_vf_max(color.x, zr_vf_max(color.y, color.z)) * albedo;
    return zr_add_v(zr_mul_v(color, sum), zr_scale_v(below, ZR_MUTANT(sheen_adds_light, through, zr_vf_set(1.0f))));
}

/* ---- glass ---- */

/* Returns the share of light that is not reflected, and that of each colour that the glass leaves of it. */
static inline struct zr_vec3_v zr_glass_share_v(const struct zr_backdrop *backdrop, const struct zr_material *material,
                                                uint32_t number, const struct zr_shading_v *s)
{
    const zr_vf one = zr_vf_set(1.0f);
    zr_vf a, b;
    zr_dfg_at_each_v(s->textured->roughness, zr_facing_v(s->normal, s->to_eye), &a, &b);
    const struct zr_bounces_v bounces =
        zr_bounces_of_v(zr_vf_set(zr_largest_of(material->reflectance)), zr_vf_set(material->grazing), a, b);
    const zr_vf entering = one - bounces.once / (one - bounces.scattered);
    const zr_vf passing = s->textured->transmission * (one - s->textured->metallic) * entering;
    const struct zr_vec3_v left = zr_attenuated_v(zr_spread_v(material->finish.attenuation),
                                                  s->textured->thickness * zr_vf_set(backdrop->power[number]));
    return zr_scale_v(zr_mul_v(s->base, left), passing);
}

/* Adds light that passes through glass to tone-mapped light. */
static inline struct zr_vec3_v zr_with_backdrop_v(const struct zr_backdrop *backdrop,
                                                  const struct zr_material *material, uint32_t number,
                                                  const struct zr_shading_v *s, struct zr_vec3_v light)
{
    const zr_vf one = zr_vf_set(1.0f);
    const struct zr_vec3_v behind =
        zr_dispersed_v(backdrop, &material->finish, s, s->textured->thickness * zr_vf_set(backdrop->thickness[number]));
    const struct zr_vec3_v sum = zr_add_v(light, zr_mul_v(behind, zr_glass_share_v(backdrop, material, number, s)));
    return (struct zr_vec3_v){zr_vf_min(sum.x, one), zr_vf_min(sum.y, one), zr_vf_min(sum.z, one)};
}

/* Adds the light behind a tinted glass, and divides the light by the opacity. surface: without textures and
 * finishes. */
static inline struct zr_vec3_v zr_glass_light_v(const struct zr_linear_lighting *lighting,
                                                const struct zr_material *material, const struct zr_shading_v *s,
                                                struct zr_vec3_v light)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    const struct zr_glass_v glass = {zr_vf_set(material->finish.transmission * (1.0f - material->metallic)),
                                     zr_vf_set(zr_largest_of(material->reflectance)), zr_vf_set(material->grazing)};
    const zr_vf passing = zr_glass_passing_v(&glass, s->textured->surface_normal, s->to_eye);
    const uint32_t number = (uint32_t)(material - lighting->materials);
    const struct zr_vec3_v left =
        zr_attenuated_v(zr_spread_v(material->finish.attenuation), zr_vf_set(zr_power_of(lighting, number)));
    const zr_vf seen = passing * zr_least_of_v(zr_mul_v(s->textured->surface_base, left));
    const struct zr_vec3_v through = zr_scale_v(zr_mul_v(s->base, left), passing);
    struct zr_shading_v behind = *s;
    behind.normal = zr_scale_v(s->to_eye, zr_vf_set(-1.0f));
    const struct zr_pbr_v soft = {.facing = one, .alphas = one};
    const struct zr_vec3_v around = zr_pbr_gather_v(lighting, &soft, &behind).diffuse;
    const struct zr_vec3_v tinted = {zr_vf_max(through.x - seen, zero), zr_vf_max(through.y - seen, zero),
                                     zr_vf_max(through.z - seen, zero)};
    const zr_vf opacity = zr_vf_max(one - seen, zr_vf_set(ZR_GLASS_OPACITY_LEAST));
    return zr_scale_v(zr_add_v(light, zr_mul_v(tinted, around)), one / opacity);
}

/* ---- all ---- */

/* Shades samples of one material with a finish; s->textured is not NULL. */
ZR_INLINED struct zr_vec3_v zr_shade_finished_v(const struct zr_linear_lighting *lighting,
                                                const struct zr_material *material, const struct zr_shading_v *s)
{
    const struct zr_finish *finish = &material->finish;
    struct zr_vec3_v light = zr_shade_pbr_v(lighting, material, NULL, s);
    if (zr_finish_has_sheen(finish)) light = zr_with_sheen_v(lighting, finish, s, light);
    if (finish->coat > 0.0f) light = zr_coated_v(lighting, s, light);
    if (!zr_material_is_glass(material) || zr_has_backdrop(lighting, material)) return light;
    return zr_glass_light_v(lighting, material, s, light);
}

#endif
