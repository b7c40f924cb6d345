/* parameter_names.h - input: names of a query's parameters (parameter_rows.h) in messages about the keys they set. */
#ifndef ZR_PARAMETER_NAMES_H
#define ZR_PARAMETER_NAMES_H

#include "base/status.h"

/* Copies a text; names of parameters replace the keys of the object at `pointer` that they set. If a key is missing,
 * the help of its parameter replaces the words about it. */
struct zr_parameter_text {
    char text[ZR_DETAIL_SIZE];
};
struct zr_parameter_text zr_parameter_names(const char *pointer, const char *text);

#endif
