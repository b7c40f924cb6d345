/* look_surfaces.h - reference: pictures in linear light whose surfaces are lit once per pixel (rule 23a).
 *
 * The reference returns for each sample the number of a corner, which tells the primitive, and the values that it
 * interpolates. surface_rule.h finds the surfaces. The program that lights samples of other pictures then lights
 * each surface, drawn as a point in the place of one of its samples.
 */
#ifndef ZR_TEST_LOOK_SURFACES_H
#define ZR_TEST_LOOK_SURFACES_H

#include "reference/gl/look_twin.h"

/* True if surfaces of the scene are lit once per pixel, false if each sample is. */
bool look_surfaces_are_lit(const struct zr_scene *scene);

/* Draws four floats per sample, linear light and 1, or 0 where nothing is. `large`: the scene with a pixel for each
 * sample, the size of the reference. `arrays`: its own of BATCHES_LIGHT, with sides as look_program.c has them. Samples
 * of pixels whose surfaces depend on rounding become gaps; twin->undecided counts these pixels. */
bool look_surfaces_draw(const struct look_twin *twin, const struct zr_scene *large,
                        const struct reference_arrays *arrays, float *samples, uint8_t *gaps,
                        struct reference_error *error);

#endif
