/* harness.h - reference: draws a drawing on both sides and compares.
 *
 * Two ways to fail are kept apart. The renderer under test is at fault: it
 * differs, or gives no picture. Or nothing was proved: the reference is missing,
 * memory is short, or no pixel was there to compare.
 */
#ifndef ZR_TEST_HARNESS_H
#define ZR_TEST_HARNESS_H

#include "reference/compare.h"
#include "reference/drawing.h"
#include "reference/reference.h"
#include "zraster.h"

/* Also the exit status of the program; the larger one wins. */
enum verdict { VERDICT_EQUAL = 0, VERDICT_DIFFERENT = 1, VERDICT_UNPROVED = 2 };

struct tally {
    uint64_t pictures, triangles, clipped;
    struct comparison comparison;
};

struct harness {
    const struct reference_backend *backend;
    void *reference;
    struct zr_arena arena;
    struct zr_team *team;
    const char *failures; /* directory for pictures of what differs */
    int failures_left;    /* how many may still be written */
    size_t room;          /* pixels that the buffers below hold */
    uint8_t *rgba;
    float *depth;
    uint32_t *owner;
    struct drawing single; /* one face at a time, to find the smallest failing case */
};

/* False, explained on stderr, where there is no reference. harness_close in any case. */
bool harness_open(struct harness *harness, const struct reference_backend *backend, int threads, const char *failures);
void harness_close(struct harness *harness);

/* Adds to *tally. On the first few differences writes pictures and prints pixels;
 * `label` and `number` name them. */
enum verdict harness_check(struct harness *harness, struct drawing *drawing, const char *label, uint64_t number,
                           struct tally *tally);

void tally_add(struct tally *sum, const struct tally *more);

#endif
