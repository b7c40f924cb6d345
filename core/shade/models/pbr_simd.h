/* pbr_simd.h - shade: metals and plastics by base colour, metallic factor and roughness, for kernels.
 *
 * Metals:  the colour is (1 - m) plastic + m metal, for the metallic factor m, and each keeps its own energy (glTF 2.0,
 *          appendix B). The metal has F0 = base colour, F90 = 1 and no diffuse part. The diffuse part of the plastic
 *          gets what its surface does not reflect, by the largest channel of its reflectance.
 * Lamps:   glTF 2.0, appendix B: Lambert's diffuse term, and GGX's specular term with height-correlated Smith and
 *          Schlick. A lamp of colour 1 has the irradiance pi at normal incidence.
 * Ambient: the split sum (dfg.h), and light that bounces between the microfacets, so that no energy is lost: Fss = F0 A
 *          + F90 B, Ems = 1 - A - B, Favg = F0 + (F90 - F0) / 21, Fms = Fss Favg / (1 - Ems Favg). The metal is Fss
 *          L(R) + Fms Ems E(N), the plastic Fss L(R) + (Fms Ems + c (1 - Fss - Fms Ems)) E(N).
 * Anisotropic (with a finish): alpha is 1 along the direction at strength 1. Mirrored directions follow from the normal
 *          bent towards the eye, around the bitangent (KHR_materials_anisotropy; Revie, "Implementing Fur Using
 *          Deferred Shading", 2012). D and V: Burley, "Physically Based Shading at Disney", 2012.
 * Source:  Fdez-Aguera, "A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting", 2019.
 */
#ifndef ZR_PBR_SIMD_H
#define ZR_PBR_SIMD_H

#include "base/inlined.h"
#include "shade/lights/dfg.h"
#include "shade/models/film_simd.h"
#include "shade/models/linear_simd.h"

/* The table at one roughness. Each column has A, B and their differences to the next column, so that a lane needs one
 * load. The last column serves only as the end of the one before. */
struct zr_dfg_columns {
    float roughness;
    _Alignas(16) float fours[ZR_DFG_SIDE - 1][4];
};

static inline void zr_dfg_columns_make(struct zr_dfg_columns *out, float roughness)
{
    const float row = roughness * (float)(ZR_DFG_SIDE - 1);
    const int low = row < (float)(ZR_DFG_SIDE - 2) ? (int)row : ZR_DFG_SIDE - 2;
    const float share = row - (float)low;
    float values[2][ZR_DFG_SIDE];
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < ZR_DFG_SIDE; i++)
            values[k][i] = zr_dfg_table[low][k][i] + (zr_dfg_table[low + 1][k][i] - zr_dfg_table[low][k][i]) * share;
    out->roughness = roughness;
    for (int i = 0; i + 1 < ZR_DFG_SIDE; i++)
        for (int k = 0; k < 2; k++) {
            out->fours[i][2 * k] = values[k][i];
            out->fours[i][2 * k + 1] = values[k][i + 1] - values[k][i];
        }
}

static inline void zr_dfg_at_v(const struct zr_dfg_columns *columns, zr_vf facing, zr_vf *a, zr_vf *b)
{
    const zr_vf column = zr_vf_sqrt(facing) * zr_vf_set((float)(ZR_DFG_SIDE - 1)), half = zr_vf_set(0.5f);
    const zr_vi last = zr_vi_set(ZR_DFG_SIDE - 2);
    const zr_vi low = zr_vi_min(zr_vi_max(zr_vi_round(column - half), zr_vi_set(0)), last);
    const zr_vf share = column - zr_vf_of(low);
    int32_t each[ZR_LANES];
    zr_vf more_a, more_b;
    zr_vi_store(each, low);
#define ZR_FOUR(lane) (columns->fours[each[lane]])
    ZR_LOAD4(*a, more_a, *b, more_b, ZR_FOUR);
#undef ZR_FOUR
    *a = *a + more_a * share;
    *b = *b + more_b * share;
}

/* Looks up A and B at each lane's own roughness. */
static inline void zr_dfg_at_each_v(zr_vf roughness, zr_vf facing, zr_vf *a, zr_vf *b)
{
    const zr_vf side = zr_vf_set((float)(ZR_DFG_SIDE - 1)), half = zr_vf_set(0.5f);
    const zr_vf row = roughness * side, column = zr_vf_sqrt(facing) * side;
    const zr_vi none = zr_vi_set(0), last = zr_vi_set(ZR_DFG_SIDE - 2), next = zr_vi_set(2 * ZR_DFG_SIDE);
    const zr_vi i = zr_vi_min(zr_vi_max(zr_vi_round(row - half), none), last);
    const zr_vi j = zr_vi_min(zr_vi_max(zr_vi_round(column - half), none), last);
    const zr_vf down = row - zr_vf_of(i), right = column - zr_vf_of(j);
    zr_vf *const out[2] = {a, b};
    for (int k = 0; k < 2; k++) {
        const zr_vi at = i * next + zr_vi_set(k * ZR_DFG_SIDE) + j;
        zr_vf corners[2][2];
        for (int c = 0; c < 4; c++)
            corners[c / 2][c % 2] =
                zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, zr_dfg_table, at + zr_vi_set(c / 2 * 2 * ZR_DFG_SIDE + c % 2)));
        const zr_vf left_of = zr_mix_v(corners[0][0], corners[1][0], down),
                    right_of = zr_mix_v(corners[0][1], corners[1][1], down);
        *out[k] = zr_mix_v(left_of, right_of, right);
    }
}

/* Least alpha for lamps: a smoother surface would hardly ever reflect a lamp, which has no size. */
#define ZR_LAMP_ALPHA_LEAST 0.06f

/* Reflection properties of a surface. */
struct zr_pbr_v {
    struct zr_vec3_v diffuse, f0; /* base (1 - metallic); reflectance at normal incidence */
    zr_vf f90;                    /* reflectance at grazing incidence */
    zr_vf metallic;
    float plastic_f0, plastic_f90; /* the plastic's largest reflectance at normal incidence, and at grazing incidence */
    zr_vf facing;                  /* N.V, above 0 */
    float alpha;                   /* of untextured surfaces */
    zr_vf alphas;                  /* of textured ones, per lane */
    /* With ZR_FINISHES only: reflectance of the metal, and plastic_f0 per lane. */
    struct zr_vec3_v metal_f0;
    zr_vf finished_f0;
    bool is_anisotropic;
    struct zr_vec3_v along, bitangent;
    zr_vf alpha_along, bend;
};

static inline float zr_largest_of(zr_vec3 v)
{
    const float most = v.x > v.y ? v.x : v.y;
    return most > v.z ? most : v.z;
}

/* Sets the bitangent and the roughness along the direction of anisotropy. Without a direction, the bitangent is 0. */
static inline void zr_pbr_put_anisotropy(const struct zr_shading_v *s, struct zr_pbr_v *pbr)
{
    const struct zr_vec3_v along = s->textured->along;
    const zr_vm any = zr_vf_lt(zr_vf_set(0.5f), zr_dot_v(along, along));
    const zr_vf strength = zr_vf_select(any, s->textured->anisotropy, zr_vf_set(0.0f));
    const zr_vf one = zr_vf_set(1.0f), kept = one - strength * (one - s->textured->roughness), square = kept * kept;
    pbr->is_anisotropic = true;
    pbr->bend = one - square * square;
    pbr->along = along;
    pbr->bitangent = zr_normalize_v(zr_cross_v(s->normal, along));
    pbr->alpha_along = zr_mix_v(pbr->alphas, one, strength * strength);
}

/* Puts the material's film on the surface, and takes the light that passes through from the diffuse part. */
static inline void zr_pbr_finish(const struct zr_material *material, const struct zr_shading_v *s, struct zr_pbr_v *pbr)
{
    const struct zr_finish *finish = &material->finish;
    struct zr_vec3_v plastic = zr_spread_v(material->reflectance);
    pbr->metal_f0 = s->base;
    if (finish->film > 0.0f) {
        const struct zr_film_v film =
            zr_film_make(finish->film_ior, s->textured->film, s->textured->film_nm, pbr->facing);
        plastic = zr_filmed3_v(&film, plastic);
        pbr->metal_f0 = zr_filmed3_v(&film, s->base);
        pbr->f0 = zr_mix3_v(plastic, pbr->metal_f0, pbr->metallic);
    }
    if (finish->anisotropy > 0.0f) zr_pbr_put_anisotropy(s, pbr);
    pbr->finished_f0 = zr_vf_max(plastic.x, zr_vf_max(plastic.y, plastic.z));
    if (zr_material_is_glass(material))
        pbr->diffuse = zr_scale_v(pbr->diffuse, zr_vf_set(1.0f) - s->textured->transmission);
}

/* Returns plastic_f0 per lane. */
static inline zr_vf zr_plastic_f0_v(const struct zr_pbr_v *pbr)
{
    return ZR_FINISHES ? pbr->finished_f0 : zr_vf_set(pbr->plastic_f0);
}

static inline struct zr_pbr_v zr_pbr_make(const struct zr_material *material, const struct zr_shading_v *s)
{
    const zr_vf one = zr_vf_set(1.0f), grazing = zr_vf_set(material->grazing);
    const zr_vf metallic = s->textured ? s->textured->metallic : zr_vf_set(material->metallic);
    const struct zr_vec3_v dielectric = zr_spread_v(material->reflectance);
    struct zr_pbr_v pbr = {.diffuse =
                               zr_scale_v(s->base, s->textured ? one - metallic : zr_vf_set(1.0f - material->metallic)),
                           .f0 = zr_mix3_v(dielectric, s->base, metallic),
                           .f90 = zr_mix_v(grazing, one, metallic),
                           .facing = zr_vf_min(zr_vf_max(zr_dot_v(s->normal, s->to_eye), zr_vf_set(1e-4f)), one),
                           .metallic = metallic,
                           .plastic_f0 = zr_largest_of(material->reflectance),
                           .plastic_f90 = material->grazing,
                           .alpha = material->roughness * material->roughness};
    if (s->textured) pbr.alphas = s->textured->roughness * s->textured->roughness;
    if (ZR_FINISHES) zr_pbr_finish(material, s, &pbr);
    return pbr;
}

/* ---- ambient light ---- */

struct zr_ambient_v {
    struct zr_vec3_v diffuse, specular; /* E(N) and L(R) */
};

/* Fss and Ems Favg of one reflectance; Fms Ems is Fss scattered / (1 - scattered). */
struct zr_bounces_v {
    zr_vf once, scattered;
};

static inline struct zr_bounces_v zr_bounces_of_v(zr_vf f0, zr_vf f90, zr_vf a, zr_vf b)
{
    const zr_vf average = f0 + (f90 - f0) * zr_vf_set(1.0f / 21.0f), lost = zr_vf_set(1.0f) - a - b;
    return (struct zr_bounces_v){f0 * a + f90 * b, ZR_MUTANT(bounces_once, lost * average, zr_vf_set(0.0f))};
}

/* Sets out[i] to Fms Ems, with one division for all. */
static inline void zr_bounced_again_v(const struct zr_bounces_v bounces[4], zr_vf out[4])
{
    const zr_vf one = zr_vf_set(1.0f);
    zr_vf rest[4];
    for (int i = 0; i < 4; i++)
        rest[i] = one - bounces[i].scattered;
    const zr_vf low = rest[0] * rest[1], high = rest[2] * rest[3], inverse = one / (low * high);
    const zr_vf over_low = inverse * high, over_high = inverse * low;
    const zr_vf over[4] = {over_low * rest[1], over_low * rest[0], over_high * rest[3], over_high * rest[2]};
    for (int i = 0; i < 4; i++)
        out[i] = bounces[i].once * bounces[i].scattered * over[i];
}

/* Returns the normal that mirrors: bent towards the eye if the surface is anisotropic. */
static inline struct zr_vec3_v zr_mirroring_normal_v(const struct zr_pbr_v *pbr, const struct zr_shading_v *s)
{
    if (!ZR_FINISHES || !pbr->is_anisotropic) return s->normal;
    const struct zr_vec3_v b = pbr->bitangent, towards = zr_normalize_v(zr_cross_v(zr_cross_v(b, s->to_eye), b));
    return zr_normalize_v(zr_mix3_v(s->normal, towards, pbr->bend));
}

/* Returns the reflected ambient light. base: F0 of the metal. `ambient`: E and L, both as they reach the surface. */
static inline struct zr_vec3_v zr_pbr_ambient_v(const struct zr_pbr_v *pbr, struct zr_vec3_v base, zr_vf a, zr_vf b,
                                                const struct zr_ambient_v *ambient)
{
    const zr_vf one = zr_vf_set(1.0f), matte = one - pbr->metallic;
    const struct zr_bounces_v bounces[4] = {zr_bounces_of_v(base.x, one, a, b), zr_bounces_of_v(base.y, one, a, b),
                                            zr_bounces_of_v(base.z, one, a, b),
                                            zr_bounces_of_v(zr_plastic_f0_v(pbr), zr_vf_set(pbr->plastic_f90), a, b)};
    zr_vf again[4];
    zr_bounced_again_v(bounces, again);
    const zr_vf entering = one - bounces[3].once - again[3], of_plastic = matte * again[3];
    const struct zr_vec3_v soft = {pbr->metallic * again[0] + of_plastic + pbr->diffuse.x * entering,
                                   pbr->metallic * again[1] + of_plastic + pbr->diffuse.y * entering,
                                   pbr->metallic * again[2] + of_plastic + pbr->diffuse.z * entering};
    const zr_vf grazing = pbr->f90 * b;
    const struct zr_vec3_v once = {pbr->f0.x * a + grazing, pbr->f0.y * a + grazing, pbr->f0.z * a + grazing};
    return zr_add_v(zr_mul_v(once, ambient->specular), zr_mul_v(soft, ambient->diffuse));
}

static inline struct zr_vec3_v zr_to_environment_v(const struct zr_linear_lighting *lighting, struct zr_vec3_v v)
{
    const zr_vec3 *rows = lighting->eye_to_environment;
    if (ZR_MUTANT(environment_not_turned, false, true)) return v;
    return (struct zr_vec3_v){zr_dot_v(zr_spread_v(rows[0]), v), zr_dot_v(zr_spread_v(rows[1]), v),
                              zr_dot_v(zr_spread_v(rows[2]), v)};
}

/* Returns the direction of an environment at a finite distance: normalize(d + near from_middle). */
static inline struct zr_vec3_v zr_seen_near_v(struct zr_vec3_v d, struct zr_vec3_v from_middle, float near)
{
    return zr_normalize_v(zr_add_v(d, zr_scale_v(from_middle, zr_vf_set(near))));
}

static inline struct zr_ambient_v zr_pbr_gather_v(const struct zr_linear_lighting *lighting, const struct zr_pbr_v *pbr,
                                                  const struct zr_shading_v *s)
{
    const struct zr_vec3_v normal = zr_mirroring_normal_v(pbr, s);
    const zr_vf twice = zr_vf_set(2.0f) * zr_dot_v(normal, s->to_eye);
    const struct zr_vec3_v mirrored = zr_minus_v(zr_scale_v(normal, twice), s->to_eye);
    struct zr_ambient_v out = {zr_spread_v(lighting->lights.ambient), zr_spread_v(lighting->lights.ambient)};
    if (lighting->has_environment) {
        const struct zr_environment_light *light = &lighting->environment;
        const zr_vf intensity = zr_vf_set(lighting->environment_intensity);
        const float near = ZR_MUTANT(environment_far, lighting->nearness, 0.0f);
        struct zr_vec3_v seen = s->normal, seen_mirrored = mirrored;
        if (near > 0.0f) {
            const struct zr_vec3_v from_middle = zr_minus_v(s->point, zr_spread_v(lighting->middle));
            seen = zr_seen_near_v(seen, from_middle, ZR_MUTANT(near_as_mirrored, 0.5f * near, near));
            seen_mirrored = zr_seen_near_v(mirrored, from_middle, near);
        }
        const struct zr_vec3_v n = zr_to_environment_v(lighting, seen),
                               r = zr_to_environment_v(lighting, seen_mirrored);
        out.diffuse = zr_add_v(out.diffuse, zr_scale_v(zr_environment_diffuse_v(light, n), intensity));
        const struct zr_gathering_v gathering =
            s->textured ? zr_gathering_of_each(pbr->alphas) : zr_gathering_of(pbr->alpha);
        out.specular = zr_add_v(out.specular, zr_scale_v(zr_environment_gathered_v(light, r, &gathering), intensity));
    }
    for (uint32_t i = 0; i < lighting->lights.count; i++) {
        const struct zr_lamp *lamp = &lighting->lights.lamps[i];
        if (!lamp->lights_pbr || !lamp->is_hemisphere) continue;
        out.diffuse = zr_add_v(out.diffuse, zr_hemisphere_v(lamp, s->normal));
        out.specular = zr_add_v(out.specular, zr_hemisphere_v(lamp, mirrored));
    }
    return out;
}

ZR_INLINED struct zr_vec3_v zr_pbr_from_ambient_v(const struct zr_linear_lighting *lighting,
                                                  const struct zr_dfg_columns *columns, const struct zr_pbr_v *pbr,
                                                  const struct zr_shading_v *s)
{
    struct zr_ambient_v ambient = zr_pbr_gather_v(lighting, pbr, s);
    zr_vf a, b;
    ambient.diffuse = zr_mul_v(ambient.diffuse, zr_bounced3_v(s->ao, zr_add_v(pbr->diffuse, pbr->f0)));
    ambient.specular = zr_scale_v(ambient.specular, s->ao);
    if (s->textured) {
        ambient.diffuse = zr_scale_v(ambient.diffuse, s->textured->occlusion);
        ambient.specular = zr_scale_v(ambient.specular, s->textured->occlusion);
        zr_dfg_at_each_v(s->textured->roughness, pbr->facing, &a, &b);
    } else {
        zr_dfg_at_v(columns, pbr->facing, &a, &b);
    }
    return zr_pbr_ambient_v(pbr, ZR_FINISHES ? pbr->metal_f0 : s->base, a, b, &ambient);
}

/* ---- lamps ---- */

/* Returns the squared sine between unit vectors. 1 - cosine^2 would lose its digits if it is small. */
static inline zr_vf zr_square_sine_v(struct zr_vec3_v a, struct zr_vec3_v b)
{
    const struct zr_vec3_v c = zr_cross_v(a, b);
    return zr_dot_v(c, c);
}

/* Below every spread of a unit vector H. With light from straight behind, H is not a unit vector. */
#define ZR_GGX_SPREAD_LEAST 1e-6f

/* Returns pi D V, or 0 if N.H <= 0. Inputs: alpha^2, 1 - alpha^2, N.H, 1 - (N.H)^2, N.V and N.L. */
static inline zr_vf zr_ggx_v(zr_vf square, zr_vf rest, zr_vf nh, zr_vf square_sine, zr_vf nv, zr_vf nl)
{
    const zr_vf spread = zr_vf_max(square_sine + nh * nh * square, zr_vf_set(ZR_GGX_SPREAD_LEAST));
    const zr_vf smith = nl * zr_vf_sqrt(nv * nv * rest + square) + nv * zr_vf_sqrt(nl * nl * rest + square);
    const zr_vf reflected = square / (spread * spread) * zr_vf_set(0.5f) / smith, zero = zr_vf_set(0.0f);
    return zr_vf_select(ZR_MUTANT(ggx_from_behind, zr_vf_lt(zero, nh), ZR_ALL_LANES), reflected, zero);
}

/* Returns pi D V of an anisotropic surface, or 0 if N.H <= 0. */
static inline zr_vf zr_ggx_along_v(const struct zr_pbr_v *pbr, struct zr_vec3_v to_eye, struct zr_vec3_v to_light,
                                   struct zr_vec3_v half, zr_vf nh, zr_vf nl)
{
    const zr_vf least = zr_vf_set(ZR_LAMP_ALPHA_LEAST), zero = zr_vf_set(0.0f);
    const zr_vf along = zr_vf_max(pbr->alpha_along, least), across = zr_vf_max(pbr->alphas, least);
    const zr_vf both = along * across, nv = pbr->facing;
    const zr_vf x = across * zr_dot_v(pbr->along, half), y = along * zr_dot_v(pbr->bitangent, half), z = both * nh;
    const zr_vf w = both / zr_vf_max(x * x + y * y + z * z, zr_vf_set(1e-12f));
    const zr_vf vx = along * zr_dot_v(pbr->along, to_eye), vy = across * zr_dot_v(pbr->bitangent, to_eye);
    const zr_vf lx = along * zr_dot_v(pbr->along, to_light), ly = across * zr_dot_v(pbr->bitangent, to_light);
    const zr_vf smith = nl * zr_vf_sqrt(vx * vx + vy * vy + nv * nv) + nv * zr_vf_sqrt(lx * lx + ly * ly + nl * nl);
    return zr_vf_select(zr_vf_lt(zero, nh), both * w * w * (zr_vf_set(0.5f) / smith), zero);
}

static inline zr_vf zr_schlick_v(zr_vf f0, zr_vf f90, zr_vf fresnel)
{
    return f0 + (f90 - f0) * fresnel;
}

/* Returns the reflected light of a lamp of which `share` arrives; `to_light` is a unit vector. */
static inline struct zr_vec3_v zr_pbr_from_v(struct zr_vec3_v to_light, zr_vec3 color, zr_vf share,
                                             const struct zr_pbr_v *pbr, const struct zr_shading_v *s)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    const struct zr_vec3_v half = zr_normalize_v(zr_add_v(to_light, s->to_eye));
    const zr_vf nl = zr_vf_max(zr_dot_v(s->normal, to_light), zero);
    const zr_vf nh = zr_clamp01_v(zr_dot_v(s->normal, half)), vh = zr_clamp01_v(zr_dot_v(s->to_eye, half));
    const float alpha = pbr->alpha > ZR_LAMP_ALPHA_LEAST ? pbr->alpha : ZR_LAMP_ALPHA_LEAST;
    zr_vf square_alpha = zr_vf_set(alpha * alpha), rest = zr_vf_set(1.0f - alpha * alpha);
    if (s->textured) {
        const zr_vf alphas = zr_vf_max(pbr->alphas, zr_vf_set(ZR_LAMP_ALPHA_LEAST));
        square_alpha = alphas * alphas;
        rest = one - square_alpha;
    }
    const zr_vf lit = zr_vf_max(nl, zr_vf_set(1e-6f));
    zr_vf specular = zr_ggx_v(square_alpha, rest, nh, zr_square_sine_v(s->normal, half), pbr->facing, lit);
    if (ZR_FINISHES && pbr->is_anisotropic)
        specular = zr_vf_select(zr_vf_lt(zr_vf_set(0.5f), zr_dot_v(pbr->along, pbr->along)),
                                zr_ggx_along_v(pbr, s->to_eye, to_light, half, nh, lit), specular);
    const zr_vf away = one - vh, square = away * away;
    const zr_vf fresnel = ZR_MUTANT(fresnel_of_4th_power, square * square * away, square * square);
    const zr_vf entering = one - zr_schlick_v(zr_plastic_f0_v(pbr), zr_vf_set(pbr->plastic_f90), fresnel);
    const struct zr_vec3_v f = {zr_schlick_v(pbr->f0.x, pbr->f90, fresnel), zr_schlick_v(pbr->f0.y, pbr->f90, fresnel),
                                zr_schlick_v(pbr->f0.z, pbr->f90, fresnel)};
    const struct zr_vec3_v reflected = zr_add_v(zr_scale_v(f, specular), zr_scale_v(pbr->diffuse, entering));
    return zr_scale_v(zr_mul_v(zr_spread_v(color), reflected), nl * share);
}

static inline struct zr_vec3_v zr_pbr_from_lamp_v(const struct zr_lamp *lamp, const struct zr_pbr_v *pbr,
                                                  const struct zr_shading_v *s)
{
    const struct zr_arriving_v arriving = zr_lit_by_v(lamp, s);
    return zr_pbr_from_v(arriving.to_light, lamp->color, arriving.share, pbr, s);
}

/* ---- all ---- */

/* Shades samples of one material. `columns` are used for untextured samples. */
ZR_INLINED struct zr_vec3_v zr_shade_pbr_v(const struct zr_linear_lighting *lighting,
                                           const struct zr_material *material, const struct zr_dfg_columns *columns,
                                           const struct zr_shading_v *s)
{
    const struct zr_pbr_v pbr = zr_pbr_make(material, s);
    struct zr_vec3_v emissive = zr_spread_v(material->emissive);
    if (s->textured) emissive = zr_mul_v(emissive, s->textured->emissive);
    struct zr_vec3_v sum = zr_add_v(zr_pbr_from_ambient_v(lighting, columns, &pbr, s), emissive);
    for (uint32_t i = 0; i < lighting->lights.count; i++) {
        const struct zr_lamp *lamp = &lighting->lights.lamps[i];
        if (lamp->lights_pbr && !lamp->is_hemisphere) sum = zr_add_v(sum, zr_pbr_from_lamp_v(lamp, &pbr, s));
    }
    return sum;
}

#endif
