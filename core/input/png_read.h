/* png_read.h - input: a PNG -> RGBA, through libpng.
 *
 * Values pass through as they are: no gamma and no profile is applied; grey and palettes are spread to RGB, and alpha
 * is that of white where the file has none. All memory is the arena's, and nothing of the picture's is taken before its
 * header has been found to match. Cancelled (arena->cancel), reading ends soon, with ZR_CANCELLED.
 */
#ifndef ZR_PNG_READ_H
#define ZR_PNG_READ_H

#include "base/arena.h"
#include "base/status.h"
#include "input/text.h"

#include <stdbool.h>
#include <stdint.h>

/* What the first 33 bytes say. False where they are not those of a PNG. */
struct zr_png_head {
    uint32_t width, height;
    uint32_t bits; /* a sample */
};
bool zr_png_head_read(const void *bytes, size_t size, struct zr_png_head *head);

/* A picture of a size known beforehand, of up to 8 bits a channel: 4 bytes a pixel, row 0 on top. What comes behind the
 * last row is not looked at. ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED, or ZR_BAD_SCENE with the reason. */
enum zr_status zr_png_read(struct zr_arena *arena, const void *bytes, size_t size, uint32_t width, uint32_t height,
                           uint8_t **rgba, struct zr_reason *reason);

/* A picture of any kind, whole: also refused is what libpng warns of, and what lacks its end. `head` is what
 * zr_png_head_read made of it; of 16 bits come four uint16_t a pixel, in the machine's order, else four bytes, into
 * `rgba`, which has room for them and all of which is written. The arena is for libpng. Otherwise as above. */
enum zr_status zr_png_read_whole(struct zr_arena *arena, const void *bytes, size_t size, const struct zr_png_head *head,
                                 void *rgba, struct zr_reason *reason);

#endif
