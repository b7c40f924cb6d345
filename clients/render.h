/* render.h - client: the report of one job. */
#ifndef RENDER_H
#define RENDER_H

#include "job.h"

/* Prints faults, or warnings and the line of the job, on stderr. */
void render_report(const struct job *job);

#endif
