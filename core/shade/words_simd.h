/* words_simd.h - shade: values that all pixels of a primitive share: flat colours and the visible side. ZR_LANES
 * primitives at a time, for kernels. */
#ifndef ZR_WORDS_SIMD_H
#define ZR_WORDS_SIMD_H

#include "base/rgba_simd.h"
#include "shade/planes_simd.h"

/* ---- colours ---- */

/* Returns which of primitives t of any draw show their backs. of_draw->backs, if present, gives the same result. */
static inline zr_vm zr_flat_backs(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw, zr_vi t)
{
    const zr_vi one = zr_vi_set(1);
    if (of_draw->backs)
        return zr_vi_eq(zr_vi_gather(ZR_ALL_LANES, of_draw->backs, t >> 5) >> (t & zr_vi_set(31)) & one, one);
    const struct zr_corner_numbers corners = zr_corner_numbers_of(of_draw->draw, ZR_RATE_DRAW, t);
    return zr_shown_backs(of_draw->draw, t, zr_turned_of(geometry->vertices, corners.vertex));
}

/* Returns the colour numbers of primitives t. Backs are numbered behind all fronts. */
static inline zr_vi zr_sided_number(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw,
                                    zr_vi t)
{
    const zr_vi number = zr_flat_number_v(of_draw->draw, of_draw->attributes[ZR_ATTRIBUTE_COLOR].rate, t);
    if (!of_draw->two_sided_colors) return number;
    const zr_vi behind = zr_vi_set((int32_t)of_draw->color_count);
    return number + zr_vi_select(zr_flat_backs(geometry, of_draw, t), behind, zr_vi_set(0));
}

/* Returns the address of a colour that is not packed. */
static inline const float *zr_flat_at(const struct zr_draw_attributes *of_draw, int32_t number)
{
    const struct zr_attribute *attributes = of_draw->attributes;
    const uint32_t n = (uint32_t)number, count = of_draw->color_count;
    return n < count ? &attributes[ZR_ATTRIBUTE_COLOR].values[n].x
                     : &attributes[ZR_ATTRIBUTE_BACK_COLOR].values[n - count].x;
}

/* Looks up colours of two-sided draws that are not packed: they lie in two arrays. */
static inline zr_vi zr_flat_look_up_sided(const struct zr_draw_attributes *of_draw, zr_vi number)
{
    int32_t numbers[ZR_LANES];
    zr_vf red, green, blue, alpha;
    zr_vi_store(numbers, number);
#define ZR_FLAT_COLOR(i) zr_flat_at(of_draw, numbers[i])
    ZR_LOAD4(red, green, blue, alpha, ZR_FLAT_COLOR);
#undef ZR_FLAT_COLOR
    (void)alpha;
    return zr_rgba_opaque_v(red, green, blue);
}

static inline zr_vi zr_flat_look_up(const struct zr_draw_attributes *of_draw, zr_vi number)
{
    zr_vf red, green, blue;
    if (of_draw->packed) return zr_vi_gather(ZR_ALL_LANES, of_draw->packed, number);
    if (of_draw->two_sided_colors) return zr_flat_look_up_sided(of_draw, number);
    zr_vf_gather_fours(&of_draw->attributes[ZR_ATTRIBUTE_COLOR].values->x, number, &red, &green, &blue);
    return zr_rgba_opaque_v(red, green, blue);
}

#endif
