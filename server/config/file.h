/* file.h - the file of settings: lines KEY = VALUE, whose keys are the flags' names, and comments.
 *
 * A # at the beginning of a line or after a space begins a comment. A value with such a # in it, or with a space at
 * one of its ends, stands in double quotes, where \" and \\ mean " and \.
 */
#ifndef ZRASTERD_FILE_H
#define ZRASTERD_FILE_H

#include "faults.h"
#include "settings.h"

enum { FILE_BYTES_MAX = 64 << 10 };

/* Reads the file config->config. */
void file_read(struct config *config, struct faults *faults);

/* Prints a text as a value of the file. */
void file_print_text(const char *text, FILE *out);

#endif
