/* report.h - client: faults and warnings for people. */
#ifndef REPORT_H
#define REPORT_H

#include <stdio.h>

#include "files/bytes.h"

/* Adds the faults of a server's refusal, one per line. `answer`: application/problem+json, or any text of a proxy. */
void report_problem(struct bytes *faults, long status, const struct bytes *answer);

/* Prints faults: a single one after the name of the file, several below it. `file` may be "-". */
void report_faults(FILE *out, const char *file, const struct bytes *faults);

/* Does the same for commands of one file. A single fault of an option is printed without the name. */
void report_of_file(FILE *out, const char *file, const struct bytes *faults);

/* Prints one warning per line, after the name of the file unless that is NULL. */
void report_warnings(FILE *out, const char *file, const struct bytes *warnings);

#endif
