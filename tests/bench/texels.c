#include "bench/texels.h"

#include <math.h>
#include <stdlib.h>

enum { PIECES = 8, OCTAVES = 4 };

/* 0..1, by the place. */
static double noise(uint32_t x, uint32_t y)
{
    uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return (h ^ h >> 15) / 4294967296.0;
}

/* Between lattice points `cell` texels apart, smooth; the picture can be repeated. */
static double value(uint32_t x, uint32_t y, uint32_t cell, uint32_t side)
{
    const uint32_t count = side / cell, i = x / cell, j = y / cell;
    const double u = (double)(x % cell) / cell, v = (double)(y % cell) / cell;
    const double a = noise(i, j), b = noise((i + 1) % count, j);
    const double c = noise(i, (j + 1) % count), d = noise((i + 1) % count, (j + 1) % count);
    return (a + u * (b - a)) * (1.0 - v) + (c + u * (d - c)) * v;
}

static double clouds(uint32_t x, uint32_t y, uint32_t side)
{
    double sum = 0.0, weight = 0.5;
    for (uint32_t octave = 0, cell = side / PIECES; octave < OCTAVES && cell > 0; octave++, cell /= 2, weight /= 2.0)
        sum += weight * value(x, y, cell, side);
    return sum;
}

static double shade_at(enum texels kind, uint32_t x, uint32_t y, uint32_t side)
{
    const double grain = clouds(x, y, side);
    const uint32_t cell = side / PIECES;
    if (kind == TEXELS_SQUARES) return ((x / cell + y / cell) % 2 ? 0.85 : 0.35) + 0.1 * (grain - 0.5);
    if (kind == TEXELS_STRIPES) return 0.6 + 0.3 * sin(6.2831853 * (PIECES * (double)x / side + 2.0 * grain));
    return 0.15 + 0.8 * grain;
}

uint8_t *texels_make(enum texels kind, uint32_t side)
{
    static const double tints[TEXELS_KINDS][3] = {{1.0, 0.96, 0.9}, {0.9, 0.62, 0.38}, {0.6, 0.75, 1.0}};
    uint8_t *texels = malloc((size_t)side * side * 4);
    for (uint32_t y = 0; texels && y < side; y++)
        for (uint32_t x = 0; x < side; x++) {
            uint8_t *texel = texels + 4 * ((size_t)y * side + x);
            const double shade = shade_at(kind, x, y, side);
            for (int k = 0; k < 3; k++)
                texel[k] = (uint8_t)(255.0 * fmin(fmax(shade * tints[kind][k], 0.0), 1.0) + 0.5);
            texel[3] = 255;
        }
    return texels;
}
