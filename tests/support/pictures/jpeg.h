/* jpeg.h - support: JPEGs of every kind, written by libjpeg. */
#ifndef ZR_TEST_JPEG_H
#define ZR_TEST_JPEG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum jpeg_colors { JPEG_GREY, JPEG_YCBCR, JPEG_RGB, JPEG_CMYK, JPEG_YCCK };

struct jpeg_kind {
    enum jpeg_colors colors;
    int across,
        down; /* subsampling: samples of the first channel per sample of the others: 1 and 1, 2 and 1, 2 and 2 */
    bool is_progressive;
    bool has_refinements; /* grey and progressive: four scans per coefficient, 253 in all */
    int restart_rows;     /* 0: no restart markers */
    bool is_arithmetic;   /* arithmetic instead of Huffman coding */
    int quality;          /* 1 to 100 */
};

/* Encodes width x height pixels, row 0 on top, with 1, 3 or 4 bytes per pixel, as the colours have channels. Free the
 * result; NULL on failure. */
uint8_t *jpeg_memory_write(const struct jpeg_kind *kind, const uint8_t *pixels, uint32_t width, uint32_t height,
                           size_t *size);

/* Decodes a JPEG with libjpeg's defaults: 1 byte per pixel if it is grey, else RGB. Free the result; NULL if libjpeg
 * refuses the file. */
uint8_t *jpeg_memory_read(const void *bytes, size_t size, uint32_t *width, uint32_t *height, uint32_t *channels);

#endif
