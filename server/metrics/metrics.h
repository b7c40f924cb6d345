/* metrics.h - counts of requests since the start, and the state of the daemon, for metrics_print.h.
 *
 * A request is counted where its line is logged, so the sums agree with the log. Each label has its values from a table
 * of the program, never from a client: the number of series is bounded (METRICS_*). Memory is fixed. Counting takes
 * some tens of nanoseconds. Belongs to the thread that serves all connections; not thread-safe.
 */
#ifndef ZRASTERD_METRICS_H
#define ZRASTERD_METRICS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "histogram.h"
#include "http/connections.h"
#include "jobs/queue.h"
#include "keep/kept.h"
#include "log/log.h"
#include "refusal.h"

/* METRICS_ROUTES: paths of the table of routes, and one for all others. METRICS_LOOKS: versions of looks. */
enum { METRICS_ROUTES = 40, METRICS_METHODS = 6, METRICS_STATUSES = 34, METRICS_LOOKS = 48 };

enum metrics_step { METRICS_PARSE, METRICS_QUEUE, METRICS_RENDER, METRICS_ENCODE, METRICS_STEPS };
enum metrics_abort { METRICS_CLIENT_LEFT, METRICS_SLOW_READER, METRICS_MALFORMED, METRICS_ABORTS };

/* State of the daemon at one moment. */
struct metrics_now {
    struct queue_state queue;
    size_t in_progress, streams;
    size_t connections[PHASES], connections_max;
    uint64_t answer_bytes, upload_bytes;
    struct kept_state kept[KEPT_TABLES];
    uint64_t lost_lines;
    bool is_ready;
    const char *isa;
};

struct metrics {
    double start_s; /* since 1970 */
    size_t route_count;
    const char *routes[METRICS_ROUTES]; /* in the order of their first request; [0] NULL: no route */
    uint64_t requests[METRICS_ROUTES][METRICS_METHODS][METRICS_STATUSES];
    struct histogram durations[METRICS_ROUTES], steps[METRICS_STEPS], bodies, answers;
    uint64_t pictures[METRICS_LOOKS], warnings;
    uint64_t refusals[REFUSALS], aborts[METRICS_ABORTS], timeouts;

    /* Set by the HTTP side: */
    void (*look)(void *context, struct metrics_now *now);
    void *context;
};

/* NULL: out of memory. */
struct metrics *metrics_create(void);
void metrics_free(struct metrics *metrics);

/* Counts a request as its line in the log has it. `metrics` may be NULL. */
void metrics_count(struct metrics *metrics, const struct log_request *request);

/* Texts of the labels. METRICS_STATUSES - 1: a status that is not in the table, "other". */
const char *metrics_method(size_t method);
int metrics_status(size_t status);
const char *metrics_step_word(enum metrics_step step);
const char *metrics_abort_word(enum metrics_abort abort);

#endif
