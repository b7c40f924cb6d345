/* color_text.h - input: colours written as text. */
#ifndef ZR_COLOR_TEXT_H
#define ZR_COLOR_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "base/vec.h"

/* Reads "#rrggbb", "#rrggbbaa", "#rgb", "#rgba", "transparent" or a name (color_names.h), `length` characters; default
 * alpha: 1. */
bool zr_color_of_text(const char *text, size_t length, zr_vec4 *out);

/* Returns the value, 0..1, of a byte. */
static inline float zr_color_channel(int byte)
{
    return (float)byte * (1.0f / 255.0f);
}

#endif
