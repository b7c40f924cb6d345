/* point_light.h - effects: light of point clouds, which have no normals, by the distances of nearby pixels.
 *
 * In:     the G-buffer of pixel centres. Out: one factor per pixel, 0 (dark) .. 1, in the layout of the G-buffer.
 * How:    light = 1 / (1 + 1/4 sum of c) with c = clamp((z_tap - z) / (0.02 D), 0, 1), over 8 neighbours at r and 2 r
 *         pixels, where r = max(1, (s + 300) div 600) and s is the window's smaller side. z grows towards the eye, D is
 *         the diagonal of the scene's bounds. Uncovered taps do not count. Nothing is blurred.
 * Exact:  + - * / in one order. */
#ifndef ZR_POINT_LIGHT_H
#define ZR_POINT_LIGHT_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/team.h"
#include "shade/gbuffer.h"

/* Computes the factors of all pixels. `share`: factor of 1/4; `diagonal`: D, in the units of the points. NULL if the
 * arena failed. If cancelled, returns early with undefined values. */
const float *zr_point_light_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                                 const struct zr_gbuffer *pixels, float share, float diagonal);

#endif
