/* adler.h - output: Adler-32, the checksum of a zlib stream, combined from parts.
 *
 * A part has two sums modulo 65521: `a` of its bytes, and `b` of its bytes times the number of bytes from each to the
 * end. A part starts at 0; the stream's initial 1 is zr_adler_begin. Several threads can therefore sum parts, and a run
 * of zeros costs nothing.
 * Source: RFC 1950, section 9. */
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

/* Appends `size` bytes with the sum `a` and the weighted sum `b`, not reduced; b must be below 2^62. */
static inline void zr_adler_add(struct zr_adler *sum, uint64_t size, uint64_t a, uint64_t b)
{
    sum->b = (uint32_t)((sum->b + size % ZR_ADLER_PRIME * sum->a + b) % ZR_ADLER_PRIME);
    sum->a = (uint32_t)((sum->a + a) % ZR_ADLER_PRIME);
}

#endif
