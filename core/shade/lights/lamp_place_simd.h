/* lamp_place_simd.h - shade: light that arrives from a lamp with a position (lamp.h), at ZR_LANES points, for
 * kernels.
 *
 * Exact:  without range and cone, equal to the last bit to Mesa's fixed functions with the attenuation 0, 0, 1.
 */
#ifndef ZR_LAMP_PLACE_SIMD_H
#define ZR_LAMP_PLACE_SIMD_H

#include "base/mutant.h"
#include "base/vec3_simd.h"
#include "shade/lights/light.h"

struct zr_arriving_v {
    struct zr_vec3_v to_light; /* unit */
    zr_vf share;               /* share of the lamp's colour, 0 or more */
};

static inline zr_vf zr_within_1_v(zr_vf v)
{
    return zr_vf_min(zr_vf_max(v, zr_vf_set(0.0f)), zr_vf_set(1.0f));
}

/* Returns the light that arrives at `point`, in the space of lamp.h. */
static inline struct zr_arriving_v zr_arriving_from_v(const struct zr_lamp_place *lamp, struct zr_vec3_v point)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    const struct zr_vec3_v to_lamp = zr_minus_v(zr_spread_v(lamp->position), point), unit = zr_normalize_v(to_lamp);
    const zr_vf square = zr_dot_v(to_lamp, to_lamp);
    /* Nothing arrives at the lamp's own position, which has no direction to it. */
    const zr_vm reached = zr_vm_and(zr_vf_lt(zero, square), zr_vf_lt(square, zr_vf_set(ZR_LAMP_FAR)));
    const zr_vf near = zr_vf_max(square, zr_vf_set(lamp->least)), of_range = square * zr_vf_set(lamp->end);
    const zr_vf window = zr_within_1_v(one - ZR_MUTANT(range_of_2nd_power, of_range * of_range, of_range));
    const zr_vf cosine = zr_dot_v(unit, zr_spread_v(lamp->axis));
    const zr_vf cone = zr_within_1_v(cosine * zr_vf_set(lamp->angle_scale) + zr_vf_set(lamp->angle_offset));
    const zr_vf fall =
        ZR_MUTANT(falls_off_by_distance, zr_vf_set(lamp->gain) / near, zr_vf_set(lamp->gain) / zr_vf_sqrt(near));
    const zr_vf share = (fall * window) * ZR_MUTANT(cone_not_squared, cone * cone, cone);
    const struct zr_vec3_v some = {zero, zero, one};
    return (struct zr_arriving_v){zr_choose_v(reached, unit, some), zr_vf_select(reached, share, zero)};
}

/* Returns the light that arrives from a lamp. `placed`, a constant: it may have a position. */
static inline __attribute__((always_inline)) struct zr_arriving_v zr_arriving_v(const struct zr_lamp *lamp,
                                                                                struct zr_vec3_v point, bool placed)
{
    if (placed && lamp->is_placed) return zr_arriving_from_v(&lamp->place, point);
    return (struct zr_arriving_v){zr_spread_v(lamp->to_light), zr_vf_set(1.0f)};
}

#endif
