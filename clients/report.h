/* report.h - client: a refusal of the server, as a person reads it. */
#ifndef REPORT_H
#define REPORT_H

#include <stdio.h>

#include "bytes.h"

/* `answer` is an application/problem+json, or whatever a proxy put in its place. */
void report_problem(FILE *out, const char *file, long status, const struct bytes *answer);

#endif
