/* metrics.h - counts of requests since the start, and the state of the daemon, as text: metrics_print.c.
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
#include <stdio.h>

#include "http/connections.h"
#include "jobs/queue.h"
#include "keep/kept.h"
#include "log/log.h"
#include "refusal.h"

/* METRICS_ROUTES: paths of the table of routes, and one for all others. METRICS_LOOKS: versions of looks. */
enum { METRICS_ROUTES = 40, METRICS_METHODS = 6, METRICS_STATUSES = 34, METRICS_LOOKS = 48 };

enum metrics_step { METRICS_PARSE, METRICS_QUEUE, METRICS_RENDER, METRICS_ENCODE, METRICS_STEPS };
enum metrics_abort { METRICS_CLIENT_LEFT, METRICS_SLOW_READER, METRICS_MALFORMED, METRICS_ABORTS };

enum { HISTOGRAM_BOUNDS_MAX = 16 };

/* Upper bounds of the buckets, increasing; the last bucket has none. */
struct histogram_bounds {
    size_t count;
    double values[HISTOGRAM_BOUNDS_MAX];
};

/* Seconds from 1 ms to 30 s; bytes from 1 KiB to 256 MiB. */
extern const struct histogram_bounds histogram_seconds, histogram_bytes;

struct histogram {
    uint64_t buckets[HISTOGRAM_BOUNDS_MAX + 1]; /* not cumulative */
    double sum;
};

/* Counts a value: in the first bucket whose bound is not below it. */
void histogram_add(struct histogram *histogram, const struct histogram_bounds *bounds, double value);

/* Returns the number of values. */
uint64_t histogram_count(const struct histogram *histogram);

/* Metrics with one number. metrics_print finds those from METRICS_WARNINGS on. */
enum metrics_number {
    METRICS_READY, /* 1 or 0 */
    METRICS_WORKERS,
    METRICS_BUSY,
    METRICS_IN_PROGRESS,
    METRICS_STREAMS,
    METRICS_CONNECTIONS_MAX,
    METRICS_ANSWER_BYTES,
    METRICS_ANSWER_BYTES_MAX,
    METRICS_ASSET_BYTES,
    METRICS_ASSET_BYTES_MAX,
    METRICS_MEMORY_MAX,
    METRICS_UPLOAD_BYTES,
    METRICS_RENDER_BYTES,
    METRICS_LOST_LINES,
    METRICS_SHARED_ANSWERS,
    METRICS_WARNINGS,
    METRICS_TIMEOUTS,
    METRICS_START_S,
    METRICS_CPU_S,
    METRICS_RESIDENT,
    METRICS_VIRTUAL,
    METRICS_OPEN_FILES,
    METRICS_MAX_FILES,
    METRICS_NUMBERS
};

/* State of the daemon at one moment. */
struct metrics_now {
    double numbers[METRICS_NUMBERS];
    size_t waiting[QUEUE_LANES], connections[PHASES];
    struct kept_state kept[KEPT_TABLES];
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

/* Texts of the labels. Statuses: 0: no answer was sent; -1: one that is not in the table, "other". */
extern const char *const metrics_methods[METRICS_METHODS], *const metrics_steps[METRICS_STEPS],
                                                               *const metrics_aborts[METRICS_ABORTS];
extern const int metrics_statuses[METRICS_STATUSES];

enum metrics_form { METRICS_TEXT, METRICS_OPEN };

/* Prints all metrics: in Prometheus' text format 0.0.4, or in OpenMetrics 1.0. Series that have counted nothing are left
 * out if they have labels of requests. */
void metrics_print(FILE *out, const struct metrics *metrics, const struct metrics_now *now, enum metrics_form form);

#endif
