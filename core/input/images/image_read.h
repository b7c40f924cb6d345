/* image_read.h - input: decodes the image of a texture: PNG, JPEG or WebP.
 *
 * The first bytes decide the format. The size is checked before decoding, so that a small file of a huge image costs no
 * time. Broken and truncated files are refused, though libraries would decode a part of them.
 */
#ifndef ZR_IMAGE_READ_H
#define ZR_IMAGE_READ_H

#include "base/arena.h"
#include "base/status.h"
#include "core.h"
#include "input/images/image_file.h"
#include "scene/image.h"

/* Decodes an image of up to file->texels_max texels into the arena. Frees the libraries' memory at the end.
 * ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED (arena->cancel), or ZR_BAD_SCENE with the reason. */
enum zr_status zr_image_read(struct zr_arena *arena, const struct zr_encoded_image *file, struct zr_image *image,
                             struct zr_reason *reason);

/* Reads an image that the caller may have kept: takes it from `images`, or decodes it and offers it to them. Both ways
 * have the same result and take the same memory from the arena. */
enum zr_status zr_image_read_kept(struct zr_arena *arena, const struct zr_kept_images *images,
                                  const struct zr_encoded_image *file, struct zr_image *image,
                                  struct zr_reason *reason);

/* Steps of zr_image_read_kept, for several images at once. */

/* Reads the size and the bits of a file without decoding it. False if it may not be decoded. */
bool zr_image_head_read(const struct zr_encoded_image *file, struct zr_image *head);

/* Decodes as zr_image_read. The libraries allocate from `scratch`, which may be a scratch arena of `arena`. */
enum zr_status zr_image_decode(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_encoded_image *file,
                               struct zr_kept_image *out, struct zr_reason *reason);

/* Returns a channel of a texel as 16 bits. */
static inline uint32_t zr_image_texel(const struct zr_image *image, size_t x, size_t y, uint32_t channel)
{
    const size_t at = 4 * (y * image->width + x) + channel;
    return image->bits == 8 ? ((const uint8_t *)image->texels)[at] * 257u : ((const uint16_t *)image->texels)[at];
}

#endif
