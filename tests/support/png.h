/* png.h - support: pictures that a failing test leaves for a person to look at. */
#ifndef ZR_TEST_PNG_H
#define ZR_TEST_PNG_H

#include <stdbool.h>
#include <stdint.h>

/* Writes width x height pixels of 4 bytes (RGBA, row 0 on top) to `path`. False
 * where that fails; says why on stderr. */
bool png_file_write(const char *path, const uint8_t *rgba, uint32_t width, uint32_t height);

#endif
