/* problem.h - errors as application/problem+json (RFC 9457). */
#ifndef ZRASTERD_PROBLEM_H
#define ZRASTERD_PROBLEM_H

#include <stdint.h>

#include "answer.h"
#include "base/arena.h"
#include "base/status.h"
#include "zraster.h"

/* The one table from the renderer's statuses to HTTP's. */
int problem_http_status(enum zr_status status);

/* Makes the answer an error with one detail. */
void problem_answer(struct answer *answer, int http_status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Makes the answer an error with all that the renderer said. */
void problem_answer_error(struct answer *answer, int http_status, const struct zr_error *error);

/* 503, and when to come again. */
void problem_busy(struct answer *answer, unsigned retry_after_s, const char *detail);

/* The arena has failed: 422 for a request that can never fit, with what it needs, and what needs it, by the cost that
 * was predicted, if one was (else NULL); 503 where it is the system that has no memory just now. */
void problem_memory(struct answer *answer, const struct zr_arena *arena, const struct zr_cost *cost);

/* The request was cancelled, since its time was over: 504. */
void problem_late(struct answer *answer, uint64_t timeout_ms);

#endif
