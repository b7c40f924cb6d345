/* checked.h - base: sizes are multiplied and added here, or not at all. */
#ifndef ZR_CHECKED_H
#define ZR_CHECKED_H

#include <stdbool.h>
#include <stddef.h>

/* False where the product or sum does not fit; *out is then undefined. */
static inline bool zr_mul_size(size_t a, size_t b, size_t *out)
{
    return !__builtin_mul_overflow(a, b, out);
}

static inline bool zr_add_size(size_t a, size_t b, size_t *out)
{
    return !__builtin_add_overflow(a, b, out);
}

#endif
