/* problem.h - errors as application/problem+json (RFC 9457). */
#ifndef ZRASTERD_PROBLEM_H
#define ZRASTERD_PROBLEM_H

#include "answer.h"
#include "base/status.h"

/* The one table from the renderer's statuses to HTTP's. */
int problem_http_status(enum zr_status status);

/* Makes the answer an error with one detail. */
void problem_answer(struct answer *answer, int http_status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Makes the answer an error with all that the renderer said. */
void problem_answer_error(struct answer *answer, int http_status, const struct zr_error *error);

#endif
