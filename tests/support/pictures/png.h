/* png.h - support: writes and reads PNGs by libpng. */
#ifndef ZR_TEST_PNG_H
#define ZR_TEST_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Writes width x height pixels of 4 bytes (RGBA, row 0 on top) to `path`. On failure, returns false and prints the
 * reason on stderr. */
bool png_file_write(const char *path, const uint8_t *rgba, uint32_t width, uint32_t height);

/* The same into memory; free it. NULL on failure. */
uint8_t *png_memory_write(const uint8_t *rgba, uint32_t width, uint32_t height, size_t *size);

enum png_pixels {
    PNG_AS_RGB,   /* 3 bytes per pixel, without alpha */
    PNG_AS_RGBA,  /* 4 bytes per pixel */
    PNG_AS_GREY16 /* uint16_t in the machine's order */
};

/* Decodes a PNG, row 0 on top; free the pixels. Palettes and fewer bits are expanded. A file must have 16 bits per
 * sample if `pixels` is PNG_AS_GREY16, and must not otherwise. NULL if libpng's low-level reader, which checks the
 * stream, refuses the file, or if bytes follow its end. */
void *png_memory_read(const void *bytes, size_t size, enum png_pixels pixels, uint32_t *width, uint32_t *height);

#endif
