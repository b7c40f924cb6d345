/* output.h - client: where what came back is saved. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <stdbool.h>

#include "bytes.h"
#include "options.h"

/* Saves `picture`, of that Content-Type, under options->out; where that is NULL, to standard output if it was made from
 * standard input, else under the input's name with the ending of what came back, in this folder. Tells the name. False,
 * and stderr says why, where it cannot be saved, or should not: over its own input, under the ending of another format,
 * or onto a terminal. */
bool output_save(const struct options *options, const struct bytes *picture, const char *type);

/* Would it be saved over its own input? Then stderr says so. */
bool output_is_input(const struct options *options, const char *out);

#endif
