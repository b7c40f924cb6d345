/* color_text.h - input: colours that are written as a text. */
#ifndef ZR_COLOR_TEXT_H
#define ZR_COLOR_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "base/vec.h"

/* "#rrggbb", "#rrggbbaa", "#rgb", "#rgba" or a name (color_names.h), of this length; alpha 1 where not given. */
bool zr_color_of_text(const char *text, size_t length, zr_vec4 *out);

#endif
