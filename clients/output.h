/* output.h - client: names and saves the files of an answer. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <stdbool.h>

#include "answer.h"
#include "bytes.h"
#include "options.h"

/* Where the outputs of a file go. */
struct target {
    const char *file;   /* the input; "-": standard input */
    const char *out;    /* name of the only output, "-", or NULL: FOLDER/STEM.ext, of several STEM.channel.ext */
    const char *folder; /* "": this one */
    const char *stem;   /* name in the folder, whose ending is replaced; may have folders of its own */
};

/* Makes the target of a file for the option -o, which may be NULL. */
struct target output_target(const char *file, const char *out);

/* Returns true if a name can only be one of an output. */
bool output_is_name(const char *name);

/* Checks before drawing: the folder exists (one named with a slash at its end is made), the input is not overwritten,
 * the ending is one of an output. Returns 0, or an exit status with lines in *faults. */
int output_check(const struct target *target, struct bytes *faults);

/* Saves the files of an answer and adds their names to *names, each with a final zero. Returns 0 or an exit
 * status with lines in *faults. */
int output_save(const struct target *target, const struct answer *answer, bool no_clobber, struct bytes *names,
                struct bytes *faults);

/* Returns, to be freed, the name that the output CHANNEL.EXT gets; NULL without memory. */
char *output_name(const struct target *target, const char *channel, const char *extension);

/* Returns the last part of a path. */
const char *output_base(const char *path);

bool output_is_folder(const char *path);

/* Returns true if a name is that of a folder, or may become one: nothing has it, and its ending names no file. */
bool output_may_be_folder(const char *path);

#endif
