/* twins.h - reference: the channels that are floats or numbers, each against a program of GLSL that the reference runs.
 *
 * A channel has one row in twins.c for each of its spaces: what varies over a triangle, what the fragment program makes
 * of it, and how much of what float interpolation loses may lie between the two (interpolation.h); none: they are equal
 * to the last bit. Compared is each pixel that both sides give to the same face. Two kinds are left out, and counted.
 * Of lines, only what has the same value all along is compared: ours lie on the rays of their pixels, the reference's
 * do not. And shares of a corner with w <= 0 are another contract's: ours are kept within 0..1.
 */
#ifndef ZR_TEST_TWINS_H
#define ZR_TEST_TWINS_H

#include "reference/page/report.h"

enum { TWINS_MAX = 16 };

struct twin_sum {
    uint64_t pixels; /* compared */
    uint64_t lines;  /* left out: a line covers them */
    uint64_t equal;  /* of the pixels: to the last bit */
    uint64_t sharp;  /* of them: less than a 10000th of the value may be off */
    uint64_t beyond; /* of them: more is off than may be */
    double most;     /* that is off: of exact ones in ulp, else in losses of interpolation.h */
};

/* All zero to begin with. */
struct twins {
    unsigned programs[TWINS_MAX]; /* 0: not made yet */
    struct twin_sum sums[TWINS_MAX];
};

/* After harness_check of the same scene, whose `pictures` tell who owns each pixel. Adds to twins->sums and to
 * *tally; the first pixels that differ are printed. Nothing is done, and all is well, for bars that are not exact. */
enum verdict twins_check(struct twins *twins, struct harness *harness, const struct zr_scene *scene, const char *label,
                         const struct harness_pictures *pictures, struct tally *tally);

/* A line for each row. Unproved where a channel had no pixel, not even one that was left out. */
enum verdict twins_report(const struct twins *twins, struct report *report);

#endif
