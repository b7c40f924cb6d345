/* load.h - bench: many clients of a daemon at once, on one thread: each sends a request, waits for its answer, and
 * sends the next, at once or when its turn comes. Bounded in time; to 127.0.0.1 alone.
 */
#ifndef ZR_BENCH_LOAD_H
#define ZR_BENCH_LOAD_H

#include <stdbool.h>
#include <stddef.h>

enum { LOAD_CONNECTIONS_MAX = 1024 };

struct load {
    unsigned port;
    int connections;
    const char *request; /* all of its bytes */
    size_t size;
    double per_second; /* requests of all together; 0: each the next as soon as it is answered */
    double seconds;
    bool is_equal; /* requests of all connections are equal; else each has a number, since equal ones are drawn once */
    bool probe;    /* beside them, GET /healthz on a new connection every 20 ms */
};

struct load_result {
    double served, refused, failed; /* a second: 200, other statuses, and connections that ended without an answer */
    double p50_ms, p99_ms;          /* of those that were served */
    double probe_p99_ms;            /* of /healthz; one that failed counts as 10 s */
};

/* Returns a whole POST of `type`, with a number that load_run replaces, NULL if memory ran out; free it. */
char *load_make_request(const char *target, const char *type, const void *body, size_t body_size, size_t *size);

/* False, explained on stderr, where nobody listens. */
bool load_run(const struct load *load, struct load_result *result);

/* Where there are two processors or more: what the caller starts from now on runs on one, or this thread on the others.
 */
void load_take_first_processor(void);
void load_take_other_processors(void);

#endif
