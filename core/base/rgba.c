#include "base/rgba.h"

uint8_t zr_rgba_byte(float value)
{
    const float no_fraction = 12582912.0f; /* 1.5 * 2^23: to an integer, ties to even */
    value = value > 0.0f ? value : 0.0f;
    value = value < 1.0f ? value : 1.0f;
    return (uint8_t)(int32_t)((value * 255.0f + no_fraction) - no_fraction);
}

uint32_t zr_rgba_make(zr_vec4 color)
{
    const uint8_t bytes[4] = {zr_rgba_byte(color.x), zr_rgba_byte(color.y), zr_rgba_byte(color.z),
                              zr_rgba_byte(color.w)};
    uint32_t rgba;
    memcpy(&rgba, bytes, sizeof rgba);
    return rgba;
}

uint32_t zr_rgba_opaque(zr_vec4 color)
{
    return zr_rgba_make((zr_vec4){color.x, color.y, color.z, 1.0f});
}

zr_vec4 zr_rgba_floats(uint32_t rgba)
{
    uint8_t bytes[4];
    memcpy(bytes, &rgba, sizeof bytes);
    return (zr_vec4){(float)bytes[0] / 255.0f, (float)bytes[1] / 255.0f, (float)bytes[2] / 255.0f,
                     (float)bytes[3] / 255.0f};
}
