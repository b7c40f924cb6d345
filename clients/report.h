/* report.h - client: prints a refusal of the server for people. */
#ifndef REPORT_H
#define REPORT_H

#include <stdio.h>

#include "bytes.h"

/* `answer`: application/problem+json, or any text of a proxy. */
void report_problem(FILE *out, const char *file, long status, const struct bytes *answer);

#endif
