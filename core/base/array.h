/* array.h - base: an array of numbers, as in numpy: C order, the machine's byte order. */
#ifndef ZR_ARRAY_H
#define ZR_ARRAY_H

#include <stdint.h>

#include "base/checked.h"

/* Types of numbers, as in zraster.h. ZR_BYTES: no numbers, but the bytes of a file. */
enum zr_number_type { ZR_BYTES, ZR_F4, ZR_F8, ZR_U1, ZR_I4, ZR_U4, ZR_I8, ZR_U8, ZR_NUMBER_TYPES };

enum { ZR_ARRAY_SIDES_MAX = 4 };

struct zr_array {
    const void *data; /* any alignment */
    enum zr_number_type type;
    size_t ndim; /* 1 to ZR_ARRAY_SIDES_MAX */
    size_t shape[ZR_ARRAY_SIDES_MAX];
};

/* Returns numpy's name of a type, "f4"; its last character is the number of bytes. */
static inline const char *zr_number_name(enum zr_number_type type)
{
    static const char *const names[ZR_NUMBER_TYPES] = {"bytes", "f4", "f8", "u1", "i4", "u4", "i8", "u8"};
    return names[type];
}

static inline size_t zr_number_bytes(enum zr_number_type type)
{
    return type == ZR_BYTES ? 1 : (size_t)(zr_number_name(type)[1] - '0');
}

/* Computes the bytes of the data. False if the product overflows. */
static inline bool zr_array_bytes(const struct zr_array *array, size_t *bytes)
{
    *bytes = zr_number_bytes(array->type);
    for (size_t i = 0; i < array->ndim; i++)
        if (!zr_mul_size(*bytes, array->shape[i], bytes)) return false;
    return true;
}

#endif
