/* lighting_simd.h - shade: colours of samples of one material, for the lighting kernels. */
#ifndef ZR_LIGHTING_SIMD_H
#define ZR_LIGHTING_SIMD_H

#include "base/inlined.h"
#include "base/srgb_color_simd.h"
#include "shade/models/classic_simd.h"
#include "shade/models/finish_simd.h"

/* Values kept from vector to vector, since most vectors have the colour and material of the one before. Recomputed for
 * every 64 samples, they took a sixteenth of the time. */
struct zr_light_cache {
    struct zr_vec3_v encoded, linear;
    const struct zr_material *cool_of; /* NULL: none so far */
    struct zr_vec3_v cool;
    struct zr_dfg_columns columns; /* columns of the last roughness; below 0: none so far */
};

static inline struct zr_vec3_v zr_exposed(const struct zr_linear_lighting *lighting, struct zr_vec3_v color)
{
    return zr_tone_v(zr_scale_v(color, zr_vf_set(lighting->exposure)), lighting->tone);
}

static inline struct zr_vec3_v zr_normals_as_colors(struct zr_vec3_v n)
{
    const zr_vf half = zr_vf_set(0.5f);
    return zr_srgb_decode_color_v((struct zr_vec3_v){n.x * half + half, n.y * half + half, n.z * half + half});
}

static inline struct zr_vec3_v zr_cool_of(struct zr_light_cache *cache, const struct zr_material *material)
{
    if (cache->cool_of == material) return cache->cool;
    cache->cool_of = material;
    cache->cool = zr_srgb_decode_color_v(zr_spread_v(material->cool));
    return cache->cool;
}

/* Shades samples of one material. `cache` supplies the columns of untextured ones. */
ZR_INLINED struct zr_vec3_v zr_shade_v(const struct zr_linear_lighting *lighting, const struct zr_material *material,
                                       struct zr_light_cache *cache, const struct zr_shading_v *s)
{
    switch (material->shading) {
    case ZR_SHADING_FLAT:
    case ZR_SHADING_GOURAUD:
    case ZR_SHADING_PHONG:
        return zr_exposed(lighting, zr_shade_classic_v(lighting, material, s));
    case ZR_SHADING_PBR:
        if (ZR_FINISHES) {
            const struct zr_vec3_v light = zr_exposed(lighting, zr_shade_finished_v(lighting, material, s));
            if (!zr_has_backdrop(lighting, material)) return light;
            return zr_with_backdrop_v(lighting->backdrop, material, (uint32_t)(material - lighting->materials), s,
                                      light);
        }
        if (!s->textured && cache->columns.roughness != material->roughness)
            zr_dfg_columns_make(&cache->columns, material->roughness);
        return zr_exposed(lighting, zr_shade_pbr_v(lighting, material, &cache->columns, s));
    case ZR_SHADING_GOOCH:
        return zr_shade_gooch_v(&lighting->gooch, zr_cool_of(cache, material), s);
    case ZR_SHADING_NORMALS:
        return zr_normals_as_colors(s->normal);
    default:
        return s->base;
    }
}

/* Shades samples of a material with textures: applies the values at `at` to the surface first. */
void ZR_KERNEL(zr_linear_light_textured)(const struct zr_linear_lighting *lighting, const struct zr_material *material,
                                         const struct zr_gbuffer_textures *textures, size_t at,
                                         const struct zr_shading_v *plain, struct zr_vec3_v *color);

/* Likewise, of a material with a finish. textures: NULL if it has none. */
void ZR_KERNEL(zr_linear_light_finished)(const struct zr_linear_lighting *lighting, const struct zr_material *material,
                                         const struct zr_gbuffer_textures *textures, size_t at,
                                         const struct zr_shading_v *plain, struct zr_vec3_v *color);

#endif
