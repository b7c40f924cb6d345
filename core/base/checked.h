/* checked.h - base: size arithmetic with overflow checks. */
#ifndef ZR_CHECKED_H
#define ZR_CHECKED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Return false if the product or sum overflows; *out is then undefined. */
static inline bool zr_mul_size(uint64_t a, size_t b, size_t *out)
{
    return !__builtin_mul_overflow(a, b, out);
}

static inline bool zr_add_size(size_t a, size_t b, size_t *out)
{
    return !__builtin_add_overflow(a, b, out);
}

#endif
