/* problems.h - errors as the daemon sends them. */
#ifndef TEST_PROBLEMS_H
#define TEST_PROBLEMS_H

#include "client.h"

/* An error with this status that says what it is in RFC 9457's form, `text` being in its detail. Frees the reply; a
 * failure fails the running test. */
void assert_problem(struct reply reply, long status, const char *text);

#endif
