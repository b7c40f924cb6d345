/* xray.h - shade: opacity of surfaces with the shading xray, and of glass (glass_simd.h).
 *
 * The opacity a of a layer depends on the cosine c between its normal and the direction to the eye. It rises towards
 * grazing angles:
 *
 *     a = (0.15 + 0.76 (1 - |c|)^2) (1 - 0.4 x)
 *
 * x is that of the normal once turned towards the eye: walls that face left are denser, so that sides of a part differ.
 * Several layers transmit the product of all 1 - a, in any order. If all have one colour, the picture is that colour
 * mixed with the background by the product. Several colours are blended like other layers (render/layers/layers.h).
 */
#ifndef ZR_XRAY_H
#define ZR_XRAY_H

#include "shade/lights/lighting.h"

/* Multiplies the opacities of samples with that shading, and of glass; lines keep theirs. `opacity` is laid out like
 * the samples. Up to 15 values beyond each row's end may be read and written. A kernel. */
typedef void zr_xray_fn(const struct zr_linear_lighting *lighting, const struct zr_gbuffer *samples, float *opacity);

ZR_KERNEL_TABLE(zr_xray_fn, zr_xray)

#endif
