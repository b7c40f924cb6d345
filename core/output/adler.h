/* adler.h - output: the check sum at the end of a zlib stream, put together from parts.
 *
 * The sum of the bytes (`a`), and of the bytes times how many are left from each on (`b`), both
 * modulo 65521, of a part that stands for itself: they begin at 0, and the stream's own 1 is
 * zr_adler_begin. So parts can be summed by several threads, and a run of zeros costs nothing.
 * Source: RFC 1950, section 9.
 */
#ifndef ZR_ADLER_H
#define ZR_ADLER_H

#include <stddef.h>
#include <stdint.h>

enum { ZR_ADLER_PRIME = 65521 };

struct zr_adler {
    uint32_t a, b;
};

static inline struct zr_adler zr_adler_begin(void)
{
    return (struct zr_adler){1, 0};
}

/* `size` bytes behind what was summed, of which `a` is the sum and `b` the weighted one, not
 * reduced; b below 2^62. */
static inline void zr_adler_add(struct zr_adler *sum, uint64_t size, uint64_t a, uint64_t b)
{
    sum->b = (uint32_t)((sum->b + size % ZR_ADLER_PRIME * sum->a + b) % ZR_ADLER_PRIME);
    sum->a = (uint32_t)((sum->a + a) % ZR_ADLER_PRIME);
}

#endif
