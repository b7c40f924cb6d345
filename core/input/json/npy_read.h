/* npy_read.h - input: reads arrays of numpy.save.
 *
 * Source: NumPy enhancement proposal 1, "A Simple File Format for NumPy Arrays", versions 1.0, 2.0 and 3.0. The header
 *         is a Python dictionary of three keys; only the syntax that NumPy writes is accepted.
 */
#ifndef ZR_NPY_READ_H
#define ZR_NPY_READ_H

#include "base/arena.h"
#include "base/array.h"
#include "base/status.h"
#include "input/files/assets.h"
#include "input/text/text.h"

#include <stdint.h>

/* The array of a window: one number per pixel. */
struct zr_npy_wanted {
    bool is_float; /* float32; false: uint32 */
    uint32_t width, height;
};

/* Finds the numbers of a file, which are not copied. Big-endian numbers, Fortran order, other types and more dimensions
 * than ZR_ARRAY_SIDES_MAX are refused. False with the reason. */
bool zr_npy_open(const void *bytes, size_t size, struct zr_array *out, struct zr_reason *reason);

/* Copies height * width numbers, one per pixel, of 4 bytes into the arena, in the machine's byte order. The file may
 * have either byte order; its shape, type and size must match exactly. ZR_OK, ZR_NO_MEMORY, or ZR_BAD_SCENE with the
 * reason. */
enum zr_status zr_npy_read(struct zr_arena *arena, const struct zr_parsed_bytes *file,
                           const struct zr_npy_wanted *wanted, void **values, struct zr_reason *reason);

#endif
