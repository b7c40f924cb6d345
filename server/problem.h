/* problem.h - errors as application/problem+json (RFC 9457), or as text/plain if the answer is_plain: a line per error,
 * "/pointer: detail", at most PROBLEM_TEXT_SIZE bytes. */
#ifndef ZRASTERD_PROBLEM_H
#define ZRASTERD_PROBLEM_H

#include <stdint.h>

#include "answer.h"
#include "base/arena.h"
#include "base/status.h"
#include "core.h"

enum { PROBLEM_TEXT_SIZE = 8000 };

/* Returns the HTTP status of a renderer's status. The only such table. */
int problem_http_status(enum zr_status status);

/* Turns the answer into an error with one detail. */
void problem_answer(struct answer *answer, int http_status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Turns the answer into an error with all entries of `error`. */
void problem_answer_error(struct answer *answer, int http_status, const struct zr_error *error);

/* Turns the answer into a 503 with Retry-After. */
void problem_busy(struct answer *answer, unsigned retry_after_s, enum refusal refusal);

/* Reports a failed arena. 422 if the request can never fit: it names the bytes needed and, from the predicted `cost`
 * (or NULL), their main use. 503 if the system has no memory now. */
void problem_memory(struct answer *answer, const struct zr_arena *arena, const struct zr_cost *cost);

/* Reports a picture that was cancelled after its time: 504. */
void problem_timeout(struct answer *answer, uint64_t timeout_ms);

#endif
