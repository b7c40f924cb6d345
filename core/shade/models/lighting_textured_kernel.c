/* Lamps are tested for positions at run time here: textured shading takes longer anyway. */
#define ZR_LIGHTS_PLACED true
#include "shade/models/lighting_simd.h"

void ZR_KERNEL(zr_linear_light_textured)(const struct zr_linear_lighting *lighting, const struct zr_material *material,
                                         const struct zr_gbuffer_textures *textures, size_t at,
                                         const struct zr_shading_v *plain, struct zr_vec3_v *color)
{
    struct zr_light_cache cache = {.cool_of = NULL};
    const zr_vf one = zr_vf_set(1.0f), strength = zr_vf_set(material->occlusion_strength);
    const struct zr_textured_v textured = {
        .roughness = zr_vf_load(textures->roughness + at) * zr_vf_set(material->roughness),
        .metallic = zr_vf_load(textures->metallic + at) * zr_vf_set(material->metallic),
        .occlusion = one + strength * (zr_vf_load(textures->occlusion + at) - one),
        .emissive = zr_three_of(textures->emissive, at)};
    struct zr_shading_v s = *plain;
    s.base = zr_mul_v(plain->base, zr_three_of(textures->base, at));
    s.normal = zr_three_of(textures->normal, at);
    s.textured = &textured;
    *color = zr_shade_v(lighting, material, &cache, &s);
}
