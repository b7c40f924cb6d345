/* deflate.h - output: tokens -> a deflate stream (RFC 1951), block by block.
 *
 * Each block has the Huffman code that is best for its own tokens, or the format's fixed one where that is shorter,
 * as it is for a small picture. Whatever the tokens are, a block is at most ZR_DEFLATE_BOUND of the bytes it stands
 * for: the fixed code takes at most 9 bits for a byte, and a match takes at most 8 for each byte it stands for if those
 * far away stand for 6 or more.
 */
#ifndef ZR_DEFLATE_H
#define ZR_DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "output/tokens.h"

/* Room for the blocks of `size` bytes, `blocks` of them, and what ends them; the last eight bytes
 * are written over and do not count. */
#define ZR_DEFLATE_BOUND(size, blocks) ((size) + (size) / 8 + 8 * (size_t)(blocks) + 16)

struct zr_deflate {
    uint8_t *out; /* where the next byte goes; up to eight behind it are written over */
    uint64_t bits;
    unsigned bit_count; /* bits that wait for more, less than 8 between calls */
};

void zr_deflate_block(struct zr_deflate *deflate, const uint64_t *tokens, size_t count);

/* An empty stored block, behind which the next byte begins; `last`: the stream's last. */
void zr_deflate_align(struct zr_deflate *deflate, bool last);

#endif
