#include "shade/lights/lighting.h"

#include "shade/models/lighting_simd.h"

/* lighting_placed_kernel.c includes this file under another kernel name. */
#ifndef ZR_LIGHTING_KERNEL
#define ZR_LIGHTING_KERNEL ZR_KERNEL(zr_linear_light)
#endif

static inline bool is_same(zr_vf a, zr_vf b)
{
    return zr_vm_bits(zr_vi_eq(zr_vi_bits_of(a), zr_vi_bits_of(b))) == ZR_ALL_BITS;
}

static inline struct zr_vec3_v decode(struct zr_light_cache *cache, struct zr_vec3_v c)
{
    if (is_same(c.x, cache->encoded.x) && is_same(c.y, cache->encoded.y) && is_same(c.z, cache->encoded.z))
        return cache->linear;
    cache->encoded = c;
    cache->linear = ZR_MUTANT(colors_not_decoded, zr_srgb_decode_color_v(c), c);
    return cache->linear;
}

/* Calls a kernel of its own (lighting_textured_kernel.c), since its code here would slow down untextured shading. */
static struct zr_vec3_v shade_textured(const struct zr_linear_lighting *lighting, const struct zr_material *material,
                                       const struct zr_gbuffer_textures *textures, size_t at,
                                       const struct zr_shading_v *s)
{
    const struct zr_shading_v copy = *s; /* passed by address, so that *s stays in registers */
    struct zr_vec3_v color;
    ZR_KERNEL(zr_linear_light_textured)(lighting, material, textures, at, &copy, &color);
    return color;
}

/* Likewise. textures: NULL if the material has none. */
static struct zr_vec3_v shade_finished(const struct zr_linear_lighting *lighting, const struct zr_material *material,
                                       const struct zr_gbuffer_textures *textures, size_t at,
                                       const struct zr_shading_v *s)
{
    const struct zr_shading_v copy = *s;
    struct zr_vec3_v color;
    ZR_KERNEL(zr_linear_light_finished)(lighting, material, textures, at, &copy, &color);
    return color;
}

/* Shades the lanes `seen`, one material after the other. */
static inline struct zr_vec3_v shade_all(const struct zr_linear_lighting *lighting, struct zr_light_cache *cache,
                                         const struct zr_gbuffer_textures *textures, size_t at, zr_vi numbers,
                                         zr_vm seen, const struct zr_shading_v *s)
{
    const zr_vf zero = zr_vf_set(0.0f);
    struct zr_vec3_v out = {zero, zero, zero};
    uint32_t each[ZR_LANES], left = zr_vm_bits(seen);
    zr_vi_store(each, numbers);
    while (left) {
        const uint32_t number = each[zr_lowest_bit(left)];
        const zr_vm of_it = zr_vi_eq(numbers, zr_vi_set((int32_t)number));
        const struct zr_material *material = &lighting->materials[number];
        const bool is_textured = textures && zr_material_is_mapped(material);
        const struct zr_vec3_v color = zr_material_has_finish(material)
                                           ? shade_finished(lighting, material, is_textured ? textures : NULL, at, s)
                                       : is_textured ? shade_textured(lighting, material, textures, at, s)
                                                     : zr_shade_v(lighting, material, cache, s);
        out = zr_choose_v(zr_vm_and(seen, of_it), color, out);
        left &= ~zr_vm_bits(of_it);
    }
    return out;
}

/* Returns the colours of ZR_LANES samples; `seen`: the covered ones. */
static inline struct zr_vec3_v colors_of(const struct zr_linear_lighting *lighting, struct zr_light_cache *cache,
                                         const struct zr_gbuffer *samples, const float *occlusion, size_t at,
                                         zr_vm seen)
{
    struct zr_shading_v s = {.normal = zr_three_of(samples->normal, at), .point = zr_three_of(samples->point, at)};
    s.base = decode(cache, zr_three_of(samples->base, at));
    s.to_eye = zr_to_eye_v(lighting, s.point);
    s.ao = occlusion ? zr_vf_load(occlusion + at) : zr_vf_set(1.0f);
    const zr_vm is_line = zr_vf_eq(zr_dot_v(s.normal, s.normal), zr_vf_set(0.0f));
    const struct zr_vec3_v color =
        shade_all(lighting, cache, samples->textures, at, zr_vi_load(samples->material + at), seen, &s);
    return zr_choose_v(zr_vm_and(seen, is_line), s.base, color);
}

void ZR_LIGHTING_KERNEL(const struct zr_linear_lighting *lighting, const struct zr_gbuffer *samples,
                        const float *occlusion, float *const out[3])
{
    if (!ZR_LIGHTS_PLACED && lighting->lights.placed_count > 0) {
        ZR_KERNEL(zr_linear_light_placed)(lighting, samples, occlusion, out);
        return;
    }
    const zr_vf zero = zr_vf_set(0.0f), none = zr_vf_set(-1.0f);
    struct zr_light_cache cache = {
        .encoded = {none, none, none}, .linear = {zero, zero, zero}, .columns.roughness = -1.0f};
    for (int32_t y = 0; y < samples->height; y++) {
        const size_t begin = (size_t)(y * samples->stride), end = begin + (size_t)samples->width;
        for (size_t at = begin; at < end; at += ZR_LANES) {
            /* Values beyond the end are unwritten, and their materials may not exist. */
            const zr_vm within = zr_vm_first((uint32_t)(end - at));
            const zr_vm seen = zr_vm_and(within, zr_vi_lt(zr_vi_set(0), zr_vi_load(samples->owner + at)));
            struct zr_vec3_v color = {zero, zero, zero};
            if (zr_vm_any(seen)) color = colors_of(lighting, &cache, samples, occlusion, at, seen);
            zr_vf_store(out[0] + at, color.x);
            zr_vf_store(out[1] + at, color.y);
            zr_vf_store(out[2] + at, color.z);
        }
    }
}
