/* reference_blend.h - reference: GL's blending into 32-bit floats. */
#ifndef ZR_TEST_REFERENCE_BLEND_H
#define ZR_TEST_REFERENCE_BLEND_H

#include "reference/gl/reference.h"

/* Of a window of the size last given to reference_resize, which is that of all arrays: 4 floats a pixel, row 0 on top.
 * Begins with `rgba`, lays layers over it (GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA; of alpha GL_ONE), each a point a
 * pixel, and reads what came of it. */
bool reference_blend_begin(struct reference *reference, const float *rgba, struct reference_error *error);
bool reference_blend_layer(struct reference *reference, const float *rgba, struct reference_error *error);
bool reference_blend_end(struct reference *reference, float *rgba, struct reference_error *error);

#endif
