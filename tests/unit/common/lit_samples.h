/* lit_samples.h - tests: a G-buffer of single samples, lit by a kernel. */
#ifndef ZR_TESTS_LIT_SAMPLES_H
#define ZR_TESTS_LIT_SAMPLES_H

#include <math.h>
#include <string.h>

#include "shade/lights/lighting.h"
#include "support/cmocka_all.h"
#include "support/random.h"

enum { SAMPLES = 4096, ROOM = SAMPLES + 16 };

struct lit_samples {
    struct zr_gbuffer g;
    uint32_t owner[ROOM], material[ROOM];
    float planes[9][ROOM], open[ROOM], out[3][ROOM];
};

/* No sample has an owner; `out` is full of a value that no kernel writes. */
static inline void samples_clear(struct lit_samples *s)
{
    memset(s, 0, sizeof *s);
    s->g =
        (struct zr_gbuffer){.width = SAMPLES, .height = 1, .stride = ROOM, .owner = s->owner, .material = s->material};
    for (int k = 0; k < 3; k++) {
        s->g.base[k] = s->planes[k];
        s->g.normal[k] = s->planes[3 + k];
        s->g.point[k] = s->planes[6 + k];
        for (int i = 0; i < ROOM; i++) {
            s->g.point[k][i] = ZR_FAR_POINT;
            s->out[k][i] = -7.0f;
        }
    }
    for (int i = 0; i < ROOM; i++)
        s->open[i] = 1.0f;
}

static inline void put3(float *const to[3], size_t at, zr_vec3 v)
{
    to[0][at] = v.x;
    to[1][at] = v.y;
    to[2][at] = v.z;
}

static inline zr_vec3 get3(float *const from[3], size_t at)
{
    return (zr_vec3){from[0][at], from[1][at], from[2][at]};
}

static inline void samples_set(struct lit_samples *s, size_t at, uint32_t material, zr_vec3 base, zr_vec3 normal,
                               zr_vec3 point)
{
    s->owner[at] = (uint32_t)at + 1;
    s->material[at] = material;
    put3(s->g.base, at, base);
    put3(s->g.normal, at, normal);
    put3(s->g.point, at, point);
}

static inline void samples_light(struct lit_samples *s, enum zr_isa isa, const struct zr_linear_lighting *lighting)
{
    float *const out[3] = {s->out[0], s->out[1], s->out[2]};
    zr_linear_light_of(isa)(lighting, &s->g, s->open, out);
}

/* ---- anything ---- */

static inline float any(struct random *r, double low, double high)
{
    return (float)random_range(r, low, high);
}

static inline zr_vec3 any3(struct random *r, double low, double high)
{
    zr_vec3 v = {any(r, low, high), any(r, low, high), any(r, low, high)};
    return v;
}

static inline zr_vec3 any_unit(struct random *r)
{
    for (;;) {
        const zr_vec3 v = any3(r, -1, 1);
        const float square = zr_vec3_dot(v, v);
        if (square > 0.01f && square < 1.0f) return zr_vec3_normalize(v);
    }
}

/* With N.V of at least `least`. */
static inline zr_vec3 any_facing(struct random *r, zr_vec3 to_eye, float least)
{
    for (;;) {
        const zr_vec3 n = any_unit(r);
        if (zr_vec3_dot(n, to_eye) >= least) return n;
    }
}

/* Seen from the origin, somewhere in front of it. */
static inline void samples_set_any(struct lit_samples *s, struct random *r, size_t at, uint32_t material)
{
    const zr_vec3 point = {any(r, -3, 3), any(r, -3, 3), any(r, -8, -1)};
    const zr_vec3 to_eye = zr_vec3_normalize(zr_vec3_scale(point, -1.0f));
    samples_set(s, at, material, any3(r, 0, 1), any_facing(r, to_eye, 0.02f), point);
    s->open[at] = any(r, 0, 1);
}

/* Light of which nothing is there yet. */
static inline struct zr_linear_lighting no_light(const struct zr_material *materials)
{
    return (struct zr_linear_lighting){.materials = materials,
                                       .environment_intensity = 1.0f,
                                       .eye_to_environment = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                       .tone = ZR_TONE_NONE,
                                       .exposure = 1.0f};
}

#endif
