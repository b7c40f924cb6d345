/* image_read.h - input: bytes of a picture of any kind -> an image that textures take their texels from.
 *
 * What it is, its bytes say: PNG or JPEG. Its size is looked at before anything is decoded, and so a small file of a
 * huge picture costs nothing. What is broken or cut short is refused, though libraries would show some of it.
 */
#ifndef ZR_IMAGE_READ_H
#define ZR_IMAGE_READ_H

#include "base/arena.h"
#include "base/status.h"
#include "input/text.h"
#include "scene/image.h"

/* The image's texels, in the arena; beside them `texels_max` may be there at most. What libraries need meanwhile is
 * given back. ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED (arena->cancel), or ZR_BAD_SCENE with the reason. */
enum zr_status zr_image_read(struct zr_arena *arena, const void *bytes, size_t size, uint64_t texels_max,
                             struct zr_image *image, struct zr_reason *reason);

#endif
