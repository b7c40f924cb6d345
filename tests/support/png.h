/* png.h - support: PNG, by libpng: pictures that tests leave for a person to look at, and what is in a file. */
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

enum png_pixels {
    PNG_AS_RGB,   /* 3 bytes a pixel; alpha is left out */
    PNG_AS_RGBA,  /* 4 bytes a pixel */
    PNG_AS_GREY16 /* uint16_t in the machine's order */
};

/* The pixels of a PNG, row 0 on top; free them. Whatever an encoder made of them (a palette, fewer bits) is undone, but
 * for 16 bits a sample: a file has them where PNG_AS_GREY16 is asked for, and there alone. NULL where libpng's
 * low-level reader, whose checks of the stream count, refuses the file, or where bytes are left behind its end. */
void *png_memory_read(const void *bytes, size_t size, enum png_pixels pixels, uint32_t *width, uint32_t *height);

#endif
