/* tiff.h - output: floats as a TIFF: little-endian, float32 samples, one uncompressed strip, top row first. */
#ifndef ZR_TIFF_H
#define ZR_TIFF_H

#include <stdint.h>

#include "base/status.h"
#include "output/bytes/buffer.h"

/* Appends the file to `out`. The pixels have at most ZR_TIFF_BYTES_MAX. `components`: 1 to 3 per pixel; 3 are marked as
 * RGB, which readers pass on unchanged. Returns ZR_OK or ZR_NO_MEMORY. */
enum zr_status zr_tiff_write(uint32_t width, uint32_t height, uint32_t components, const float *values,
                             struct zr_buffer *out);

#endif
