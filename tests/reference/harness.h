/* harness.h - reference: draws a scene on both sides and compares.
 *
 * Two ways to fail are kept apart. The renderer under test is at fault: it
 * differs, or gives no picture. Or nothing was proved: the reference is missing,
 * memory is short, or no pixel was there to compare.
 */
#ifndef ZR_TEST_HARNESS_H
#define ZR_TEST_HARNESS_H

#include "core.h"
#include "reference/compare.h"
#include "reference/gl/look_twin.h"
#include "reference/line_rule.h"
#include "scene/scene.h"
#include "shade/frame.h"

/* Also the exit status of the program; the larger one wins. */
enum verdict { VERDICT_EQUAL = 0, VERDICT_DIFFERENT = 1, VERDICT_UNPROVED = 2 };

struct tally {
    uint64_t pictures, triangles, clipped, parity_faces;
    uint64_t left_out; /* of bars that are not exact: float itself is too coarse, or there are outlines or lines */
    uint64_t twins_pixels, twins_beyond; /* of channels (twins.h): compared, and differ by more than they may */
    uint64_t colors_left_out; /* of pictures in linear light that have no twin (look_twin.h): the rest is compared */
    uint64_t undecided;       /* gaps of pictures in linear light: pixels whose surfaces depend on rounding */
    struct comparison comparison;
};

struct harness_options {
    const char *driver; /* "llvmpipe" or "softpipe" */
    int threads;        /* that render, on both sides */
    enum zr_isa isa;    /* of our side */
    enum compare_bar bar;
    bool all_parity;  /* the reference draws convex polygons by the odd-even rule too (batches.h) */
    bool transformed; /* the reference gets clip-space positions (batches.h) */
    /* Errors on the reference's side: comparisons that must fail. */
    double perturbation;           /* added to clip-space x */
    float more_ambient, more_to_x; /* of lights (batches.h) */
    const char *failures;          /* directory for pictures of what differs; empty: none */
};

struct harness {
    struct harness_options options;
    struct reference *reference;
    enum line_rule line_rule; /* the reference's */
    bool lines_compare;       /* our side can draw by it */
    struct look_programs look_programs;
    struct zr_arena arena;
    struct zr_team *team;
    int failures_left; /* how many may still be written */
    size_t room;       /* pixels that the buffers below hold */
    uint8_t *rgba, *gaps;
    float *depth;
    uint32_t *owner;
    /* Pixels of the picture at hand: show nothing but layers; have other sums (layers_twin.h). */
    uint64_t layers_alone, sums_different;
    uint64_t undecided; /* likewise: look_twin.h */
};

/* What both sides drew; stands until the harness's next picture. */
struct harness_pictures {
    const struct zr_frame *frame; /* ours */
    struct picture want, got;
    struct compare_missed missed;
};

/* False, explained on stderr, where there is no reference. harness_close in any case. */
bool harness_open(struct harness *harness, const struct harness_options *options);
void harness_close(struct harness *harness);

/* Adds to *tally. On the first few differences writes pictures and prints pixels;
 * `label` and `number` name them. `pictures` may be NULL; its frame is NULL where a side drew nothing. */
enum verdict harness_check(struct harness *harness, const struct zr_scene *scene, const char *label, uint64_t number,
                           struct tally *tally, struct harness_pictures *pictures);

void tally_add(struct tally *sum, const struct tally *more);

#endif
