/* lossy.h - output: colours as JPEG or WebP, whose bytes depend on the library and its version.
 *
 * Memory: a try's memory is freed after it. libjpeg's is in the arena; libwebp's is charged to it before (webp.c). */
#ifndef ZR_LOSSY_H
#define ZR_LOSSY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/run.h"
#include "base/status.h"
#include "output/bytes/buffer.h"

/* Most files that are made to find the quality for a number of bytes. */
enum { ZR_LOSSY_TRIES = 6 };

struct zr_lossy {
    uint32_t width, height;
    const uint8_t *rgba; /* row 0 is the top; a JPEG has no alpha */
    bool has_alpha;      /* WebP; else alpha is left out */
    bool is_lossless;    /* WebP: each pixel is kept, colours under alpha 0 too */
    bool is_small;       /* lossless WebP: some percent fewer bytes in three times the time */
    uint32_t quality;    /* 1..100 */
    float dpi;           /* JPEG: whole pixels per inch that the file names; 0: none */
};

struct zr_lossy_file {
    unsigned char *bytes; /* NULL: more than the most bytes that were allowed */
    size_t size;
    uint32_t quality;
};

/* Encodes the picture. The bytes are in `arena` if they are at most `most`. Return ZR_OK, ZR_NO_MEMORY, ZR_CANCELLED or
 * ZR_INTERNAL. */
typedef enum zr_status zr_lossy_write_fn(struct zr_arena *arena, const struct zr_lossy *image, size_t most,
                                         const struct zr_cancel *cancel, struct zr_lossy_file *file);
zr_lossy_write_fn zr_jpeg_write, zr_webp_write;

/* Ends a try: copies a file of at most `most` bytes from `scratch` to `arena`, and closes `scratch`. Returns `status`,
 * or ZR_NO_MEMORY. */
enum zr_status zr_lossy_end_try(struct zr_arena *arena, struct zr_arena *scratch, const struct zr_buffer *out,
                                size_t most, enum zr_status status, struct zr_lossy_file *file);

/* Returns the library with its version. */
const char *zr_jpeg_encoder(void);
struct zr_webp_encoder {
    char text[32];
};
struct zr_webp_encoder zr_webp_encoder(void);

/* Encodes the picture at image->quality or, if that has more than `most` bytes, at the best quality below that is found
 * in ZR_LOSSY_TRIES tries, which halve the range. So no quality is missed by more than three. If none fits, file->bytes
 * is NULL and file->size the smallest size found, that of quality 1. A lossless file is made once. */
enum zr_status zr_lossy_fit(const struct zr_run *run, zr_lossy_write_fn *write, const struct zr_lossy *image,
                            size_t most, struct zr_lossy_file *file);

#endif
