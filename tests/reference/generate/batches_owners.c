#include "reference/generate/batches.h"

/* Both odd, and inverse to each other modulo 2^24. */
static const uint32_t scatter = 0x9e3779u, gather = 0xb382c9u;

zr_vec4 batches_owner_color(uint32_t number)
{
    uint32_t c = number * scatter;
    return (zr_vec4){(float)(c & 255) / 255.0f, (float)(c >> 8 & 255) / 255.0f, (float)(c >> 16 & 255) / 255.0f, 1.0f};
}

uint32_t batches_owner_number(const uint8_t rgba[4])
{
    uint32_t c = rgba[0] | (uint32_t)rgba[1] << 8 | (uint32_t)rgba[2] << 16;
    return c * gather & BATCHES_OWNERS_MAX;
}
