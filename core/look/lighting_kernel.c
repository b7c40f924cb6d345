#include "look/lighting.h"

#include "base/inlined.h"
#include "look/srgb_simd.h"
#include "look/surface_classic_simd.h"
#include "look/surface_pbr_simd.h"

/* lighting_placed_kernel.c is this once more, with another name. */
#ifndef ZR_LIGHTING_KERNEL
#define ZR_LIGHTING_KERNEL ZR_KERNEL(zr_look_light)
#endif

/* What is kept from vector to vector: most have the colour and the material of the one before. Found anew for every 64
 * samples, it took a sixteenth of the time. */
struct cache {
    struct zr_vec3_v encoded, linear;
    const struct zr_material *cool_of; /* NULL: none so far */
    struct zr_vec3_v cool;
    struct zr_split_columns columns; /* of the last roughness; less than 0: none so far */
};

static inline bool is_same(zr_vf a, zr_vf b)
{
    return zr_vm_bits(zr_vi_eq(zr_vi_bits_of(a), zr_vi_bits_of(b))) == ZR_ALL_BITS;
}

static inline struct zr_vec3_v decode(struct cache *cache, struct zr_vec3_v c)
{
    if (is_same(c.x, cache->encoded.x) && is_same(c.y, cache->encoded.y) && is_same(c.z, cache->encoded.z))
        return cache->linear;
    cache->encoded = c;
    cache->linear = ZR_MUTANT(colors_not_decoded, zr_srgb_decode_color_v(c), c);
    return cache->linear;
}

static inline struct zr_vec3_v three_of(float *const from[3], size_t at)
{
    return (struct zr_vec3_v){zr_vf_load(from[0] + at), zr_vf_load(from[1] + at), zr_vf_load(from[2] + at)};
}

static inline struct zr_vec3_v exposed(const struct zr_look_lighting *lighting, struct zr_vec3_v color)
{
    return zr_tone_v(zr_scale_v(color, zr_vf_set(lighting->exposure)), lighting->tone);
}

static inline struct zr_vec3_v normals_as_colors(struct zr_vec3_v n)
{
    const zr_vf half = zr_vf_set(0.5f);
    return zr_srgb_decode_color_v((struct zr_vec3_v){n.x * half + half, n.y * half + half, n.z * half + half});
}

static inline struct zr_vec3_v cool_of(struct cache *cache, const struct zr_material *material)
{
    if (cache->cool_of == material) return cache->cool;
    cache->cool_of = material;
    cache->cool = zr_srgb_decode_color_v(zr_spread_v(material->cool));
    return cache->cool;
}

/* Samples of one material. */
ZR_INLINED struct zr_vec3_v shade(const struct zr_look_lighting *lighting, const struct zr_material *material,
                                  struct cache *cache, const struct zr_shading_v *s)
{
    switch (material->shading) {
    case ZR_SHADING_FLAT:
    case ZR_SHADING_GOURAUD:
    case ZR_SHADING_PHONG:
        return exposed(lighting, zr_surface_classic_v(lighting, material, s));
    case ZR_SHADING_PBR:
        if (!s->textured && cache->columns.roughness != material->roughness)
            zr_split_columns_make(&cache->columns, material->roughness);
        return exposed(lighting, zr_surface_pbr_v(lighting, material, &cache->columns, s));
    case ZR_SHADING_GOOCH:
        return zr_surface_gooch_v(cool_of(cache, material), s);
    case ZR_SHADING_NORMALS:
        return normals_as_colors(s->normal);
    default:
        return s->base;
    }
}

static inline struct zr_vec3_v to_eye_of(const struct zr_look_lighting *lighting, struct zr_vec3_v point)
{
    if (lighting->is_parallel) return zr_spread_v(lighting->to_eye);
    return zr_normalize_v(zr_scale_v(point, zr_vf_set(-1.0f)));
}

/* Samples of one that has textures: what these make of the surface goes before it. */
static struct zr_vec3_v shade_textured(const struct zr_look_lighting *lighting, const struct zr_material *material,
                                       struct cache *cache, const struct zr_gbuffer_textures *textures, size_t at,
                                       const struct zr_shading_v *plain)
{
    const zr_vf one = zr_vf_set(1.0f), strength = zr_vf_set(material->occlusion_strength);
    const struct zr_textured_v textured = {
        .roughness = zr_vf_load(textures->roughness + at) * zr_vf_set(material->roughness),
        .metallic = zr_vf_load(textures->metallic + at) * zr_vf_set(material->metallic),
        .occlusion = one + strength * (zr_vf_load(textures->occlusion + at) - one),
        .emissive = three_of(textures->emissive, at)};
    struct zr_shading_v s = *plain;
    s.base = zr_mul_v(plain->base, three_of(textures->base, at));
    s.textured = &textured;
    return shade(lighting, material, cache, &s);
}

/* One material after the other, of those that are seen. */
static inline struct zr_vec3_v shade_all(const struct zr_look_lighting *lighting, struct cache *cache,
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
        const struct zr_vec3_v color = textures && zr_material_has_textures(material)
                                           ? shade_textured(lighting, material, cache, textures, at, s)
                                           : shade(lighting, material, cache, s);
        out = zr_choose_v(zr_vm_and(seen, of_it), color, out);
        left &= ~zr_vm_bits(of_it);
    }
    return out;
}

/* Of ZR_LANES samples, some of which are seen. */
static inline struct zr_vec3_v colors_of(const struct zr_look_lighting *lighting, struct cache *cache,
                                         const struct zr_gbuffer *samples, const float *occlusion, size_t at,
                                         zr_vm seen)
{
    struct zr_shading_v s = {.normal = three_of(samples->normal, at), .point = three_of(samples->point, at)};
    s.base = decode(cache, three_of(samples->base, at));
    s.to_eye = to_eye_of(lighting, s.point);
    s.ao = occlusion ? zr_vf_load(occlusion + at) : zr_vf_set(1.0f);
    const zr_vm is_line = zr_vf_eq(zr_dot_v(s.normal, s.normal), zr_vf_set(0.0f));
    const struct zr_vec3_v color =
        shade_all(lighting, cache, samples->textures, at, zr_vi_load(samples->material + at), seen, &s);
    return zr_choose_v(zr_vm_and(seen, is_line), s.base, color);
}

void ZR_LIGHTING_KERNEL(const struct zr_look_lighting *lighting, const struct zr_gbuffer *samples,
                        const float *occlusion, float *const out[3])
{
    if (!ZR_LIGHTS_PLACED && lighting->placed_count > 0) {
        ZR_KERNEL(zr_look_light_placed)(lighting, samples, occlusion, out);
        return;
    }
    const zr_vf zero = zr_vf_set(0.0f), none = zr_vf_set(-1.0f);
    struct cache cache = {.encoded = {none, none, none}, .linear = {zero, zero, zero}, .columns.roughness = -1.0f};
    for (int32_t y = 0; y < samples->height; y++) {
        const size_t begin = (size_t)(y * samples->stride), end = begin + (size_t)samples->width;
        for (size_t at = begin; at < end; at += ZR_LANES) {
            /* What is behind the end was written by nobody: its materials may be none. */
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
