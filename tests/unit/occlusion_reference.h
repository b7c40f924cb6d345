/* occlusion_reference.h - tests: ambient occlusion pixel by pixel, in double. Only where a step of a direction ends is
 * found in float, in the order of core/effects/occlusion_kernel.c: rounded the other way, it would be another pixel. */
#ifndef ZR_TESTS_OCCLUSION_REFERENCE_H
#define ZR_TESTS_OCCLUSION_REFERENCE_H

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "effects/occlusion.h"

struct reference {
    const struct zr_gbuffer *pixels;
    struct zr_occlusion occlusion;
    struct zr_pixel_scale scale;
    double diagonal;
};

static inline double reference_clamp(double v)
{
    return v < 0.0 ? 0.0 : v > 1.0 ? 1.0 : v;
}

static inline bool reference_is_seen(const struct zr_gbuffer *g, int x, int y)
{
    return x >= 0 && y >= 0 && x < g->width && y < g->height && g->owner[y * g->stride + x] != 0;
}

/* Of the point at `to` over the plane through `from`, in direction of `normal`; and the square of how far it is. */
static inline double reference_height(float *const to[3], ptrdiff_t t, float *const from[3], float *const normal[3],
                                      ptrdiff_t f, double *square)
{
    double height = 0.0;
    *square = 0.0;
    for (int c = 0; c < 3; c++) {
        const double d = (double)to[c][t] - (double)from[c][f];
        height += d * (double)normal[c][f];
        *square += d * d;
    }
    return height;
}

static inline double reference_found(const struct reference *r, int x, int y)
{
    static const int numbers[16] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    const struct zr_gbuffer *g = r->pixels;
    const ptrdiff_t at = y * g->stride + x;
    const int i = numbers[4 * (y % 4) + x % 4];
    const float distance = r->occlusion.radius * (float)r->diagonal, *s = r->scale.slope;
    const float w = ((s[2] * g->point[2][at] + s[1] * g->point[1][at]) + s[0] * g->point[0][at]) + r->scale.offset;
    const float radius = fmaxf(4.0f, distance * r->scale.scale / w);
    double sum = 0.0;
    for (int k = 0; k < 8; k++) {
        const double angle = 2.0 * 3.14159265358979323846 * (k + i / 16.0) / 8.0;
        double most = 0.0;
        for (int j = 0; j < 4; j++) {
            const float share = ((float)j + ((float)(5 * i % 16) + 0.5f) / 16.0f) / 4.0f;
            const float length = fmaxf(1.0f + (float)j, radius * (share * share));
            const double dx = rint((double)(length * (float)cos(angle))),
                         dy = rint((double)(length * (float)sin(angle)));
            if (fabs(dx) > 1e5 || fabs(dy) > 1e5 || !reference_is_seen(g, x + (int)dx, y + (int)dy)) continue;
            double square;
            const double height =
                reference_height(g->point, at + (int)dy * g->stride + (int)dx, g->point, g->normal, at, &square);
            const double h = fmax(0.0, height / sqrt(square) - 0.1) *
                             fmax(0.0, 1.0 - square / ((double)distance * (double)distance));
            if (h > most) most = h;
        }
        sum += most;
    }
    return reference_clamp(1.0 - (double)r->occlusion.strength * sum / 8.0);
}

/* One pass: steps (1, 0) or (0, 1). */
static inline double reference_blurred(const struct reference *r, const double *light, int x, int y, int step_x,
                                       int step_y)
{
    static const double weights[5] = {1, 2, 2, 2, 1};
    const struct zr_gbuffer *g = r->pixels;
    const ptrdiff_t at = y * g->stride + x;
    double sum = 0.0, all = 0.0;
    for (int i = -2; i <= 2; i++) {
        if (!reference_is_seen(g, x + i * step_x, y + i * step_y)) continue;
        const ptrdiff_t there = at + i * (step_x + step_y * g->stride);
        double square;
        if (fabs(reference_height(g->point, there, g->point, g->normal, at, &square)) > 0.01 * r->diagonal) continue;
        sum += weights[i + 2] * light[there];
        all += weights[i + 2];
    }
    return sum / all;
}

static inline bool reference_has_plane(const struct zr_gbuffer *g, int x, int y)
{
    const ptrdiff_t at = y * g->stride + x;
    return reference_is_seen(g, x, y) &&
           (g->normal[0][at] != 0.0f || g->normal[1][at] != 0.0f || g->normal[2][at] != 0.0f);
}

/* stride x height, to be freed. */
static inline double *reference_light(const struct reference *r)
{
    const struct zr_gbuffer *g = r->pixels;
    const size_t size = (size_t)g->stride * (size_t)g->height;
    double *passes[3];
    for (int pass = 0; pass < 3; pass++) {
        passes[pass] = malloc(size * sizeof(double) + 1);
        for (int y = 0; y < g->height; y++)
            for (int x = 0; x < g->width; x++)
                passes[pass][y * g->stride + x] =
                    !reference_has_plane(g, x, y) ? 1.0
                    : pass == 0                   ? reference_found(r, x, y)
                                                  : reference_blurred(r, passes[pass - 1], x, y, pass == 1, pass == 2);
    }
    free(passes[0]);
    free(passes[1]);
    return passes[2];
}

/* At sample x, y of the window, which is [at] of `samples`. */
static inline double reference_sample(const struct zr_occlusion_map *map, double diagonal,
                                      const struct zr_gbuffer *samples, ptrdiff_t at, int side, int x, int y)
{
    const struct zr_gbuffer *g = map->pixels;
    const double u = (x + 0.5) / side - 0.5, v = (y + 0.5) / side - 0.5;
    double sum = 0.0, all = 0.0;
    for (int row = (int)floor(v); row <= (int)floor(v) + 1; row++)
        for (int column = (int)floor(u); column <= (int)floor(u) + 1; column++) {
            const int near_x = column < 0 ? 0 : column >= g->width ? g->width - 1 : column;
            const int near_y = row < 0 ? 0 : row >= g->height ? g->height - 1 : row;
            const ptrdiff_t there = near_y * g->stride + near_x;
            if (!reference_is_seen(g, near_x, near_y)) continue;
            double square;
            const double away =
                reference_height(g->point, there, samples->point, samples->normal, at, &square) / (0.01 * diagonal);
            const double weight = ((1.0 - fabs(u - column)) * (1.0 - fabs(v - row)) + 0.001) / (0.0001 + away * away);
            sum += weight * (double)map->light[there];
            all += weight;
        }
    return all > 1e-12 ? sum / all : 1.0;
}

#endif
