/* pfm.h - output: floats as a portable float map (PFM), little-endian, bottom row first. */
#ifndef ZR_PFM_H
#define ZR_PFM_H

#include <stdint.h>

#include "base/status.h"
#include "output/bytes/buffer.h"

/* Appends the file to `out`. `components`: 1 (Pf) or 3 (PF) per pixel. Row 0 of `values` is the top. Returns ZR_OK or
 * ZR_NO_MEMORY. */
enum zr_status zr_pfm_write(uint32_t width, uint32_t height, uint32_t components, const float *values,
                            struct zr_buffer *out);

#endif
