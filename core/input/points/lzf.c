#include "input/points/lzf.h"

#include <string.h>

enum { LITERALS_MAX = 32, LONG_COPY = 7, STEPS_PER_CANCEL_CHECK = 1 << 14 };

/* Copies `length` bytes from `distance` before; both may overlap. */
static void copy(unsigned char *out, size_t distance, size_t length)
{
    const unsigned char *from = out - distance;
    while (length-- > 0)
        *out++ = *from++;
}

bool zr_lzf_decode(const unsigned char *bytes, size_t size, unsigned char *out, size_t out_size,
                   const struct zr_cancel *cancel)
{
    const unsigned char *const end = bytes + size;
    size_t made = 0;
    for (size_t step = 0; bytes < end; step++) {
        const unsigned control = *bytes++;
        if (step % STEPS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        if (control < LITERALS_MAX) {
            const size_t length = control + 1;
            if (length > (size_t)(end - bytes) || length > out_size - made) return false;
            memcpy(out + made, bytes, length);
            bytes += length;
            made += length;
            continue;
        }
        size_t length = control >> 5;
        if (length == LONG_COPY && bytes < end) length += *bytes++;
        if (bytes == end) return false;
        const size_t distance = ((size_t)(control & 31) << 8 | *bytes++) + 1;
        length += 2;
        if (distance > made || length > out_size - made) return false;
        copy(out + made, distance, length);
        made += length;
    }
    return made == out_size;
}
