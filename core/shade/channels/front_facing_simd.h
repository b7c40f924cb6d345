/* front_facing_simd.h - shade: the channel frontFacing: a word for each pixel. */
#ifndef ZR_FRONT_FACING_SIMD_H
#define ZR_FRONT_FACING_SIMD_H

#include "shade/words_simd.h"

/* Lines have no sides, though those that are edges of a face know which of its sides is seen: colours are of that. */
static inline zr_vi zr_front_facing_words(const struct zr_geometry *geometry, const struct zr_draw_attributes *surface,
                                          zr_vi numbers)
{
    if (zr_draw_is_of_wires(surface->draw)) return zr_vi_set(0);
    const zr_vm backs = zr_flat_backs(geometry, surface, numbers);
    return zr_vi_select(backs, zr_vi_set(2), zr_vi_set(1));
}

#endif
