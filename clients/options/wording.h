/* wording.h - client: faults of the library and the server in the words of the command. */
#ifndef WORDING_H
#define WORDING_H

#include "files/input.h"

/* Rewrites lines of faults: "parameter light: lightPosition is missing" becomes "--light: --light-position is missing".
 * A size by --size has one fault instead of those of width and height. Phrases about requests, parts and media types
 * become those about files, --part and endings. A missing part gets the reason why its file is not read. Nothing
 * changes without memory. */
void wording_translate(struct bytes *faults, const struct input *input, const struct options *options);

/* Returns true if a line is the fault of an option: "--light: ...". */
bool wording_is_option(const char *line);

#endif
