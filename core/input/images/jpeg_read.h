/* jpeg_read.h - input: decodes a JPEG to RGBA, through libjpeg.
 *
 * Values: unchanged, without profile and Exif orientation.
 * Exact:  the same bytes on every machine: by the accurate integer transform, whose SIMD versions are exact, and
 *         without smoothing of blocks.
 */
#ifndef ZR_JPEG_READ_H
#define ZR_JPEG_READ_H

#include "base/arena.h"
#include "base/status.h"
#include "input/images/image_size.h"
#include "scene/image.h"

#include <stdbool.h>

/* True if the bytes begin like a JPEG. */
bool zr_jpeg_looks_so(const void *bytes, size_t size);

/* Finds the size in the frame header, without decoding. */
bool zr_jpeg_size_read(const void *bytes, size_t size, uint32_t *width, uint32_t *height);

/* Decodes a baseline or progressive JPEG: grey, RGB or YCbCr, 8 bits; alpha is 255. Refuses files with a libjpeg
 * warning or without an end. Refuses more than its texels_max (zr_image_fits) before it takes
 * memory for them. `scratch` is for libjpeg. ZR_OK, ZR_NO_MEMORY (scratch or arena has failed), ZR_CANCELLED
 * (arena->cancel), or ZR_BAD_SCENE with the reason. */
enum zr_status zr_jpeg_read(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_encoded_image *file,
                            struct zr_image *image, struct zr_reason *reason);

#endif
