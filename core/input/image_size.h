/* image_size.h - input: how large an image may be, which is asked before anything of it is decoded. */
#ifndef ZR_IMAGE_SIZE_H
#define ZR_IMAGE_SIZE_H

#include "input/text.h"

#include <stdbool.h>
#include <stdint.h>

/* Texels from side to side, as llvmpipe has it. */
enum { ZR_IMAGE_SIDE_MAX = 16384 };

/* Whether a picture of this size may be decoded; if not, with the reason. `texels_max`: what is left for it. */
bool zr_image_fits(uint32_t width, uint32_t height, uint64_t texels_max, struct zr_reason *reason);

#endif
