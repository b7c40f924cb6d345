#include "scene/parts/part_colors.h"

#include <stdbool.h>
#include <string.h>

#include "base/hash.h"

#define RGB(hex)                                                                                                       \
    {                                                                                                                  \
        (float)((hex) >> 16 & 255) / 255.0f, (float)((hex) >> 8 & 255) / 255.0f, (float)((hex)&255) / 255.0f, 1        \
    }

/* Three rows of seven hues: plain, mixed with 45 % of white, and darkened to 60 %. */
const zr_vec4 zr_part_colors[ZR_PART_COLORS] = {
    RGB(0xe69f00), RGB(0x56b4e9), RGB(0x009e73), RGB(0xf0e442), RGB(0x0072b2), RGB(0xd55e00), RGB(0xcc79a7),
    RGB(0xf1ca73), RGB(0xa2d6f3), RGB(0x73cab2), RGB(0xf7f097), RGB(0x73b1d5), RGB(0xe8a673), RGB(0xe3b5cf),
    RGB(0x8a5f00), RGB(0x346c8c), RGB(0x005f45), RGB(0x908928), RGB(0x00446b), RGB(0x803800), RGB(0x7a4964)};

enum { HUES = 7, SHADES = 3 };

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

uint32_t zr_part_color_of(const char *name)
{
    size_t length = strlen(name), base = length;
    uint32_t hash = ZR_HASH_BEGIN, number = 0;
    while (base > 0 && is_digit(name[base - 1]))
        base--;
    for (size_t i = base; i < length; i++)
        number = (10 * number + (uint32_t)(name[i] - '0')) % ZR_PART_COLORS;
    if (base == length) number = 1;
    if (base < length && base > 0 && name[base - 1] == '.') base--;
    for (size_t i = 0; i < base; i++)
        hash = zr_hash_byte(hash, (uint8_t)name[i]);
    hash ^= hash >> 15; /* mixes the last bytes into all bits */
    hash *= 0x2c1b3c6du;
    hash ^= hash >> 12;
    const uint32_t n = hash % ZR_PART_COLORS + number;
    return n % SHADES * HUES + n % HUES;
}
