#include "support/surface_rule.h"

#include <math.h>

enum { SIDE = SURFACE_SIDE, SAMPLES = SURFACE_SAMPLES };

static const double degrees_max = 6.0, pixels_max = 0.375, color_max = 1.0 / 64.0;
/* So far from its limits rounding of floats decides nothing: in cosines, pixels and colours. */
static const double cosine_slack = 2e-6, pixels_slack = 1e-3, color_slack = 1e-6;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Divides sums by their weight, and normals by their length, if they have one. */
static void divide(struct surface *s, double weight)
{
    const double length = sqrt(dot(s->normal, s->normal));
    for (int k = 0; k < 3; k++) {
        s->base[k] /= weight;
        s->way[k] /= weight;
        s->normal[k] /= length > 0.0 ? length : 1.0;
    }
}

/* ---- primitives ---- */

static struct surface *surface_of(struct surface_pixel *pixel, const struct surface_sample *sample, uint32_t number)
{
    for (uint32_t i = 0; i < pixel->count; i++)
        if (pixel->surfaces[i].primitive == sample->primitive) return &pixel->surfaces[i];
    pixel->surfaces[pixel->count] =
        (struct surface){.primitive = sample->primitive, .material = sample->material, .first = number};
    return &pixel->surfaces[pixel->count++];
}

static void add_sample(const struct surface_sample *sample, uint32_t number, struct surface *to)
{
    to->samples |= 1u << number;
    to->count += 1.0;
    to->w += sample->over_w;
    for (int k = 0; k < 3; k++) {
        to->base[k] += (double)sample->base[k] * sample->over_w;
        to->normal[k] += (double)sample->normal[k] * sample->over_w;
        to->way[k] += (double)sample->way[k] * sample->over_w;
    }
}

/* Samples whose squared distance from the middle of the pixel, in half samples, is `square`; by rows from the
 * lowest. */
static void add_ring(const struct surface_sample *samples, int square, struct surface_pixel *pixel)
{
    for (uint32_t i = 0; i < SAMPLES; i++) {
        const int x = 2 * (int)(i % SIDE) - (SIDE - 1), y = 2 * (int)(i / SIDE) - (SIDE - 1);
        if (x * x + y * y == square && samples[i].primitive > 0)
            add_sample(&samples[i], i, surface_of(pixel, &samples[i], i));
    }
}

static void find_primitives(const struct surface_sample *samples, struct surface_pixel *pixel)
{
    pixel->count = 0;
    for (int square = 2; square <= 18; square += 8)
        add_ring(samples, square, pixel);
    for (uint32_t i = 0; i < pixel->count; i++) {
        struct surface *s = &pixel->surfaces[i];
        divide(s, s->w);
        s->w = s->count / s->w;
    }
}

/* ---- surfaces ---- */

/* Returns how far within the limits, in slacks: from -1 to 1 rounding decides; less: they are two surfaces. */
static double within(const struct surface *a, const struct surface *b, double scale)
{
    const double cosine = dot(a->normal, b->normal) - cos(degrees_max * acos(-1.0) / 180.0);
    double between[3], colors = 0.0;
    for (int k = 0; k < 3; k++) {
        between[k] = b->way[k] - a->way[k];
        colors = fmax(colors, fabs(b->base[k] - a->base[k]));
    }
    const double away = fmin(fabs(dot(between, a->normal)), fabs(dot(between, b->normal)));
    const double pixels = pixels_max - away * scale / fmax(a->w, b->w);
    if (a->material != b->material) return -HUGE_VAL;
    return fmin(cosine / cosine_slack, fmin(pixels / pixels_slack, (color_max - colors) / color_slack));
}

static void add_surface(const struct surface *from, struct surface *to)
{
    to->samples |= from->samples;
    to->count += from->count;
    for (int k = 0; k < 3; k++) {
        to->base[k] += from->base[k] * from->count;
        to->normal[k] += from->normal[k] * from->count;
        to->way[k] += from->way[k] * from->count;
    }
}

/* Joins those from `at` on that are alike to the one there. The others stay behind it, in their order. */
static void join(struct surface_pixel *pixel, uint32_t at, double scale)
{
    const struct surface lead = pixel->surfaces[at];
    const uint32_t all = pixel->count;
    struct surface sum = {.primitive = lead.primitive, .material = lead.material, .first = lead.first, .w = lead.w};
    add_surface(&lead, &sum);
    pixel->count = at + 1;
    for (uint32_t i = at + 1; i < all; i++) {
        const double inside = within(&lead, &pixel->surfaces[i], scale);
        pixel->is_undecided |= fabs(inside) <= 1.0;
        if (inside >= 0.0)
            add_surface(&pixel->surfaces[i], &sum);
        else
            pixel->surfaces[pixel->count++] = pixel->surfaces[i];
    }
    divide(&sum, sum.count);
    pixel->surfaces[at] = sum;
}

void surface_pixel_find(const struct surface_sample samples[SURFACE_SAMPLES], double scale, struct surface_pixel *pixel)
{
    pixel->is_undecided = false;
    find_primitives(samples, pixel);
    for (uint32_t i = 0; i < pixel->count; i++)
        join(pixel, i, scale);
}
