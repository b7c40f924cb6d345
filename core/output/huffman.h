/* huffman.h - output: prefix codes as deflate has them. */
#ifndef ZR_HUFFMAN_H
#define ZR_HUFFMAN_H

#include <stdint.h>

enum { ZR_HUFFMAN_SYMBOLS_MAX = 288 };

/* The length of each symbol's code, at most `longest` bits (up to 15, and 2^longest no less than
 * `count`); 0 for symbols that do not occur. A single one has length 1. `count` is at most
 * ZR_HUFFMAN_SYMBOLS_MAX, the sum of the counts below 2^32. Returns how many symbols occur. */
int zr_huffman_lengths(const uint32_t *counts, int count, int longest, uint8_t *lengths);

/* The canonical codes of these lengths, first bit lowest, as deflate writes them (RFC 1951, 3.2.2). */
void zr_huffman_codes(const uint8_t *lengths, int count, uint16_t *codes);

#endif
