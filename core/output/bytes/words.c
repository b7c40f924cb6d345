#include "output/bytes/words.h"

#include <string.h>

bool zr_words_add(struct zr_buffer *buffer, const void *words, size_t count)
{
    const size_t begin = buffer->size;
    if (!zr_buffer_add(buffer, words, 4 * count)) return false;
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    for (unsigned char *at = buffer->bytes + begin; at < buffer->bytes + buffer->size; at += 4) {
        uint32_t word;
        memcpy(&word, at, 4);
        word = __builtin_bswap32(word);
        memcpy(at, &word, 4);
    }
#else
    (void)begin;
#endif
    return true;
}

bool zr_word_add(struct zr_buffer *buffer, uint32_t word)
{
    return zr_words_add(buffer, &word, 1);
}

bool zr_half_add(struct zr_buffer *buffer, uint32_t half)
{
    const unsigned char bytes[2] = {(unsigned char)half, (unsigned char)(half >> 8)};
    return zr_buffer_add(buffer, bytes, sizeof bytes);
}
