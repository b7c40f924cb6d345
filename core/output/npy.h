/* npy.h - output: writes arrays in NumPy's format, for numpy.load(file).
 *
 * Format 1.0, little-endian on every machine; shape (height, width), or (height, width, components) for several
 * components; row 0 on top.
 * Source: NumPy enhancement proposal 1, "A Simple File Format for NumPy Arrays". */
#ifndef ZR_NPY_H
#define ZR_NPY_H

#include "base/status.h"
#include "output/bytes/buffer.h"

#include <stdint.h>

enum zr_npy_type { ZR_NPY_FLOAT32, ZR_NPY_UINT32 };

/* Appends the header of an array of up to four axes to `out`. */
enum zr_status zr_npy_begin(enum zr_npy_type type, const size_t *shape, size_t axes, struct zr_buffer *out);

/* Bytes of a header. */
enum { ZR_NPY_HEADER = 128 };

/* Appends the file to `out`. `values` are width * height * components numbers of 4 bytes. Returns ZR_OK or
 * ZR_NO_MEMORY. */
enum zr_status zr_npy_write(enum zr_npy_type type, uint32_t width, uint32_t height, uint32_t components,
                            const void *values, struct zr_buffer *out);

#endif
