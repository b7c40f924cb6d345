/* png.h - support: PNG: pictures that tests leave for a person to look at, and whether two are the same. */
#ifndef ZR_TEST_PNG_H
#define ZR_TEST_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Writes width x height pixels of 4 bytes (RGBA, row 0 on top) to `path`. False
 * where that fails; says why on stderr. */
bool png_file_write(const char *path, const uint8_t *rgba, uint32_t width, uint32_t height);

/* The same into memory that is to be freed; NULL where that fails. */
uint8_t *png_memory_write(const uint8_t *rgba, uint32_t width, uint32_t height, size_t *size);

/* Whether two files decode to the same RGBA pixels. That is what a PNG promises: its bytes depend on where in memory it
 * was deflated (core/output/idat.h). */
bool png_same_pixels(const void *a, size_t a_size, const void *b, size_t b_size);

#endif
