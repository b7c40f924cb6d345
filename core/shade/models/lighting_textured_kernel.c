/* Lamps are tested for positions at run time here: textured shading takes longer anyway. */
#define ZR_LIGHTS_PLACED true
#include "shade/models/lighting_simd.h"

/* lighting_finished_kernel.c includes this file under another kernel name. */
#ifndef ZR_TEXTURED_KERNEL
#define ZR_TEXTURED_KERNEL ZR_KERNEL(zr_linear_light_textured)
#endif

/* Returns the factors of a material, times the texture values at `at`. textures: NULL if the material has none. */
static inline struct zr_textured_v textured_of(const struct zr_material *material,
                                               const struct zr_gbuffer_textures *textures, size_t at)
{
    const zr_vf one = zr_vf_set(1.0f), strength = zr_vf_set(material->occlusion_strength);
    struct zr_textured_v out = {.roughness = zr_vf_set(material->roughness),
                                .metallic = zr_vf_set(material->metallic),
                                .occlusion = one,
                                .emissive = {one, one, one}};
    if (ZR_FINISHES) {
        out.coat = zr_vf_set(material->finish.coat);
        out.coat_roughness = zr_vf_set(material->finish.coat_roughness);
        out.film = zr_vf_set(material->finish.film);
        out.film_nm = zr_vf_set(material->finish.film_nm);
        out.sheen = zr_spread_v(material->finish.sheen);
        out.transmission = zr_vf_set(material->finish.transmission);
        out.thickness = one;
        out.anisotropy = zr_vf_set(0.0f);
    }
    if (ZR_FINISHES && !textures) return out;
    out.roughness = zr_vf_load(textures->roughness + at) * out.roughness;
    out.metallic = zr_vf_load(textures->metallic + at) * out.metallic;
    out.occlusion = one + strength * (zr_vf_load(textures->occlusion + at) - one);
    out.emissive = zr_three_of(textures->emissive, at);
    if (ZR_FINISHES && textures->coat) {
        out.coat = zr_vf_load(textures->coat + at) * out.coat;
        out.coat_roughness = zr_vf_load(textures->coat_roughness + at) * out.coat_roughness;
        out.coat_normal = zr_three_of(textures->coat_normal, at);
        out.sheen = zr_mul_v(zr_three_of(textures->sheen, at), out.sheen);
        out.film = zr_vf_load(textures->film + at) * out.film;
        out.film_nm =
            zr_mix_v(zr_vf_set(material->finish.film_thinnest), out.film_nm, zr_vf_load(textures->film_thickness + at));
        out.transmission = zr_vf_load(textures->transmission + at) * out.transmission;
        out.thickness = zr_vf_load(textures->thickness + at);
        out.along = zr_three_of(textures->along, at);
        out.anisotropy = zr_vf_load(textures->anisotropy + at) * zr_vf_set(material->finish.anisotropy);
    }
    return out;
}

void ZR_TEXTURED_KERNEL(const struct zr_linear_lighting *lighting, const struct zr_material *material,
                        const struct zr_gbuffer_textures *textures, size_t at, const struct zr_shading_v *plain,
                        struct zr_vec3_v *color)
{
    struct zr_light_cache cache = {.cool_of = NULL};
    struct zr_textured_v textured = textured_of(material, textures, at);
    struct zr_shading_v s = *plain;
    if (ZR_FINISHES) {
        textured.surface_base = plain->base;
        textured.surface_normal = plain->normal;
        if (!textures || !textures->coat) textured.coat_normal = plain->normal;
    }
    if (textures) {
        s.base = zr_mul_v(plain->base, zr_three_of(textures->base, at));
        s.normal = zr_three_of(textures->normal, at);
    }
    s.textured = &textured;
    *color = zr_shade_v(lighting, material, &cache, &s);
}
