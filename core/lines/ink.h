/* ink.h - lines, last step: lays ink over finished pixels.
 *
 * Space:  stored values (sRGB-encoded): lines look equally heavy on light and dark grounds, as in other programs.
 * How:    ink of opacity a over a pixel of colour c and alpha b: alpha a + b (1 - a), colour the mean of both, weighted
 *         by a and b (1 - a); over opaque pixels c + (ink - c) a. Rounded half up.
 * Exact:  floats; the same for any number of threads. */
#ifndef ZR_INK_H
#define ZR_INK_H

#include <stdint.h>

#include "base/cancel.h"
#include "base/run.h"
#include "base/team.h"
#include "base/vec.h"

/* `opacity`: rows of `width`, row 0 the lowest. `color`: of the ink, 0..1. `pixels`: RGBA, row 0 on top. */
void zr_ink_lay(const struct zr_run *run, const float *opacity, zr_vec3 color, uint32_t width, uint32_t height,
                uint8_t *pixels);

#endif
