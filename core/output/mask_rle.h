/* mask_rle.h - output: the run lengths of a mask as COCO writes them.
 *
 * Pixels are counted column by column, each from the top. Runs of 0 and 1 alternate, and the first is of 0. From the
 * fourth run on, the difference to the run before the last is written. A number has groups of five bits, the lowest
 * first; bit 5 is set if another follows, and bit 4 of the last is its sign. A group is the character 48 + its value.
 */
#ifndef ZR_MASK_RLE_H
#define ZR_MASK_RLE_H

#include "output/bytes/bit_mask.h"
#include "output/bytes/buffer.h"

/* Returns the size of an array of edges for masks of up to `rows` rows. */
static inline size_t zr_mask_rle_edges(uint32_t rows)
{
    return 64 * ((size_t)rows + 1);
}

/* Appends the text, without a final zero. Returns false once the arena has failed. `edges` is overwritten. */
bool zr_mask_rle_write(const struct zr_bit_mask *mask, uint32_t *edges, struct zr_buffer *out);

#endif
