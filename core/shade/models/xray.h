/* xray.h - shade: what surfaces of the shading xray let through.
 *
 * Each layer has an opacity a by the cosine c between its normal and the way to the eye, so that walls seen along their
 * surface are drawn, and those that face the eye hardly are:
 *
 *     a = 0.07 + 0.68 (1 - |c|)^3
 *
 * Over one another, they let pass the product of all 1 - a, whatever their order; of one ink, the picture is the ink
 * mixed with the background by that product. Inks of several colours are laid over one another as everything that is
 * blended is (render/layers.h).
 */
#ifndef ZR_XRAY_H
#define ZR_XRAY_H

#include "shade/lights/lighting.h"

/* Multiplies the opacities of samples of that shading; lines keep theirs. At the same places as the samples'; up to 15
 * more behind each row's end may be looked at, and written. A kernel. */
typedef void zr_xray_fn(const struct zr_linear_lighting *lighting, const struct zr_gbuffer *samples, float *opacity);

ZR_KERNEL_TABLE(zr_xray_fn, zr_xray)

#endif
