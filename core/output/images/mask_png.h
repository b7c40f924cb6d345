/* mask_png.h - output: writes a mask as a PNG of 8 bits, black and white.
 *
 * Time grows with the edges of the mask, not with its pixels: each run of equal pixels is a literal and repetitions, in
 * one deflate block with fixed codes for runs.
 * Source: W3C, PNG (Third Edition), 5 and 11.2; RFC 1950; RFC 1951, 3.2.
 */
#ifndef ZR_MASK_PNG_H
#define ZR_MASK_PNG_H

#include "output/bytes/bit_mask.h"
#include "output/bytes/buffer.h"

/* Appends the file: 255 for bits of 1, else 0. Returns false once the arena has failed. */
bool zr_mask_png_write(const struct zr_bit_mask *mask, struct zr_buffer *out);

#endif
