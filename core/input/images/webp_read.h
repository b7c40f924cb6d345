/* webp_read.h - input: decodes a WebP to RGBA, through libwebp.
 *
 * Values: unchanged, without profile and Exif orientation.
 * Exact:  the same bytes on every machine: libwebp's transforms are exact, and nothing is dithered.
 */
#ifndef ZR_WEBP_READ_H
#define ZR_WEBP_READ_H

#include "base/arena.h"
#include "base/status.h"
#include "input/images/image_size.h"
#include "scene/image.h"

#include <stdbool.h>

/* True if the bytes begin like a WebP. */
bool zr_webp_looks_so(const void *bytes, size_t size);

/* Decodes a lossy or lossless picture with or without alpha. Refuses animations, and files that are broken or cut off.
 * Refuses more than its texels_max (zr_image_fits) before it takes memory for them. `scratch`
 * is charged for libwebp's memory. Returns ZR_OK, ZR_CANCELLED (arena->cancel), ZR_BAD_SCENE with the reason, or
 * ZR_NO_MEMORY if scratch or arena has failed. */
enum zr_status zr_webp_read(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_encoded_image *file,
                            struct zr_image *image, struct zr_reason *reason);

#endif
