/* output.h - client: names and saves the files of an answer. */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <stdbool.h>

#include "bytes.h"
#include "engine/answer.h"
#include "options/options.h"

/* The destination of the outputs of a file. */
struct target {
    const char *file;   /* the input; "-": standard input */
    const char *out;    /* name of the only output, "-", or NULL: FOLDER/STEM.ext; STEM.channel.ext of several */
    const char *folder; /* "": the current one */
    const char *stem;   /* name in the folder, whose ending is replaced; may have folders of its own */
    bool keeps_ending;  /* the ending of the stem is kept before the output's: part.stl.png */
};

/* Makes the target of a file for the option -o, which may be NULL. */
struct target output_target(const char *file, const char *out);

/* Returns true if a name can only be that of an output. */
bool output_is_name(const char *name);

/* Sets the encoding that the output's name ends with, such as svg, jpeg or tiff, and the channel that it is for, unless
 * the options give them. */
void output_set_encoding(struct options *options);

/* Checks before drawing: the folder exists (a name with a slash at its end makes it), the input is not overwritten,
 * the ending is that of an output, or none of a known format if the options give an encoding. Returns 0, or an exit status with lines in *faults. */
int output_check(const struct target *target, bool has_encoding, struct bytes *faults);

/* Saves the files of an answer and adds their names to *names, each with a final zero. Returns 0 or an exit
 * status with lines in *faults. */
int output_save(const struct target *target, const struct answer *answer, bool no_clobber, struct bytes *names,
                struct bytes *faults);

/* Returns the name of the output CHANNEL.EXT, to be freed; NULL without memory. */
char *output_name(const struct target *target, const char *channel, const char *extension);

/* Returns the beginning of the names of all outputs, to be freed: FOLDER/STEM without its ending; NULL without memory.
 */
char *output_name_begin(const struct target *target);

/* Returns the last part of a path. */
const char *output_base(const char *path);

/* Makes the folders of a path. One that cannot be made is reported when the file is written. */
void output_make_folders(char *path);

bool output_is_folder(const char *path);

/* Returns true if a name is that of a folder or may become one: it does not exist, and its ending is no file's. */
bool output_may_be_folder(const char *path);

#endif
