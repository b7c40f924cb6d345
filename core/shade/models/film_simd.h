/* film_simd.h - shade: reflectance of surfaces under a thin film, whose colours follow from interference; for kernels.
 *
 * Light that is reflected m times in the film has the path m OPD, OPD = 2 ior thickness cos(angle in the film). Its
 * share of red, green and blue is a sum of Gaussians times cosines of OPD. Two terms are summed, as in other renderers.
 * Source: KHR_materials_iridescence; Belcour and Barla, "A Practical Extension to Microfacet Theory for the Modeling of
 * Varying Iridescence", 2017.
 */
#ifndef ZR_FILM_SIMD_H
#define ZR_FILM_SIMD_H

#include "base/simd/pow_simd.h"
#include "base/vec3_simd.h"
#include "scene/scene.h"
#include "shade/lights/tone_simd.h"

/* Returns cos(2 pi turns), within 1e-5: 1 - 2 sin(pi t)^2 of the turn's rest. */
static inline zr_vf zr_cosine_of_turns_v(zr_vf turns)
{
    const zr_vf x = (turns - zr_vf_of(zr_vi_round(turns))) * zr_vf_set(3.14159265f), z = x * x;
    const zr_vf sine =
        x * (zr_vf_set(1.0f) +
             z * (zr_vf_set(-1.0f / 6.0f) +
                  z * (zr_vf_set(1.0f / 120.0f) + z * (zr_vf_set(-1.0f / 5040.0f) + z * zr_vf_set(1.0f / 362880.0f)))));
    return zr_vf_set(1.0f) - zr_vf_set(2.0f) * sine * sine;
}

/* One Gaussian of a colour matching function: amplitude, turns per nanometre, and the exponent of 2 per nanometre^2. */
struct zr_film_gauss {
    float amplitude, turns, fall;
};

static inline zr_vf zr_film_gauss_v(struct zr_film_gauss g, zr_vf path)
{
    const zr_vf fading = zr_exp2_v(path * path * zr_vf_set(-g.fall));
    return zr_vf_set(g.amplitude) * fading * zr_cosine_of_turns_v(path * zr_vf_set(g.turns));
}

/* Returns the share of red, green and blue of light whose paths differ by `path` nanometres. */
static inline struct zr_vec3_v zr_film_colors_v(zr_vf path)
{
    /* The source's val sqrt(2 pi var) / 1.0685e-7, pos 1e-9, and var (2 pi 1e-9)^2 log2(e). */
    const zr_vf x = zr_film_gauss_v((struct zr_film_gauss){0.8465900f, 1.6810e-3f, 2.464912e-7f}, path) +
                    zr_film_gauss_v((struct zr_film_gauss){0.1538683f, 2.2399e-3f, 2.579051e-7f}, path);
    const zr_vf y = zr_film_gauss_v((struct zr_film_gauss){1.0002219f, 1.7953e-3f, 5.299464e-7f}, path);
    const zr_vf z = zr_film_gauss_v((struct zr_film_gauss){1.0011225f, 2.2084e-3f, 3.765943e-7f}, path);
#define MIXED(a, b, c) (x * zr_vf_set(a) + y * zr_vf_set(b) + z * zr_vf_set(c))
    return (struct zr_vec3_v){MIXED(3.2404542f, -1.5371385f, -0.4985314f), MIXED(-0.9692660f, 1.8760108f, 0.0415560f),
                              MIXED(0.0556434f, -0.2040259f, 1.0572252f)};
#undef MIXED
}

static inline zr_vf zr_fifth_power_v(zr_vf v)
{
    const zr_vf square = v * v;
    return square * square * v;
}

/* A film over one point: colours of both terms, cosine in the film, and reflectance of its upper side. */
struct zr_film_v {
    struct zr_vec3_v first, second;
    zr_vf ior, upper, within; /* within: (1 - cosine in the film)^5 */
    zr_vf grazing;            /* (1 - N.V)^5 */
    zr_vf share;
};

/* share: of the surface; nm: thickness. */
static inline struct zr_film_v zr_film_make(float ior, zr_vf share, zr_vf nm, zr_vf facing)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    const float root = (ior - 1.0f) / (ior + 1.0f);
    const zr_vf square_sine = zr_vf_set(1.0f / (ior * ior)) * (one - facing * facing);
    const zr_vf cosine = zr_vf_sqrt(zr_vf_max(one - square_sine, zero));
    const zr_vf path = zr_vf_set(2.0f * ior) * nm * cosine, grazing = zr_fifth_power_v(one - facing);
    return (struct zr_film_v){.first = zr_film_colors_v(path),
                              .second = zr_film_colors_v(path + path),
                              .ior = zr_vf_set(ior),
                              .upper = zr_mix_v(zr_vf_set(root * root), one, grazing),
                              .within = zr_fifth_power_v(one - cosine),
                              .grazing = grazing,
                              .share = share};
}

/* Returns the reflectance at normal incidence by which Schlick's term gives that of the film at N.V. f0: of the surface
 * below; first, second: colours of the film. */
static inline zr_vf zr_filmed_v(const struct zr_film_v *film, zr_vf f0, zr_vf first, zr_vf second)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f), most = zr_vf_set(0.9999f);
    const zr_vf amplitude = zr_vf_sqrt(zr_vf_min(zr_vf_max(f0, zero), most));
    const zr_vf ior = (one + amplitude) / (one - amplitude);
    const zr_vf ratio = (ior - film->ior) / (ior + film->ior), lower = zr_mix_v(ratio * ratio, one, film->within);
    const zr_vf both = zr_vf_min(zr_vf_max(film->upper * lower, zr_vf_set(1e-5f)), most), amplitudes = zr_vf_sqrt(both);
    const zr_vf entering = one - film->upper, several = entering * entering * lower / (one - both);
    /* The lower side turns the phase by half a wave if its index of refraction is below the film's. */
    const zr_vf sign = zr_vf_select(zr_vf_lt(ior, film->ior), one, zr_vf_set(-1.0f));
    const zr_vf of_first = zr_vf_set(2.0f) * (several - entering) * amplitudes;
    const zr_vf sum = film->upper + several + of_first * (sign * first + amplitudes * second);
    const zr_vf at_normal = (zr_clamp01_v(sum) - film->grazing) / zr_vf_max(one - film->grazing, zr_vf_set(1e-4f));
    return zr_mix_v(f0, zr_clamp01_v(at_normal), film->share);
}

static inline struct zr_vec3_v zr_filmed3_v(const struct zr_film_v *film, struct zr_vec3_v f0)
{
    return (struct zr_vec3_v){zr_filmed_v(film, f0.x, film->first.x, film->second.x),
                              zr_filmed_v(film, f0.y, film->first.y, film->second.y),
                              zr_filmed_v(film, f0.z, film->first.z, film->second.z)};
}

#endif
