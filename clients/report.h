/* report.h - client: faults and warnings for people. */
#ifndef REPORT_H
#define REPORT_H

#include <stdio.h>

#include "bytes.h"

/* Adds the faults of a server's refusal, one per line. `answer`: application/problem+json, or any text of a proxy. */
void report_problem(struct bytes *faults, long status, const struct bytes *answer);

/* Prints faults: a single one behind the file's name, several below it. `file` may be "-". */
void report_faults(FILE *out, const char *file, const struct bytes *faults);

/* The same for commands of one file: the fault of an option, alone, needs no file. */
void report_of_file(FILE *out, const char *file, const struct bytes *faults);

/* Prints each warning on a line. `file`: printed in front of it, unless NULL. */
void report_warnings(FILE *out, const char *file, const struct bytes *warnings);

#endif
