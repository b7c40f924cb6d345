/* tiff.h - output: writes floats as a TIFF, for readers such as libtiff, OpenCV and VTK.
 *
 * Baseline TIFF 6.0: little-endian on every machine, uncompressed, one strip, row 0 on top, 32-bit floats
 * (SampleFormat 3) with one or several samples per pixel.
 * Source: Adobe, "TIFF Revision 6.0", sections 2, 8 and 19. */
#ifndef ZR_TIFF_H
#define ZR_TIFF_H

#include "base/status.h"
#include "output/buffer.h"

#include <stdint.h>

/* Appends the file to `out`. `values` are width * height * words floats; `words`: samples per pixel, 1 to 4. Returns
 * ZR_OK, ZR_NO_MEMORY, or ZR_INTERNAL if the file would have 4 GiB or more. */
enum zr_status zr_tiff_write(const float *values, uint32_t width, uint32_t height, uint32_t words,
                             struct zr_buffer *out);

#endif
