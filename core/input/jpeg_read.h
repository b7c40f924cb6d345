/* jpeg_read.h - input: a JPEG -> RGBA, through libjpeg.
 *
 * Values pass through as they are: no profile is applied, and no orientation of Exif. The same bytes on every machine:
 * the accurate integer transform, whose SIMD kinds are exact, and no smoothing of blocks.
 */
#ifndef ZR_JPEG_READ_H
#define ZR_JPEG_READ_H

#include "base/arena.h"
#include "base/status.h"
#include "input/text.h"
#include "scene/image.h"

#include <stdbool.h>

/* How all JPEGs begin. */
bool zr_jpeg_looks_so(const void *bytes, size_t size);

/* Baseline and progressive, grey, RGB and YCbCr, of 8 bits; alpha is 255. Refused is what libjpeg warns of, what lacks
 * its end, and what has more than `texels_max` texels (zr_image_fits: input/image_size.h), before memory is taken for
 * it. `scratch` is for libjpeg. ZR_OK, ZR_NO_MEMORY (scratch or arena has failed), ZR_CANCELLED (arena->cancel), or
 * ZR_BAD_SCENE with the reason. */
enum zr_status zr_jpeg_read(struct zr_arena *arena, struct zr_arena *scratch, const void *bytes, size_t size,
                            uint64_t texels_max, struct zr_image *image, struct zr_reason *reason);

#endif
