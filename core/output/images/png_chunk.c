#include "output/images/png_chunk.h"

#include <isa-l/crc.h>

#include "base/isa.h"

enum { WORD = 4 };

static void set_word(unsigned char *at, uint32_t word)
{
    for (int i = 0; i < WORD; i++)
        at[i] = (unsigned char)(word >> (24 - 8 * i));
}

void zr_png_put_word(struct zr_buffer *out, uint32_t word)
{
    unsigned char bytes[WORD];
    set_word(bytes, word);
    zr_buffer_add(out, bytes, sizeof bytes);
}

size_t zr_png_chunk_begin(struct zr_buffer *out, const char *type)
{
    const size_t at = out->size;
    zr_png_put_word(out, 0);
    zr_buffer_add(out, type, WORD);
    return at;
}

bool zr_png_chunk_end(struct zr_buffer *out, size_t at)
{
    if (!zr_arena_ok(out->arena)) return false;
    const size_t size = out->size - at - 2 * WORD;
    set_word(out->bytes + at, (uint32_t)size);
    const uint32_t crc = crc32_gzip_refl(0, out->bytes + at + WORD, WORD + size);
    zr_isa_clear_upper_halves();
    zr_png_put_word(out, crc);
    return zr_arena_ok(out->arena);
}
