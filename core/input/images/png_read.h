/* png_read.h - input: decodes a PNG to RGBA, through libpng.
 *
 * Values: unchanged, without gamma or profile. Grey and palettes become RGB; without alpha in the file, alpha is the
 *         maximum.
 * Memory: the arena's, taken only after the header is checked.
 * Cancel: reading polls arena->cancel and then returns ZR_CANCELLED.
 */
#ifndef ZR_PNG_READ_H
#define ZR_PNG_READ_H

#include "base/arena.h"
#include "base/status.h"
#include "input/files/assets.h"
#include "input/images/image_size.h"

#include <stdbool.h>
#include <stdint.h>

/* Reads the size and the depth from the first 33 bytes. False if they are not a PNG's. */
struct zr_png_head {
    uint32_t width, height;
    uint32_t bits; /* per channel */
};
bool zr_png_head_read(const void *bytes, size_t size, struct zr_png_head *head);

/* Decodes an image of the wanted size, up to the wanted bits per channel, to 4 bytes per pixel, row 0 on top. Ignores all bytes
 * after the last row. ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED, or ZR_BAD_SCENE with the reason. */
enum zr_status zr_png_read(struct zr_arena *arena, const struct zr_parsed_bytes *file, const struct zr_png_head *wanted,
                           uint8_t **rgba, struct zr_reason *reason);

/* Decodes a complete file of any size; also refuses files with a libpng warning or without an end. `head`: from
 * zr_png_head_read. Fills `rgba`, width * height pixels: four uint16_t per pixel, in the machine's byte order, if the
 * depth is 16, else four bytes. `arena` is for libpng. Returns as zr_png_read. */
enum zr_status zr_png_read_whole(struct zr_arena *arena, const struct zr_encoded_image *file,
                                 const struct zr_png_head *head, void *rgba, struct zr_reason *reason);

#endif
