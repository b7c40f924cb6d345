/* resume.h - client: outputs of an earlier batch, and the settings that they were drawn with.
 *
 * The file .zraster-batch in the folder of the outputs has the settings of the last batch. It is written when they
 * change, so that older outputs are those of other settings. */
#ifndef RESUME_H
#define RESUME_H

#include <time.h>

#include "engine/job.h"

struct resume {
    struct timespec since; /* outputs before have other settings */
    struct timespec list;  /* --list was changed: outputs of lines with options of their own are older */
};

/* Writes the settings, before anything is drawn, if they are not those of the last batch. Tells that on stderr if the
 * batch resumes. Returns 0, or the exit status of a folder that cannot be written. */
int resume_open(struct resume *resume, const struct options *options);

/* Returns true if every output of a job exists, with these settings. `has_own` options: it is a line of the list with
 * some. False also if their names are not known before drawing. Thread-safe after tables_open. */
bool resume_has_all(const struct resume *resume, const struct job *job, bool has_own);

#endif
