/* ssim.h - client: structural similarity of two pictures. */
#ifndef SSIM_H
#define SSIM_H

#include "pixels.h"

/* Returns the mean SSIM of the luma over white: 1 for equal pictures. Windows are Gaussians of 11 x 11 pixels, as in the
 * paper. Both pictures have one size and depth. Returns -2 if a side is shorter than a window, or without memory.
 * Source: Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment", 2004. */
double ssim_of(const struct pixels *a, const struct pixels *b);

#endif
