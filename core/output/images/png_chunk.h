/* png_chunk.h - output: chunks of a PNG that is written without libpng.
 *
 * Source: W3C, PNG (Third Edition), 5.3: length, type, data, and a check sum of type and data.
 */
#ifndef ZR_PNG_CHUNK_H
#define ZR_PNG_CHUNK_H

#include <stdint.h>

#include "output/bytes/buffer.h"

/* Appends a word, the highest byte first. */
void zr_png_put_word(struct zr_buffer *out, uint32_t word);

/* Appends the head of a chunk, whose data the caller appends. Returns its place. */
size_t zr_png_chunk_begin(struct zr_buffer *out, const char *type);

/* Ends the chunk that begins at `at`. Returns false once the arena has failed. */
bool zr_png_chunk_end(struct zr_buffer *out, size_t at);

#endif
