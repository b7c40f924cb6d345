/* compare.h - reference: two pictures of one drawing, pixel by pixel.
 *
 * Three questions, asked in this order, so that one fault is counted once: does
 * the same face own the pixel (coverage, order, depth test)? Where it does, is
 * the depth the same float? And the colour the same bytes?
 */
#ifndef ZR_TEST_COMPARE_H
#define ZR_TEST_COMPARE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Row 0 on top. `owner` is the face's number from 1, or 0 for the background. */
struct picture {
    const uint8_t *rgba;
    const float *depth;
    const uint32_t *owner;
};

struct comparison {
    uint64_t visible;  /* pixels that either side gives to a face */
    uint64_t coverage; /* pixels with different owners */
    uint64_t depth;    /* of the others: different depths */
    uint32_t depth_max_ulp;
    uint64_t color; /* of the others: different colours */
    uint32_t color_max_lsb;
};

/* Adds what it finds to *sum. Returns the count of differing pixels. */
uint64_t compare_pictures(const struct picture *want, const struct picture *got, size_t pixels, struct comparison *sum);

bool compare_pixel_equal(const struct picture *want, const struct picture *got, size_t pixel);

/* How many floats lie between: 0 for equal ones and for -0 and 0. UINT32_MAX
 * where one is NaN and the other not, or where the count does not fit. */
uint32_t compare_ulp(float a, float b);

void compare_add(struct comparison *sum, const struct comparison *more);
bool compare_is_zero(const struct comparison *comparison);

#endif
