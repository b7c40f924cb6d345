/* resume.h - client: outputs of an earlier batch. */
#ifndef RESUME_H
#define RESUME_H

#include "engine/job.h"

/* Returns true if every output of a job exists. False also if their names are not known before drawing. Thread-safe
 * after tables_open. */
bool resume_has_all(const struct job *job);

#endif
