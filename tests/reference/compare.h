/* compare.h - reference: two pictures of one scene, pixel by pixel.
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

#include "reference/nearness.h"

enum { COMPARE_NO_COLORS = 255 };

/* Row 0 on top. `owner` is the face's number from 1, or 0 for the background. */
struct picture {
    const uint8_t *rgba;
    const float *depth;
    const uint32_t *owner;
    const uint8_t *gaps;  /* NULL, or 1 where the picture does not tell who owns the pixel */
    uint32_t color_slack; /* so many LSB may colours be off by; COMPARE_NO_COLORS: it has none that could be compared */
};

/* What must hold. An ulp is one of the largest numbers that are added up on the way to depth (nearness_rounding). */
enum compare_bar {
    COMPARE_EXACT,          /* everything is equal */
    COMPARE_SECOND_OPINION, /* where owners differ, an edge or an equal depth explains it */
    COMPARE_TRANSFORM       /* the same, and depth is within 1 ulp + 0.1 px of slope */
};

struct comparison {
    uint64_t pixels;  /* compared */
    uint64_t visible; /* of them: that either side gives to a face */
    uint64_t gaps;    /* left out: parity alone covers them */

    uint64_t coverage; /* pixels with different owners */
    uint64_t at_edge;  /* of them: at most 1/256 px from an edge of one of the two faces */
    uint64_t at_tie;   /* of the others: both faces at one depth, as far as rounding can tell */
    double edge_max_px;

    uint64_t depth; /* of pixels with the same owner: different depths */
    uint32_t depth_max_ulp;
    double depth_max_px;   /* the largest difference, in pixels of the face's slope */
    uint64_t depth_astray; /* beyond 1 ulp + 0.1 px of slope */

    uint64_t color;      /* of pixels with the same owner: different colours, by more than they may be */
    uint64_t color_near; /* different, but by no more */
    uint32_t color_max_lsb;
};

/* The first pixels that miss the bar. */
enum { COMPARE_MISSED_MAX = 5 };
struct compare_missed {
    uint64_t count;
    size_t pixels[COMPARE_MISSED_MAX];
};

/* Adds what it finds to *sum. Returns the pixels that miss the bar. `nearness` may be NULL
 * for COMPARE_EXACT: then nothing is measured in pixels. */
struct compare_missed compare_pictures(const struct picture *want, const struct picture *got, uint32_t width,
                                       uint32_t height, enum compare_bar bar, struct nearness *nearness,
                                       struct comparison *sum);

/* As far as it must be: colours may be off by their slack. */
bool compare_pixel_equal(const struct picture *want, const struct picture *got, size_t pixel);

/* How many floats lie between: 0 for equal ones and for -0 and 0. UINT32_MAX
 * where one is NaN and the other not, or where the count does not fit. */
uint32_t compare_ulp(float a, float b);

void compare_add(struct comparison *sum, const struct comparison *more);

#endif
