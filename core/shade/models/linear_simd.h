/* linear_simd.h - shade: inputs of shading in linear light, ZR_LANES samples at a time, for kernels. */
#ifndef ZR_LINEAR_SIMD_H
#define ZR_LINEAR_SIMD_H

#include "shade/lights/environment_simd.h"
#include "shade/lights/lamp_place_simd.h"
#include "shade/lights/lighting.h"
#include "shade/lights/shadow_map_simd.h"
#include "shade/lights/tone_simd.h"

/* True if lamps may have a position. Their code would slow down other pictures, so each case has a kernel of its
 * own. */
#ifndef ZR_LIGHTS_PLACED
#define ZR_LIGHTS_PLACED false
#endif

/* True in kernels of materials with a finish (scene.h). Its code would slow down others. */
#ifndef ZR_FINISHES
#define ZR_FINISHES false
#endif

struct zr_shading_v {
    struct zr_vec3_v base;   /* linear */
    struct zr_vec3_v normal; /* unit */
    struct zr_vec3_v to_eye; /* unit */
    struct zr_vec3_v point;  /* as in the G-buffer */
    zr_vf ao;                /* ambient occlusion: the share of ambient light that arrives */
    /* Texture values; the factor of `base` is already applied. NULL: untextured. */
    const struct zr_textured_v *textured;
};

struct zr_textured_v {
    zr_vf roughness, metallic;
    zr_vf occlusion;           /* another share of ambient light, independent of the reflected colour */
    struct zr_vec3_v emissive; /* factor */
    /* With ZR_FINISHES only. */
    zr_vf coat, coat_roughness, film, film_nm, transmission;
    zr_vf thickness; /* factor */
    zr_vf anisotropy;
    struct zr_vec3_v along; /* unit, or 0: isotropic */
    struct zr_vec3_v sheen; /* colour */
    struct zr_vec3_v coat_normal;
    struct zr_vec3_v surface_base, surface_normal; /* without textures */
};

static inline struct zr_vec3_v zr_three_of(float *const from[3], size_t at)
{
    return (struct zr_vec3_v){zr_vf_load(from[0] + at), zr_vf_load(from[1] + at), zr_vf_load(from[2] + at)};
}

/* Returns unit vectors from points to the eye. */
static inline struct zr_vec3_v zr_to_eye_v(const struct zr_linear_lighting *lighting, struct zr_vec3_v point)
{
    if (lighting->is_parallel) return zr_spread_v(lighting->to_eye);
    return zr_normalize_v(zr_scale_v(point, zr_vf_set(-1.0f)));
}

/* Returns the light of a hemisphere in direction d: a mix of ground and sky. */
static inline struct zr_vec3_v zr_hemisphere_v(const struct zr_lamp *lamp, struct zr_vec3_v d)
{
    const zr_vf half = zr_vf_set(0.5f), share = half * zr_dot_v(d, zr_spread_v(lamp->to_light));
    const zr_vf up = ZR_MUTANT(hemisphere_turned, half + share, half - share);
    return zr_mix3_v(zr_spread_v(lamp->ground), zr_spread_v(lamp->color), up);
}

/* Returns the light that arrives from a lamp other than a hemisphere, less its shadow. */
static inline struct zr_arriving_v zr_lit_by_v(const struct zr_lamp *lamp, const struct zr_shading_v *s)
{
    struct zr_arriving_v arriving = zr_arriving_v(lamp, s->point, ZR_LIGHTS_PLACED);
    if (!lamp->shadow) return arriving;
    if (!ZR_LIGHTS_PLACED || !lamp->is_placed)
        arriving.share = zr_shadow_share_v(lamp->shadow, s->point, s->normal);
    else if (zr_vm_any(zr_vf_lt(zr_vf_set(0.0f), arriving.share)))
        arriving.share = arriving.share * zr_shadow_cone_share_v(lamp->shadow, s->point, s->normal);
    return arriving;
}

/* Returns the share of ambient light that reaches a surface of `albedo`: light that bounces between the walls of a
 * crease brightens it. Source: Jimenez and others, "Practical Realtime Strategies for Accurate Indirect Occlusion",
 * 2016. */
static inline zr_vf zr_bounced_v(zr_vf ao, zr_vf albedo)
{
    albedo = zr_clamp01_v(albedo);
    const zr_vf p = zr_vf_set(2.0404f) * albedo - zr_vf_set(0.3324f);
    const zr_vf q = zr_vf_set(0.6417f) - zr_vf_set(4.7951f) * albedo;
    const zr_vf s = zr_vf_set(2.7552f) * albedo + zr_vf_set(0.6903f);
    const zr_vf reaching = zr_vf_max(ao, ((ao * p + q) * ao + s) * ao);
    return ZR_MUTANT(open_beyond_1, zr_vf_min(reaching, zr_vf_set(1.0f)), reaching);
}

static inline struct zr_vec3_v zr_bounced3_v(zr_vf ao, struct zr_vec3_v albedo)
{
    return (struct zr_vec3_v){zr_bounced_v(ao, albedo.x), zr_bounced_v(ao, albedo.y), zr_bounced_v(ao, albedo.z)};
}

#endif
