/* report.h - reference: what a person gets to read and to look at. */
#ifndef ZR_TEST_REPORT_H
#define ZR_TEST_REPORT_H

#include <stdbool.h>

#include "reference/harness.h"

enum report_style { REPORT_LINES, REPORT_TAP, REPORT_QUIET };

struct report {
    enum report_style style;
    int count; /* lines so far */
};

/* One line for a kind. The total is printed by report_total in every style. */
void report_line(struct report *report, const char *name, enum verdict verdict, const struct tally *tally);
void report_total(struct report *report, enum verdict verdict, const struct tally *tally);

struct report_failure {
    const char *directory, *label;
    uint64_t number;
    const struct drawing *drawing;
    const struct picture *want, *got;
    const uint32_t *alone; /* numbers of faces that differ when drawn alone */
    uint32_t alone_count;
};

/* Writes want, got and diff pictures and the drawing's numbers; prints the first
 * pixels that differ. */
void report_difference(const struct report_failure *failure);

#endif
