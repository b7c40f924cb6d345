#include "input/codecs/meshopt_filter.h"

#include <math.h>
#include <string.h>

static int read16(const unsigned char *at)
{
    return (int16_t)(uint16_t)(at[0] | at[1] << 8);
}

static void write16(unsigned char *at, int value)
{
    at[0] = (unsigned char)(value & 0xFF);
    at[1] = (unsigned char)(value >> 8 & 0xFF);
}

/* Returns v * most as an integer; 0 for a NaN. */
static int to_integer(float v, float most)
{
    const float value = roundf(v * most);
    if (!(value >= -most)) return value < -most ? (int)-most : 0;
    return value > most ? (int)most : (int)value;
}

/* Decodes a unit vector of two coordinates on an octahedron; v[2] stands for 1. */
static void unfold(const int v[3], float most, int out[3])
{
    const float one = (float)v[2];
    float x = (float)v[0] / one, y = (float)v[1] / one;
    const float z = 1.0f - fabsf(x) - fabsf(y), t = z < 0.0f ? z : 0.0f;
    x -= copysignf(t, x);
    y -= copysignf(t, y);
    const float length = sqrtf((x * x + y * y) + z * z);
    out[0] = to_integer(x / length, most);
    out[1] = to_integer(y / length, most);
    out[2] = to_integer(z / length, most);
}

static void filter_octahedral(unsigned char *at, uint32_t stride)
{
    int v[3], out[3];
    for (int k = 0; k < 3; k++)
        v[k] = stride == 4 ? (int8_t)at[k] : read16(at + 2 * k);
    unfold(v, stride == 4 ? 127.0f : 32767.0f, out);
    for (int k = 0; k < 3; k++)
        if (stride == 4)
            at[k] = (unsigned char)(out[k] & 0xFF);
        else
            write16(at + 2 * k, out[k]);
}

/* Decodes three components of a quaternion; the fourth is the largest. */
static void filter_quaternion(unsigned char *at)
{
    const int last = read16(at + 6), largest = last & 3;
    const float one = (float)(last | 3), range = 0.70710678118654752f;
    float v[3], rest = 1.0f;
    for (int k = 0; k < 3; k++) {
        v[k] = (float)read16(at + 2 * k) / one * range;
        rest -= v[k] * v[k];
    }
    for (int k = 0; k < 3; k++)
        write16(at + 2 * ((largest + 1 + k) % 4), to_integer(v[k], 32767.0f));
    write16(at + 2 * largest, to_integer(rest > 0.0f ? sqrtf(rest) : 0.0f, 32767.0f));
}

/* Decodes 24 bits of mantissa and 8 bits of exponent, both signed. */
static void filter_exponential(unsigned char *at)
{
    const uint32_t bits = (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16;
    const int mantissa = (int)(bits ^ 0x800000u) - 0x800000, exponent = (int8_t)at[3];
    const float value = ldexpf((float)mantissa, exponent);
    uint32_t out;
    memcpy(&out, &value, sizeof out);
    for (int k = 0; k < 4; k++)
        at[k] = (unsigned char)(out >> 8 * k & 0xFF);
}

void zr_meshopt_filter(const struct zr_meshopt *of, unsigned char *elements, uint32_t count)
{
    unsigned char *const end = elements + (size_t)count * of->stride;
    if (of->filter == ZR_MESHOPT_OCTAHEDRAL)
        for (unsigned char *at = elements; at < end; at += of->stride)
            filter_octahedral(at, of->stride);
    else if (of->filter == ZR_MESHOPT_QUATERNION)
        for (unsigned char *at = elements; at < end; at += of->stride)
            filter_quaternion(at);
    else if (of->filter == ZR_MESHOPT_EXPONENTIAL)
        for (unsigned char *at = elements; at < end; at += 4)
            filter_exponential(at);
}
