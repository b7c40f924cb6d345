#include "metrics.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "scene/looks.h"

/* The last one stands for all others. */
const char *const metrics_methods[METRICS_METHODS] = {"GET", "HEAD", "POST", "PUT", "OPTIONS", "other"};

const int metrics_statuses[METRICS_STATUSES] = {0,   200, 201, 204, 206, 304, 400, 401, 403, 404, 405, 406,
                                                408, 409, 411, 412, 413, 414, 415, 416, 417, 422, 426, 428,
                                                429, 431, 500, 501, 502, 503, 504, 505, 507, -1};

const char *const metrics_steps[METRICS_STEPS] = {"parse", "queue", "render", "encode"};
const char *const metrics_aborts[METRICS_ABORTS] = {"client_left", "slow_reader", "malformed"};

struct metrics *metrics_create(void)
{
    struct metrics *metrics = calloc(1, sizeof *metrics);
    struct timespec now;
    if (!metrics) return NULL;
    clock_gettime(CLOCK_REALTIME, &now);
    metrics->start_s = (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
    metrics->route_count = 1;
    return metrics;
}

void metrics_free(struct metrics *metrics)
{
    free(metrics);
}

/* ---- histograms ---- */

const struct histogram_bounds histogram_seconds = {
    14, {0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0}};

const struct histogram_bounds histogram_bytes = {
    10, {1024, 4096, 16384, 65536, 262144, 1048576, 4194304, 16777216, 67108864, 268435456}};

void histogram_add(struct histogram *histogram, const struct histogram_bounds *bounds, double value)
{
    size_t bucket = 0;
    while (bucket < bounds->count && value > bounds->values[bucket])
        bucket++;
    histogram->buckets[bucket]++;
    histogram->sum += value;
}

uint64_t histogram_count(const struct histogram *histogram)
{
    uint64_t count = 0;
    for (size_t i = 0; i <= HISTOGRAM_BOUNDS_MAX; i++)
        count += histogram->buckets[i];
    return count;
}

/* ---- places of labels ---- */

/* Paths of routes are constant texts of one table, so their addresses identify them. */
static size_t place_of_route(struct metrics *metrics, const char *route)
{
    size_t place = 1;
    if (!route) return 0;
    while (place < metrics->route_count && metrics->routes[place] != route)
        place++;
    if (place == METRICS_ROUTES) return 0;
    if (place == metrics->route_count) metrics->routes[metrics->route_count++] = route;
    return place;
}

static size_t place_of_method(const char *method)
{
    size_t place = 0;
    while (place < METRICS_METHODS - 1 && (!method || strcmp(metrics_methods[place], method) != 0))
        place++;
    return place;
}

static size_t place_of_status(int status)
{
    size_t place = 0;
    while (place < METRICS_STATUSES - 1 && metrics_statuses[place] != status)
        place++;
    return place;
}

static void count_look(struct metrics *metrics, const char *look)
{
    for (int i = 0; i < zr_look_count && i < METRICS_LOOKS; i++)
        if (strcmp(zr_look_pin_of(&zr_looks[i]).text, look) == 0) metrics->pictures[i]++;
}

/* ---- counting ---- */

static void count_abort(struct metrics *metrics, const struct log_request *request)
{
    const enum metrics_abort why = request->was_slow      ? METRICS_SLOW_READER
                                   : request->client_left ? METRICS_CLIENT_LEFT
                                                          : METRICS_MALFORMED;
    metrics->aborts[why]++;
}

void metrics_count(struct metrics *metrics, const struct log_request *request)
{
    if (!metrics) return;
    const double steps_ms[METRICS_STEPS] = {request->times.parse_ms, request->times.queue_ms, request->times.render_ms,
                                            request->times.encode_ms};
    const size_t route = place_of_route(metrics, request->route);
    metrics->requests[route][place_of_method(request->method)][place_of_status(request->status)]++;
    histogram_add(&metrics->durations[route], &histogram_seconds, 1e-3 * request->total_ms);
    for (int step = 0; step < METRICS_STEPS; step++)
        if (steps_ms[step] >= 0) histogram_add(&metrics->steps[step], &histogram_seconds, 1e-3 * steps_ms[step]);
    if (request->bytes_in > 0) histogram_add(&metrics->bodies, &histogram_bytes, (double)request->bytes_in);
    if (request->bytes_out > 0) histogram_add(&metrics->answers, &histogram_bytes, (double)request->bytes_out);
    if (request->look) count_look(metrics, request->look);
    metrics->warnings += request->warnings;
    if (request->refusal) metrics->refusals[request->refusal]++;
    if (request->aborted) count_abort(metrics, request);
    if (request->status == 504) metrics->timeouts++;
}
