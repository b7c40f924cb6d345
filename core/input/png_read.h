/* png_read.h - input: a PNG of a size known beforehand -> RGBA, through libpng.
 *
 * Values pass through as they are: no gamma and no profile is applied. All memory is the
 * arena's, and nothing of the picture's is taken before its header has been found to match.
 */
#ifndef ZR_PNG_READ_H
#define ZR_PNG_READ_H

#include "base/arena.h"
#include "base/status.h"
#include "input/text.h"

#include <stdint.h>

/* 4 bytes a pixel, row 0 on top: grey and palettes are spread to RGB, and alpha is 255
 * where the file has none. Up to 8 bits a channel. ZR_OK, ZR_NO_MEMORY, or ZR_BAD_SCENE with the reason. */
enum zr_status zr_png_read(struct zr_arena *arena, const void *bytes, size_t size, uint32_t width, uint32_t height,
                           uint8_t **rgba, struct zr_reason *reason);

#endif
