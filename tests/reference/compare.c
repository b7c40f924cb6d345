#include "reference/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Floats of one sign are ordered as their bits are; this puts both signs on one
 * line of integers, with -0 and 0 on the same spot. */
static int64_t place(float f)
{
    uint32_t bits;
    memcpy(&bits, &f, sizeof bits);
    int64_t magnitude = bits & 0x7fffffffu;
    return bits >> 31 ? -magnitude : magnitude;
}

uint32_t compare_ulp(float a, float b)
{
    if (isnan(a) || isnan(b)) return isnan(a) && isnan(b) ? 0 : UINT32_MAX;
    int64_t distance = llabs(place(a) - place(b));
    return distance < UINT32_MAX ? (uint32_t)distance : UINT32_MAX;
}

static uint32_t max(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

static uint32_t color_lsb(const uint8_t *a, const uint8_t *b)
{
    uint32_t most = 0;
    for (int i = 0; i < 4; i++)
        most = max(most, (uint32_t)abs(a[i] - b[i]));
    return most;
}

bool compare_pixel_equal(const struct picture *want, const struct picture *got, size_t pixel)
{
    return want->owner[pixel] == got->owner[pixel] && compare_ulp(want->depth[pixel], got->depth[pixel]) == 0 &&
           color_lsb(want->rgba + pixel * 4, got->rgba + pixel * 4) == 0;
}

uint64_t compare_pictures(const struct picture *want, const struct picture *got, size_t pixels, struct comparison *sum)
{
    uint64_t differing = 0;
    for (size_t i = 0; i < pixels; i++) {
        sum->visible += (want->owner[i] | got->owner[i]) != 0;
        if (compare_pixel_equal(want, got, i)) continue;
        differing++;
        if (want->owner[i] != got->owner[i]) {
            sum->coverage++;
            continue;
        }
        uint32_t ulp = compare_ulp(want->depth[i], got->depth[i]);
        uint32_t lsb = color_lsb(want->rgba + i * 4, got->rgba + i * 4);
        sum->depth += ulp != 0;
        sum->depth_max_ulp = max(sum->depth_max_ulp, ulp);
        sum->color += lsb != 0;
        sum->color_max_lsb = max(sum->color_max_lsb, lsb);
    }
    return differing;
}

void compare_add(struct comparison *sum, const struct comparison *more)
{
    sum->visible += more->visible;
    sum->coverage += more->coverage;
    sum->depth += more->depth;
    sum->depth_max_ulp = max(sum->depth_max_ulp, more->depth_max_ulp);
    sum->color += more->color;
    sum->color_max_lsb = max(sum->color_max_lsb, more->color_max_lsb);
}

bool compare_is_zero(const struct comparison *comparison)
{
    return comparison->coverage == 0 && comparison->depth == 0 && comparison->color == 0;
}
