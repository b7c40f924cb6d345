/* resume.h - client: outputs of an earlier batch. */
#ifndef RESUME_H
#define RESUME_H

#include "job.h"

/* Returns true if every output of a job exists. False also if their names are not known before drawing. Any number of
 * threads may call once tables_open has returned. */
bool resume_has_all(const struct job *job);

#endif
