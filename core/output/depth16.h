/* depth16.h - output: metric depth -> 16-bit steps.
 *
 * 0 is kept for "nothing there". Depth that does not fit 1..65535 is moved to the
 * nearer of the two ends and counted, never wrapped.
 */
#ifndef ZR_DEPTH16_H
#define ZR_DEPTH16_H

#include "base/team.h"
#include "shade/frame.h"

/* Scene units a step: what was asked for, or, where that is 0, what makes the far plane
 * (without one: the deepest pixel) step 65535. */
float zr_depth16_scale(const struct zr_frame *frame, float asked);

/* Writes width * height steps; returns how many pixels did not fit. `team` may be NULL. */
uint64_t zr_depth16_make(struct zr_team *team, const struct zr_frame *frame, float scale, uint16_t *out);

#endif
