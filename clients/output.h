/* output.h - client: saves the answer. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <stdbool.h>

#include "bytes.h"
#include "options.h"

/* Saves `picture`, with its Content-Type, and prints the name. Without options->out, the picture of standard input goes
 * to standard output. That of a file is saved in the current folder, under the file's name with the ending of the
 * answer's format. False, with
 * the reason on stderr: it cannot be written, would overwrite its own input, has the ending of another format, or would
 * go to a terminal. */
bool output_save(const struct options *options, const struct bytes *picture, const char *type);

/* Returns true, with a message on stderr, if `out` is the input file. */
bool output_is_input(const struct options *options, const char *out);

#endif
