#include "http_exchange.h"

#include <arpa/inet.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>

#include "clock.h"
#include "http_guard.h"
#include "http_work.h"
#include "log.h"
#include "problem.h"

enum { DISCARD_MAX = 1 << 20 };

static struct watch *watch_of(struct MHD_Connection *connection)
{
    const union MHD_ConnectionInfo *info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return info ? info->socket_context : NULL;
}

/* ---- connections ---- */

static void log_broken_header(const struct watch *watch)
{
    log_request(&(struct log_request){
        .remote = watch->address,
        .status = watch->phase == WATCH_REFUSED ? 408 : 0,
        .aborted = watch->phase != WATCH_REFUSED,
        .total_ms = (double)(clock_ms() - watch->began_ms),
        .times = API_NO_TIMES,
        .detail = watch->phase == WATCH_REFUSED ? "the header came too slowly"
                                                : "the request line was malformed or not whole",
    });
}

void http_on_connection(void *context, struct MHD_Connection *connection, void **socket_context,
                        enum MHD_ConnectionNotificationCode code)
{
    struct http *http = context;
    if (code == MHD_CONNECTION_NOTIFY_CLOSED) {
        struct watch *watch = *socket_context;
        if (!watch) return;
        watchdog_remove(http->watchdog, watch);
        if (!watch->ended && watchdog_has_unknown_bytes(watch)) log_broken_header(watch);
        free(watch);
        return;
    }
    int fd = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
    const struct sockaddr *address =
        MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CLIENT_ADDRESS)->client_addr;
    struct watch *watch = *socket_context = calloc(1, sizeof *watch);
    if (!watch) {
        shutdown(fd, SHUT_RDWR);
        return;
    }
    watch->socket_fd = fd;
    const void *bytes = address->sa_family == AF_INET6
                            ? (const void *)&((const struct sockaddr_in6 *)(const void *)address)->sin6_addr
                            : (const void *)&((const struct sockaddr_in *)(const void *)address)->sin_addr;
    inet_ntop(address->sa_family, bytes, watch->address, sizeof watch->address);
    watchdog_add(http->watchdog, watch);
}

/* ---- the beginning and the end of an exchange ---- */

void *http_on_request_line(void *context, const char *target, struct MHD_Connection *connection)
{
    struct exchange *exchange = calloc(1, sizeof *exchange);
    if (!exchange) return NULL;
    exchange->http = context;
    exchange->connection = connection;
    exchange->watch = watch_of(connection);
    exchange->began_us = clock_us();
    exchange->times = API_NO_TIMES;
    exchange->target = strdup(target);
    if (!exchange->target || !exchange->watch) {
        free(exchange->target);
        free(exchange);
        return NULL;
    }
    exchange->request.path = exchange->target;
    return exchange;
}

/* What was sent, as far as it can be known: the library answers some errors of
 * syntax on its own, and the watchdog answers what is too slow. */
static int status_sent(const struct exchange *exchange, bool timed_out)
{
    if (exchange->replied) return exchange->answer.status;
    if (timed_out) return 408;
    const union MHD_ConnectionInfo *info =
        MHD_get_connection_info(exchange->connection, MHD_CONNECTION_INFO_HTTP_STATUS);
    return info ? (int)info->http_status : 0;
}

static void log_exchange(const struct exchange *exchange, bool completed, bool timed_out)
{
    bool past_library = exchange->step == STEP_REFUSED;
    const char *detail = exchange->answer.detail;
    if (timed_out)
        detail = "the request came too slowly";
    else if (exchange->watch->client_left)
        detail = "the client left";
    else if (!exchange->answer.status)
        detail = "the request was malformed or not whole";
    log_request(&(struct log_request){
        .id = exchange->request.id,
        .remote = exchange->watch->address,
        .method = exchange->method,
        .path = exchange->request.path,
        .query = exchange->request.query,
        .traceparent = exchange->traceparent,
        .detail = detail,
        .status = status_sent(exchange, timed_out),
        .aborted = !completed && !past_library && !timed_out,
        .bytes_in = exchange->body_bytes,
        .bytes_out = completed || past_library ? exchange->answer.size : 0,
        .total_ms = (double)(clock_us() - exchange->began_us) / 1000.0,
        .times = exchange->times,
    });
}

void http_on_completed(void *context, struct MHD_Connection *connection, void **slot,
                       enum MHD_RequestTerminationCode code)
{
    struct http *http = context;
    struct exchange *exchange = *slot;
    (void)connection;
    if (!exchange) return;
    *slot = NULL;
    bool completed = exchange->replied && code == MHD_REQUEST_TERMINATED_COMPLETED_OK;
    bool refused = !watchdog_enter(http->watchdog, exchange->watch, WATCH_HEADER, NULL);
    log_exchange(exchange, completed, refused && !exchange->replied);
    if (!completed || exchange->answer.close) exchange->watch->ended = true;
    upload_free(&exchange->upload, &http->uploads);
    api_request_free(&exchange->request);
    answer_free(&exchange->answer);
    free(exchange->target);
    if (exchange->opened) {
        pthread_mutex_lock(&http->lock);
        http->in_flight--;
        pthread_cond_signal(&http->exchange_ended);
        pthread_mutex_unlock(&http->lock);
    }
    free(exchange);
}

/* ---- answers ---- */

static ssize_t no_bytes(void *context, uint64_t position, char *bytes, size_t size)
{
    (void)context, (void)position, (void)bytes, (void)size;
    return MHD_CONTENT_READER_END_WITH_ERROR;
}

/* Takes the bytes. */
static struct MHD_Response *create_response(struct answer *answer)
{
    struct MHD_Response *response;
    if (answer->bytes || answer->size == 0)
        return MHD_create_response_from_buffer(answer->size, answer->bytes, MHD_RESPMEM_MUST_FREE);
    /* A length that is told and not sent: nobody reads. */
    response = MHD_create_response_from_callback(answer->size, 1, no_bytes, NULL, NULL);
    answer->size = 0;
    return response;
}

/* Hands the answer over to libmicrohttpd. */
static enum MHD_Result reply(struct exchange *exchange)
{
    struct http *http = exchange->http;
    struct answer *answer = &exchange->answer;
    if (!watchdog_enter(http->watchdog, exchange->watch, WATCH_WRITE, exchange)) return MHD_NO;
    struct MHD_Response *response = create_response(answer);
    if (!response) return MHD_NO;
    answer->bytes = NULL; /* the response's now */
    api_finish(answer, exchange->request.id);
    answer->close |= atomic_load(&http->draining);
    if (answer->close) MHD_add_response_header(response, "Connection", "close");
    for (size_t i = 0; i < answer->header_count; i++)
        MHD_add_response_header(response, answer->headers[i].name, answer->headers[i].value);
    enum MHD_Result result = MHD_queue_response(exchange->connection, (unsigned)answer->status, response);
    MHD_destroy_response(response);
    exchange->replied = result == MHD_YES;
    return result;
}

/* Sends the answer now, in the middle of a request, and throws away what is still to come. */
static enum MHD_Result reply_past_library(struct exchange *exchange)
{
    api_finish(&exchange->answer, exchange->request.id);
    exchange->answer.close = true;
    /* False: the watchdog was faster and sent a 408. */
    if (watchdog_refuse(exchange->http->watchdog, exchange->watch, &exchange->answer)) exchange->replied = true;
    exchange->step = STEP_REFUSED;
    upload_free(&exchange->upload, &exchange->http->uploads);
    return MHD_YES;
}

/* The answer is made before the body came. What is quickest for the client and
 * safe: a client that waits for 100-continue gets it at once. Otherwise closing
 * now would reset the connection under a client that is still sending, so a
 * short body is read to its end, and with a long one the answer goes out first. */
static enum MHD_Result reply_early(struct exchange *exchange, const struct http_framing *framing)
{
    bool has_body = framing->is_chunked || framing->length > 0;
    if (framing->expects_continue && has_body) return reply(exchange);
    if (framing->is_chunked || framing->length > DISCARD_MAX) return reply_past_library(exchange);
    exchange->step = STEP_DISCARD;
    return MHD_YES;
}

static void get_load(struct http *http, uint64_t body_bytes, struct api_load *load)
{
    load->draining = atomic_load(&http->draining);
    load->queue_full = queue_is_full(http->queue, http_lane_of(body_bytes));
    load->large_queue_full = queue_is_full(http->queue, QUEUE_LARGE);
    load->retry_after_s = queue_wait_estimate_s(http->queue);
}

/* ---- requests ---- */

static const char *header(struct exchange *exchange, const char *name)
{
    return MHD_lookup_connection_value(exchange->connection, MHD_HEADER_KIND, name);
}

static void open_exchange(struct exchange *exchange, const char *method)
{
    struct http *http = exchange->http;
    snprintf(exchange->method, sizeof exchange->method, "%s", method);
    exchange->request.method = exchange->method;
    exchange->request.content_type = header(exchange, "Content-Type");
    exchange->request.content_encoding = header(exchange, "Content-Encoding");
    exchange->request.authorization = header(exchange, "Authorization");
    exchange->request.if_none_match = header(exchange, "If-None-Match");
    const char *trace = header(exchange, "traceparent");
    if (trace && log_is_traceparent(trace)) snprintf(exchange->traceparent, TRACEPARENT_SIZE, "%s", trace);
    api_take_id(http->api, &exchange->request, header(exchange, "X-Request-Id"));
    pthread_mutex_lock(&http->lock);
    http->in_flight++;
    pthread_mutex_unlock(&http->lock);
    exchange->opened = true;
}

static void split_target(struct exchange *exchange)
{
    static const char SCHEME[] = "http://";
    char *path = exchange->target;
    if (strncasecmp(path, SCHEME, sizeof SCHEME - 1) == 0) { /* RFC 9112, 3.2.2: a proxy's form */
        path += sizeof SCHEME - 1;
        path += strcspn(path, "/?");
    }
    exchange->request.path = path;
    char *query = strchr(path, '?');
    if (query) {
        *query = '\0';
        exchange->request.query = query + 1;
    }
}

static enum MHD_Result begin_request(struct exchange *exchange, const char *method, const char *version)
{
    struct http *http = exchange->http;
    struct answer *answer = &exchange->answer;
    struct api_load load;
    open_exchange(exchange, method);
    struct http_framing framing = http_guard_check(exchange->connection, version, exchange->target);
    split_target(exchange);
    if (!watchdog_enter(http->watchdog, exchange->watch, WATCH_BODY, exchange)) return MHD_NO;
    if (framing.status) {
        /* What follows cannot be told from a body: nothing more is read. */
        problem_answer(answer, framing.status, "%s", framing.detail);
        answer->close = true;
        return reply(exchange);
    }
    get_load(http, framing.length, &load);
    exchange->length = framing.length;
    if (framing.length > http->config->body_max_bytes) {
        problem_answer(answer, 413, "the body has %llu bytes; bodyMaxBytes is %llu", (unsigned long long)framing.length,
                       (unsigned long long)http->config->body_max_bytes);
        return reply_early(exchange, &framing);
    }
    if (api_open(http->api, &load, &exchange->request, answer) == API_ANSWERED) return reply_early(exchange, &framing);
    if (!watchdog_admit(http->watchdog, exchange->watch, http->config->max_per_client)) {
        answer_header(answer, "Retry-After", "%u", load.retry_after_s);
        problem_answer(answer, 429, "more than maxPerClient, %llu, requests in flight from %s",
                       (unsigned long long)http->config->max_per_client, exchange->watch->address);
        return reply_early(exchange, &framing);
    }
    exchange->step = STEP_BODY;
    return MHD_YES;
}

static enum MHD_Result take_body(struct exchange *exchange, const char *bytes, size_t size)
{
    struct http *http = exchange->http;
    exchange->body_bytes += size;
    watchdog_count_body(http->watchdog, exchange->watch, size);
    if (exchange->step != STEP_BODY) return MHD_YES;
    switch (upload_add(&exchange->upload, &http->uploads, bytes, size, exchange->length)) {
    case UPLOAD_OK:
        return MHD_YES;
    case UPLOAD_TOO_LARGE:
        problem_answer(&exchange->answer, 413, "the body has more than bodyMaxBytes, %llu bytes",
                       (unsigned long long)http->config->body_max_bytes);
        break;
    case UPLOAD_NO_MEMORY:
        api_refuse_busy(&exchange->answer, queue_wait_estimate_s(http->queue), "too many bodies are coming in");
        break;
    }
    return reply_past_library(exchange);
}

enum MHD_Result http_on_request(void *context, struct MHD_Connection *connection, const char *url, const char *method,
                                const char *version, const char *bytes, size_t *size, void **slot)
{
    struct exchange *exchange = *slot;
    (void)context, (void)connection, (void)url;
    if (!exchange) return MHD_NO;
    if (exchange->step == STEP_HEADER) return begin_request(exchange, method, version);
    if (*size > 0) {
        size_t taken = *size;
        *size = 0;
        return take_body(exchange, bytes, taken);
    }
    switch (exchange->step) {
    case STEP_BODY:
        return http_begin_work(exchange);
    case STEP_DISCARD:
        return reply(exchange);
    case STEP_ANSWER:
        return exchange->answer.status ? reply(exchange) : MHD_NO;
    default:
        return MHD_NO;
    }
}
