/* front_facing_simd.h - shade: the channel frontFacing: a word for each part. */
#ifndef ZR_FRONT_FACING_SIMD_H
#define ZR_FRONT_FACING_SIMD_H

#include "shade/shader_simd.h"
#include "shade/words_simd.h"

/* Lines have no sides, though those that are edges of a face know which of its sides is seen: colours are of that. */
static inline zr_vi zr_front_facing_words(const struct zr_shader *s, const struct zr_run *run)
{
    if (zr_draw_is_of_lines(run->draw)) return zr_vi_set(0);
    const zr_vm backs = zr_flat_backs(s->geometry, run->surface, zr_run_numbers(s, run));
    return zr_vi_select(backs, zr_vi_set(2), zr_vi_set(1));
}

#endif
