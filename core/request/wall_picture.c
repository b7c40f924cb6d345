#include "request/wall_picture.h"

#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/rgba.h"
#include "overlay/color_bar.h"

/* Share of pixels in the range of colours, and of samples that are sorted to find it. */
static const double in_range = 0.98;
enum { SAMPLES_MAX = 1 << 14 };

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return x < y ? -1 : x > y;
}

/* Rounds up to two digits. */
static float rounded_up(double value)
{
    double unit = 1.0;
    while (unit < 1e30 && unit * 10.0 <= value)
        unit *= 10.0;
    while (unit > 1e-30 && unit > value)
        unit /= 10.0;
    return (float)(ceil(value / unit * 10.0) * 0.1 * unit);
}

/* Returns the end of the range, from evenly spread pixels; 1 if there is no wall. */
static float find_most(const float *walls, size_t pixels, float *samples)
{
    const size_t step = 1 + pixels / SAMPLES_MAX;
    size_t count = 0;
    for (size_t i = 0; i < pixels; i += step)
        if (walls[i] > 0.0f) samples[count++] = walls[i];
    if (count == 0) return 1.0f;
    qsort(samples, count, sizeof *samples, compare);
    return rounded_up((double)samples[(size_t)(in_range * (double)(count - 1))]);
}

uint32_t *zr_wall_picture_make(const struct zr_run *run, const float *walls, uint32_t width, uint32_t height)
{
    const size_t pixels = (size_t)width * height;
    const struct zr_color_bar bar = {.is_on = true, .title = "wall"};
    const zr_vec4 white = {1.0f, 1.0f, 1.0f, 1.0f};
    float *samples = zr_arena_alloc(run->arena, SAMPLES_MAX + 1, sizeof *samples);
    uint32_t *out = zr_arena_alloc(run->arena, pixels, sizeof *out);
    struct zr_color_bar_layout layout;
    if (!samples || !out) return NULL;
    const struct zr_color_scale scale = {ZR_COLORMAP_TURBO, 0.0f, find_most(walls, pixels, samples), true};
    for (size_t i = 0; i < pixels; i++) {
        if (i % width == 0 && zr_is_cancelled(run->cancel)) return NULL;
        const float share = walls[i] / scale.high;
        const bool has_wall = walls[i] > 0.0f;
        out[i] = zr_rgba_opaque(has_wall ? zr_colormap_color(scale.map, share < 1.0f ? share : 1.0f) : white);
    }
    const struct zr_canvas canvas = {out, (int32_t)width, (int32_t)height};
    if (zr_color_bar_lay_out(&bar, &scale, width, height, &layout)) zr_color_bar_paint(&layout, &canvas);
    return out;
}
