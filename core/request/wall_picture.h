/* wall_picture.h - request: the channel wall as a picture of colours with a colour bar.
 *
 * Colours: the map turbo, thin walls blue, from 0 to the thickness that 98 % of the pixels have at most. Thicker ones
 *          have the last colour. Pixels without a wall are white. */
#ifndef ZR_WALL_PICTURE_H
#define ZR_WALL_PICTURE_H

#include <stdint.h>

#include "base/run.h"

/* Returns the colours, four bytes per pixel as base/rgba.h makes them, in the arena. NULL without memory or if
 * cancelled. */
uint32_t *zr_wall_picture_make(const struct zr_run *run, const float *walls, uint32_t width, uint32_t height);

#endif
