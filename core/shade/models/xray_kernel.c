#include "shade/models/xray.h"

#include "base/srgb_color_simd.h"
#include "shade/models/glass_simd.h"

/* Returns those of the lanes `seen` that have that shading. */
static inline zr_vm find_xrays(const struct zr_material *materials, const uint32_t *numbers, zr_vm seen)
{
    uint32_t bits = 0;
    for (uint32_t left = zr_vm_bits(seen); left; left &= left - 1) {
        const int lane = zr_lowest_bit(left);
        bits |= (uint32_t)zr_shading_is_layered(materials[numbers[lane]].shading) << lane;
    }
    return zr_vm_of(bits);
}

/* Returns 1 - lean x, where x is that of the normal once turned towards the eye: to the right in the picture. */
static inline zr_vf leaned(struct zr_vec3_v normal, zr_vf cosine)
{
    const float lean = ZR_MUTANT(xray_upright, 0.4f, 0.0f);
    const zr_vf right = zr_vf_set(lean) * normal.x, zero = zr_vf_set(0.0f);
    return zr_vf_set(1.0f) + zr_vf_select(zr_vf_lt(cosine, zero), right, zero - right);
}

static inline zr_vf opacity_of(struct zr_vec3_v normal, zr_vf cosine)
{
    const zr_vf along = zr_clamp01_v(zr_vf_set(1.0f) - zr_vf_abs(cosine));
    const zr_vf power = ZR_MUTANT(xray_cubed, along * along, along * along * along);
    return zr_clamp01_v((zr_vf_set(0.15f) + zr_vf_set(0.76f) * power) * leaned(normal, cosine));
}

/* ---- glass ---- */

/* Returns the lanes `faces` whose alpha is ignored. */
static inline zr_vm find_solid(const struct zr_material *materials, const uint32_t *numbers, zr_vm faces)
{
    uint32_t bits = 0;
    for (uint32_t left = zr_vm_bits(faces); left; left &= left - 1) {
        const int lane = zr_lowest_bit(left);
        bits |= (uint32_t)materials[numbers[lane]].is_solid << lane;
    }
    return zr_vm_of(bits);
}

/* Returns the opacity of those of the lanes `faces` that are glass without a backdrop, 1 elsewhere. */
static inline zr_vf glass_opacity(const struct zr_linear_lighting *lighting, const struct zr_gbuffer *samples,
                                  size_t at, zr_vm faces, struct zr_vec3_v to_eye)
{
    float values[7][ZR_LANES] = {{0.0f}};
    uint32_t bits = 0;
    for (uint32_t left = zr_vm_bits(faces); left; left &= left - 1) {
        const int lane = zr_lowest_bit(left);
        const uint32_t number = samples->material[at + (size_t)lane];
        const struct zr_material *material = &lighting->materials[number];
        const zr_vec3 f0 = material->reflectance;
        const float most = f0.x > f0.y ? f0.x : f0.y;
        if (!zr_material_is_glass(material) || zr_has_backdrop(lighting, material)) continue;
        bits |= 1u << lane;
        values[0][lane] = material->finish.transmission * (1.0f - material->metallic);
        values[1][lane] = most > f0.z ? most : f0.z;
        values[2][lane] = material->grazing;
        values[3][lane] = material->finish.attenuation.x;
        values[4][lane] = material->finish.attenuation.y;
        values[5][lane] = material->finish.attenuation.z;
        values[6][lane] = zr_power_of(lighting, number);
    }
    if (!bits) return zr_vf_set(1.0f);
    const struct zr_glass_v glass = {zr_vf_load(values[0]), zr_vf_load(values[1]), zr_vf_load(values[2])};
    const struct zr_vec3_v attenuation = {zr_vf_load(values[3]), zr_vf_load(values[4]), zr_vf_load(values[5])};
    const struct zr_vec3_v base = zr_mul_v(zr_srgb_decode_color_v(zr_three_of(samples->base, at)),
                                           zr_attenuated_v(attenuation, zr_vf_load(values[6])));
    const zr_vf passing = zr_glass_passing_v(&glass, zr_three_of(samples->normal, at), to_eye);
    const zr_vf opacity = zr_vf_set(1.0f) - passing * zr_least_of_v(base);
    return zr_vf_select(zr_vm_of(bits), zr_vf_max(opacity, zr_vf_set(ZR_GLASS_OPACITY_LEAST)), zr_vf_set(1.0f));
}

/* ---- both ---- */

void ZR_KERNEL(zr_xray)(const struct zr_linear_lighting *lighting, const struct zr_gbuffer *samples, float *opacity)
{
    for (int32_t y = 0; y < samples->height; y++) {
        const size_t begin = (size_t)(y * samples->stride), end = begin + (size_t)samples->width;
        for (size_t at = begin; at < end; at += ZR_LANES) {
            const zr_vm within = zr_vm_first((uint32_t)(end - at));
            const zr_vm seen = zr_vm_and(within, zr_vi_lt(zr_vi_set(0), zr_vi_load(samples->owner + at)));
            if (!zr_vm_any(seen)) continue;
            const struct zr_vec3_v normal = zr_three_of(samples->normal, at);
            const zr_vm is_line = zr_vf_eq(zr_dot_v(normal, normal), zr_vf_set(0.0f));
            const zr_vm xrays = zr_vm_andnot(find_xrays(lighting->materials, samples->material + at, seen), is_line);
            const struct zr_vec3_v to_eye = zr_to_eye_v(lighting, zr_three_of(samples->point, at));
            const zr_vm faces = zr_vm_andnot(seen, is_line);
            const zr_vf glass = glass_opacity(lighting, samples, at, faces, to_eye);
            const zr_vm solid = find_solid(lighting->materials, samples->material + at, faces);
            const zr_vf given = zr_vf_select(solid, zr_vf_set(1.0f), zr_vf_load(opacity + at));
            const zr_vf own = given * glass, cosine = zr_dot_v(normal, to_eye);
            zr_vf_store(opacity + at, zr_vf_select(xrays, own * opacity_of(normal, cosine), own));
        }
    }
}
