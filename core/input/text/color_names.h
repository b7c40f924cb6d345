/* color_names.h - input: colours by name. */
#ifndef ZR_COLOR_NAMES_H
#define ZR_COLOR_NAMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ZR_COLOR_NAME_MAX = 20 }; /* letters: lightgoldenrodyellow */

/* Finds one of the 148 names of CSS Color Module Level 4, section 6.1, in any case; *rgb: 0xRRGGBB. */
bool zr_color_of_name(const char *name, size_t length, uint32_t *rgb);

/* Returns name i in alphabetical order; NULL after the last. */
const char *zr_color_name(size_t i);

#endif
