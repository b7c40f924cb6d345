/* glsl_math.h - reference: functions of GLSL as llvmpipe computes them, to the last bit.
 *
 * Held against the reference by zraster-verify --floats (RULES.md, rule 18), in vertex and fragment programs alike.
 * Source: Mesa, src/gallium/auxiliary/gallivm/lp_bld_arit.c: lp_build_log2_approx, lp_build_exp2, lp_build_pow.
 */
#ifndef ZR_TEST_GLSL_MATH_H
#define ZR_TEST_GLSL_MATH_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Of a normal float above 0. Even and odd powers of y^2 are summed apart, as lp_build_polynomial does. */
static inline float glsl_log2(float x)
{
    static const float c[5] = {2.88539009343309178325f, 0.961791550404184197881f, 0.577440339438736392009f,
                               0.403343858251329912514f, 0.406718052498846252698f};
    uint32_t bits, one_to_two;
    float mantissa;
    memcpy(&bits, &x, sizeof bits);
    one_to_two = (bits & 0x7fffffu) | 0x3f800000u;
    memcpy(&mantissa, &one_to_two, sizeof mantissa);
    const float exponent = (float)((int32_t)(bits >> 23 & 255) - 127);
    const float y = (mantissa - 1.0f) / (mantissa + 1.0f), z = y * y, zz = z * z;
    const float even = (c[4] * zz + c[2]) * zz + c[0], odd = c[3] * zz + c[1];
    return y * (odd * z + even) + exponent;
}

/* Of any float but NaN. */
static inline float glsl_exp2(float x)
{
    static const float c[6] = {1.0f,
                               0.693153073200168932794f,
                               0.240153617044375388211f,
                               0.0558263180532956664775f,
                               0.00898934009049466391101f,
                               0.00187757667519147912699f};
    x = x < 128.0f ? x : 128.0f;
    x = x > -126.99999f ? x : -126.99999f;
    const float whole = floorf(x), f = x - whole, ff = f * f;
    const uint32_t bits = (uint32_t)((int32_t)whole + 127) << 23;
    float power;
    memcpy(&power, &bits, sizeof power);
    const float even = (c[4] * ff + c[2]) * ff + c[0], odd = (c[5] * ff + c[3]) * ff + c[1];
    return power * (odd * f + even);
}

/* Of a normal float above 0, or of 0, which gives 0 whatever the exponent. Where the exponent is a constant of the
 * program, Mesa's compiler takes x for 1, x x for 2 and (x x)(x x) for 4 instead, and this for all others. */
static inline float glsl_pow(float x, float exponent)
{
    return x > 0.0f ? glsl_exp2(glsl_log2(x) * exponent) : 0.0f;
}

#endif
