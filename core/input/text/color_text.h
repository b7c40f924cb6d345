/* color_text.h - input: colours written as text, and their names. */
#ifndef ZR_COLOR_TEXT_H
#define ZR_COLOR_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

/* Reads "#rrggbb", "#rrggbbaa", "#rgb", "#rgba", "transparent" or a name, `length` characters; default
 * alpha: 1. */
bool zr_color_of_text(const char *text, size_t length, zr_vec4 *out);

/* Returns the value, 0..1, of a byte. */
static inline float zr_color_channel(int byte)
{
    return (float)byte * (1.0f / 255.0f);
}

enum { ZR_COLOR_NAME_MAX = 20 }; /* letters: lightgoldenrodyellow */

/* Finds one of the 148 names of CSS Color Module Level 4, section 6.1, in any case; *rgb: 0xRRGGBB. */
bool zr_color_of_name(const char *name, size_t length, uint32_t *rgb);

/* Returns name i in alphabetical order; NULL after the last. */
const char *zr_color_name(size_t i);

#endif
