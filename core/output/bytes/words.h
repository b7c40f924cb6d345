/* words.h - output: numbers of two or four bytes, little-endian on every machine. */
#ifndef ZR_WORDS_H
#define ZR_WORDS_H

#include <stdint.h>

#include "output/bytes/buffer.h"

/* Append `count` words of four bytes, or one number. Return false once the arena has failed. */
bool zr_words_add(struct zr_buffer *buffer, const void *words, size_t count);
bool zr_word_add(struct zr_buffer *buffer, uint32_t word);
bool zr_half_add(struct zr_buffer *buffer, uint32_t half);

#endif
