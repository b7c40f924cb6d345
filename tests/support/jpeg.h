/* jpeg.h - support: JPEGs of every kind, written by libjpeg. */
#ifndef ZR_TEST_JPEG_H
#define ZR_TEST_JPEG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum jpeg_colors { JPEG_GREY, JPEG_YCBCR, JPEG_RGB, JPEG_CMYK, JPEG_YCCK };

struct jpeg_kind {
    enum jpeg_colors colors;
    int across, down; /* samples of the first channel for one of the others: 1 and 1, 2 and 1, 2 and 2 */
    bool is_progressive;
    bool has_refinements; /* grey and progressive: each coefficient in four scans of its own, 253 in all */
    int restart_rows;     /* 0: no restart markers */
    bool is_arithmetic;   /* not Huffman's codes */
    int quality;          /* 1 to 100 */
};

/* width x height pixels, row 0 on top, of as many bytes as the colours have channels: 1, 3 or 4. Into memory that is to
 * be freed; NULL where that fails. */
uint8_t *jpeg_memory_write(const struct jpeg_kind *kind, const uint8_t *pixels, uint32_t width, uint32_t height,
                           size_t *size);

/* The pixels of a JPEG as libjpeg gives them where nothing is said: of 1 byte where it is grey, else RGB. Free them.
 * NULL where libjpeg refuses it. */
uint8_t *jpeg_memory_read(const void *bytes, size_t size, uint32_t *width, uint32_t *height, uint32_t *channels);

#endif
