/* occlusion.h - look: ambient occlusion: how much of the light from all around reaches each pixel's centre.
 *
 * In:     the G-buffer of pixel centres (owner, normal, point). Out: one float a pixel, 0 (dark) .. 1 (open), laid out
 *         as the G-buffer is; 1 where nobody is seen.
 * How:    8 directions of 4 steps, interleaved over 4 x 4 pixels, then a separable 5 x 5 blur over pixels on the same
 *         plane.
 * Exact:  + - * / and sqrt in one order: every instruction set and thread count gives the same bytes.
 */
#ifndef ZR_OCCLUSION_H
#define ZR_OCCLUSION_H

#include "base/arena.h"
#include "base/team.h"
#include "shade/gbuffer.h"
#include "scene/picture.h"
#include "zraster.h"

/* How large a length at a point is in pixels: pixels = length * scale / (slope . point + offset), which is the point's
 * w of clip space. */
struct zr_pixel_scale {
    float scale;
    float slope[3], offset;
};

/* `diagonal` is that of the scene's bounds. NULL where the arena has failed. Cancelled, it returns early, with numbers
 * that mean nothing. */
const float *zr_occlusion_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                               const struct zr_gbuffer *pixels, const struct zr_occlusion *occlusion,
                               const struct zr_pixel_scale *scale, float diagonal);

#endif
