/* look_twin.h - reference: pictures in linear light, by a program of GLSL that the reference runs for each sample, or
 * for each surface of a pixel (look_surfaces.h).
 *
 * The reference draws at `side` times the size, into 32-bit floats: what the program makes of the surface's own colour,
 * its normal and the way to the eye, which it interpolates itself. The formulas and the constants of environments are
 * written down here once more, from their definition, and not taken from the core; of the core's are normals of
 * vertices and creases, and the table of the split sum, which a unit test integrates. Samples are averaged here, over
 * the background, and encoded as sRGB, in double. X-rays of one ink are blended as they come, without depths: in which
 * order they are makes no difference.
 */
#ifndef ZR_TEST_LOOK_TWIN_H
#define ZR_TEST_LOOK_TWIN_H

#include "reference/generate/batches.h"
#include "reference/gl/reference_program.h"

/* Most pixels of a picture whose surfaces depend on rounding: MAX, and one in PIXELS_PER_UNDECIDED more. */
enum { LOOK_TWIN_UNDECIDED_MAX = 2, LOOK_TWIN_PIXELS_PER_UNDECIDED = 20000 };

/* Largest difference in steps of 255, by rounding of floats. Most such pixels: MAX, and one in PIXELS_PER_NEAR more. */
enum { LOOK_TWIN_SLACK = 1, LOOK_TWIN_NEAR_MAX = 4, LOOK_TWIN_PIXELS_PER_NEAR = 20000 };

/* Names the part of the scene's picture that has no twin; NULL: its colours can be compared. */
const char *look_twin_lacks(const struct zr_scene *scene);

/* look_program.c: the GLSL, which lights samples, or surfaces of given values; or tells values of samples. */
enum look_program { LOOK_PROGRAM_SAMPLES, LOOK_PROGRAM_SURFACES, LOOK_PROGRAM_VALUES, LOOK_PROGRAMS };
struct look_programs {
    unsigned of[LOOK_PROGRAMS]; /* 0: not made yet */
};
unsigned look_program(struct look_programs *programs, enum look_program which, struct reference_error *error);

/* The first with `fixed` of struct reference instead of uniforms; the caller deletes it. */
unsigned look_program_fixed(const char *fixed, struct reference_error *error);

/* A picture to draw. */
struct look_twin {
    struct reference *reference;
    struct zr_arena *arena;
    struct look_programs *programs;
    const struct zr_scene *scene;
    const struct zr_camera *camera;
    struct batches_options options; /* of BATCHES_LIGHT */
    uint64_t *undecided;            /* adds pixels whose surfaces depend on rounding */
};

/* To rgba, row 0 on top, as the channel color has it; gaps[pixel] is set where a sample of it is one. */
bool look_twin_draw(const struct look_twin *twin, uint8_t *rgba, uint8_t *gaps, struct reference_error *error);

/* Values of a whole picture, as uniforms. They are valid until the next call. */
enum { LOOK_UNIFORMS = 20 };
const struct reference_uniform *look_twin_uniforms(const struct look_twin *twin);

/* Draws four floats per sample, each lit by itself, as look_surfaces_draw. */
bool look_twin_light_samples(const struct look_twin *twin, const struct zr_scene *large,
                             const struct reference_arrays *arrays, float *samples, uint8_t *gaps,
                             struct reference_error *error);
enum { LOOK_LAMPS_MAX = 64 };

#endif
