/* image_file.h - input: limits of an image's size, and the decoders of PNG, JPEG and WebP to RGBA.
 *
 * Values: unchanged, without gamma, profile and Exif orientation. Grey and palettes become RGB; without alpha in the
 *         file, alpha is the maximum.
 * Exact:  the same bytes on every machine: libjpeg's accurate integer transform, whose SIMD versions are exact, without
 *         smoothing of blocks; libwebp's transforms are exact, and nothing is dithered.
 * Memory: the arena's, taken only after the header is checked.
 * Cancel: reading polls arena->cancel and then returns ZR_CANCELLED.
 */
#ifndef ZR_IMAGE_FILE_H
#define ZR_IMAGE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/status.h"
#include "input/files/assets.h"
#include "input/text/text.h"
#include "scene/image.h"

/* Texels per side, as in llvmpipe. */
enum { ZR_IMAGE_SIDE_MAX = 16384 };

/* A file that is decoded. */
struct zr_encoded_image {
    const void *bytes;
    size_t size;
    uint64_t texels_max; /* texels left for the request */
};

/* True if an image of this size may be decoded; else gives the reason. */
bool zr_image_fits(uint32_t width, uint32_t height, uint64_t texels_max, struct zr_reason *reason);

/* ---- png_read.c, through libpng ---- */

/* Reads the size and the depth from the first 33 bytes. False if they are not a PNG's. */
struct zr_png_head {
    uint32_t width, height;
    uint32_t bits; /* per channel */
};
bool zr_png_head_read(const void *bytes, size_t size, struct zr_png_head *head);

/* Decodes an image of the wanted size, up to the wanted bits per channel, to 4 bytes per pixel, row 0 on top. Ignores
 * all bytes after the last row. ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED, or ZR_BAD_SCENE with the reason. */
enum zr_status zr_png_read(struct zr_arena *arena, const struct zr_parsed_bytes *file, const struct zr_png_head *wanted,
                           uint8_t **rgba, struct zr_reason *reason);

/* Decodes a complete file of any size; also refuses files with a libpng warning or without an end. `head`: from
 * zr_png_head_read. Fills `rgba`, width * height pixels: four uint16_t per pixel, in the machine's byte order, if the
 * depth is 16, else four bytes. `arena` is for libpng. Returns as zr_png_read. */
enum zr_status zr_png_read_whole(struct zr_arena *arena, const struct zr_encoded_image *file,
                                 const struct zr_png_head *head, void *rgba, struct zr_reason *reason);

/* ---- jpeg_read.c, through libjpeg ---- */

/* True if the bytes begin like a JPEG. */
bool zr_jpeg_looks_so(const void *bytes, size_t size);

/* Finds the size in the frame header, without decoding. */
bool zr_jpeg_size_read(const void *bytes, size_t size, uint32_t *width, uint32_t *height);

/* Decodes a baseline or progressive JPEG: grey, RGB or YCbCr, 8 bits; alpha is 255. Refuses files with a libjpeg
 * warning or without an end. Checks the size by zr_image_fits before it takes memory. `scratch` is for libjpeg. Returns
 * ZR_OK, ZR_NO_MEMORY (scratch or arena has failed), ZR_CANCELLED (arena->cancel), or ZR_BAD_SCENE with the reason. */
enum zr_status zr_jpeg_read(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_encoded_image *file,
                            struct zr_image *image, struct zr_reason *reason);

/* ---- webp_read.c, through libwebp ---- */

/* True if the bytes begin like a WebP. */
bool zr_webp_looks_so(const void *bytes, size_t size);

/* Decodes a lossy or lossless picture with or without alpha. Refuses animations, and files that are broken or cut off.
 * Checks the size by zr_image_fits before it takes memory. `scratch` is charged for libwebp's memory. Returns ZR_OK,
 * ZR_CANCELLED (arena->cancel), ZR_BAD_SCENE with the reason, or ZR_NO_MEMORY if scratch or arena has failed. */
enum zr_status zr_webp_read(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_encoded_image *file,
                            struct zr_image *image, struct zr_reason *reason);

#endif
