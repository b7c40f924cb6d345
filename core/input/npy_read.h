/* npy_read.h - input: an array as numpy.save writes it -> one number a pixel.
 *
 * Source: NumPy enhancement proposal 1, "A Simple File Format for NumPy Arrays", versions
 *         1.0, 2.0 and 3.0. The header is a Python dictionary of three known keys, of which
 *         no more is understood than NumPy itself writes.
 */
#ifndef ZR_NPY_READ_H
#define ZR_NPY_READ_H

#include "base/arena.h"
#include "base/status.h"
#include "input/text.h"

#include <stdint.h>

enum zr_npy_wanted { ZR_NPY_WANTED_FLOAT32, ZR_NPY_WANTED_UINT32 };

/* height * width numbers of 4 bytes in the machine's order, a copy in the arena. Either
 * byte order is read; shape, type and size must be right to the byte. ZR_OK,
 * ZR_NO_MEMORY, or ZR_BAD_SCENE with the reason. */
enum zr_status zr_npy_read(struct zr_arena *arena, const void *bytes, size_t size, enum zr_npy_wanted wanted,
                           uint32_t width, uint32_t height, void **values, struct zr_reason *reason);

#endif
