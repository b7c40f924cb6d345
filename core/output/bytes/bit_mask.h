/* bit_mask.h - output: a mask of a window, one bit per pixel, for the files of masks. */
#ifndef ZR_BIT_MASK_H
#define ZR_BIT_MASK_H

#include <stddef.h>
#include <stdint.h>

/* Pixels outside of the rows and words are 0. Bit k of word i of a row is column left + 64 i + k. */
struct zr_bit_mask {
    uint32_t width, height; /* of the window */
    uint32_t top, bottom;   /* rows top .. bottom - 1 have bits */
    uint32_t left, words;   /* left: a multiple of 64 */
    const uint64_t *bits;
};

/* Returns the words of a row; NULL: it has none. */
static inline const uint64_t *zr_bit_mask_row(const struct zr_bit_mask *mask, uint32_t y)
{
    return y < mask->top || y >= mask->bottom ? NULL : mask->bits + (uint64_t)(y - mask->top) * mask->words;
}

#endif
