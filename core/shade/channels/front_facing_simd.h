/* front_facing_simd.h - shade: the channel frontFacing: a word per pixel. */
#ifndef ZR_FRONT_FACING_SIMD_H
#define ZR_FRONT_FACING_SIMD_H

#include "shade/words_simd.h"

/* Returns 1 for fronts, 2 for backs and 0 for lines. Edges of faces get 0, too, though their colour depends on the
 * visible side of their face. */
static inline zr_vi zr_front_facing_words(const struct zr_geometry *geometry, const struct zr_draw_attributes *of_draw,
                                          zr_vi numbers)
{
    if (zr_draw_is_of_wires(of_draw->draw)) return zr_vi_set(0);
    const zr_vm backs = zr_flat_backs(geometry, of_draw, numbers);
    return zr_vi_select(backs, zr_vi_set(2), zr_vi_set(1));
}

#endif
