/* light_one.h - tests: what Mesa's fixed-function lighting makes of one vertex, in its order. */
#ifndef ZR_TESTS_LIGHT_ONE_H
#define ZR_TESTS_LIGHT_ONE_H

#include "shade/lights/light.h"

static inline float clamp01(float v)
{
    return v < 0.0f ? 0.0f : v < 1.0f ? v : 1.0f;
}

static inline float term(float light, float base, float facing)
{
    return light * base * facing;
}

static inline void light_one(const struct zr_lights *lighting, const struct zr_normal_matrix *to_eye, zr_vec3 normal,
                             zr_vec4 base, zr_vec4 *front, zr_vec4 *back)
{
    zr_vec3 n = zr_vec3_normalize(normal);
    n = (zr_vec3){zr_vec3_dot(to_eye->rows[0], n), zr_vec3_dot(to_eye->rows[1], n), zr_vec3_dot(to_eye->rows[2], n)};
    n = zr_vec3_normalize(n);
    zr_vec3 sides[2];
    for (int side = 0; side < 2; side++)
        sides[side] =
            (zr_vec3){lighting->ambient.x * base.x, lighting->ambient.y * base.y, lighting->ambient.z * base.z};
    for (uint32_t i = 0; i < lighting->count; i++) {
        const float cosine = zr_vec3_dot(n, lighting->lamps[i].to_light), facing = cosine > 0.0f ? cosine : -cosine;
        const zr_vec3 color = lighting->lamps[i].color;
        zr_vec3 *side = &sides[cosine > 0.0f ? 0 : 1];
        side->x += term(color.x, base.x, facing);
        side->y += term(color.y, base.y, facing);
        side->z += term(color.z, base.z, facing);
    }
    *front = (zr_vec4){clamp01(sides[0].x), clamp01(sides[0].y), clamp01(sides[0].z), clamp01(base.w)};
    *back = (zr_vec4){clamp01(sides[1].x), clamp01(sides[1].y), clamp01(sides[1].z), clamp01(base.w)};
}

#endif
