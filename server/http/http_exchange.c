#include "http_exchange.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>

#include "accept.h"
#include "clock.h"
#include "http_end.h"
#include "http_room.h"
#include "http_work.h"
#include "problem.h"
#include "router.h"

/* DISCARD_MAX: a refused body of up to so many bytes is read to its end to keep the connection; a longer one takes more
 * time than a new connection. COMING_MS: see count_coming. STREAM_BLOCK: libmicrohttpd takes less if its memory of the
 * connection is less. */
enum { DISCARD_MAX = 32 << 10, COMING_MS = 500, STREAM_BLOCK = 64 << 10 };

static struct connection *connection_of(struct MHD_Connection *mhd)
{
    const union MHD_ConnectionInfo *info = MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return info ? info->socket_context : NULL;
}

/* ---- connections ---- */

void http_on_connection(void *context, struct MHD_Connection *mhd, void **socket_context,
                        enum MHD_ConnectionNotificationCode code)
{
    struct http *http = context;
    if (code == MHD_CONNECTION_NOTIFY_CLOSED) {
        struct connection *connection = *socket_context;
        if (!connection) return;
        if (connection->phase == PHASE_HEADER && framing_is_within_header(&connection->framing))
            http_log_connection(http, connection, NULL,
                                &(struct answer){.detail = "the connection ended within a request's header"});
        if (connections_is_within_proxy(connection) && connection->phase != PHASE_REFUSED)
            http_log_connection(http, connection, NULL,
                                &(struct answer){.detail = "the connection ended within its PROXY header"});
        connections_remove(&http->connections, connection);
        return;
    }
    const int fd = MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
    struct connection *connection = *socket_context = connections_find(&http->connections, fd);
    if (!connection) shutdown(fd, SHUT_RDWR); /* not in the list: its deadline would never come */
}

/* ---- refusals ---- */

/* Sends the answer now, while the client still sends, and discards the bytes that still arrive. */
static void send_past_library(struct http *http, struct connection *connection, const struct answer *answer)
{
    answer_send(answer, connection->fd);
    shutdown(connection->fd, SHUT_WR);
    connections_enter(&http->connections, connection, PHASE_REFUSED);
}

/* Sends the answer of an exchange now, see send_past_library. */
static void reply_past_library(struct exchange *exchange)
{
    struct answer *answer = &exchange->answer;
    router_finish(answer, exchange->http->service, &exchange->request);
    if (answer->is_broken) answer_to_no_memory(answer);
    answer->close = exchange->replied = true;
    exchange->step = STEP_REFUSED;
    exchange->is_whole = true;
    exchange->bytes_out = answer->size;
    http_log_exchange(exchange);
    if (strcmp(exchange->method, "HEAD") == 0) answer_drop_bytes(answer);
    send_past_library(exchange->http, exchange->connection, answer);
    upload_free(&exchange->upload, &exchange->http->uploads);
}

void http_refuse(struct http *http, struct connection *connection, int status, const char *detail)
{
    struct exchange *exchange = connection->exchange;
    const enum refusal refusal = status != 503                  ? REFUSAL_NONE
                                 : atomic_load(&http->draining) ? REFUSAL_DRAINING
                                                                : REFUSAL_CONNECTIONS;
    if (exchange && exchange->opened) {
        answer_free(&exchange->answer); /* the answer that waited for the end of the body */
        problem_answer(&exchange->answer, status, "%s", detail);
        exchange->answer.refusal = refusal;
        reply_past_library(exchange);
        return;
    }
    struct answer answer = {0};
    struct request nameless = {0};
    if (exchange) exchange->logged = true; /* an incomplete header: logged below */
    request_take_id(&nameless, http->service, NULL);
    problem_answer(&answer, status, "%s", detail);
    answer.refusal = refusal;
    router_finish(&answer, http->service, &nameless);
    http_log_connection(http, connection, nameless.id, &answer);
    send_past_library(http, connection, &answer);
    answer_free(&answer);
}

void http_refuse_framing(struct http *http, struct connection *connection)
{
    const struct framing *framing = &connection->framing;
    if (framing->status == 0 || connection->phase == PHASE_REFUSED) return;
    /* The refused bytes belong to the current exchange, or to none. */
    const bool is_body = framing->refused_body && connection->phase == PHASE_BODY;
    if ((is_body && connection->answered + 1 == framing->passed) || connection->answered == framing->passed)
        http_refuse(http, connection, framing->status, framing->detail);
}

/* ---- the beginning and the end of an exchange ---- */

void *http_on_request_line(void *context, const char *target, struct MHD_Connection *mhd)
{
    struct exchange *exchange = calloc(1, sizeof *exchange);
    if (!exchange) return NULL;
    exchange->http = context;
    exchange->mhd = mhd;
    exchange->connection = connection_of(mhd);
    exchange->began_us = clock_us();
    exchange->times = NO_STEP_TIMES;
    exchange->target = strdup(target);
    if (!exchange->target || !exchange->connection) {
        free(exchange->target);
        free(exchange);
        return NULL;
    }
    exchange->peer = exchange->connection->peer;
    exchange->client = exchange->connection->address;
    exchange->request.path = exchange->target;
    exchange->connection->exchange = exchange;
    return exchange;
}

void http_on_completed(void *context, struct MHD_Connection *mhd, void **slot, enum MHD_RequestTerminationCode code)
{
    struct http *http = context;
    struct exchange *exchange = *slot;
    (void)mhd;
    if (!exchange) return;
    *slot = NULL;
    struct connection *connection = exchange->connection;
    const bool is_last = exchange->is_last;
    exchange->is_whole = exchange->replied && code == MHD_REQUEST_TERMINATED_COMPLETED_OK;
    exchange->bytes_out = exchange->is_whole ? exchange->answer.size : connections_taken(connection);
    exchange->is_over = true;
    connection->exchange = NULL;
    if (exchange->is_working) /* on a streamed answer: closed once it ends */
        http_cut_stream(exchange);
    else
        http_close_exchange(exchange);
    connection->answered++;
    if (connection->phase == PHASE_REFUSED) return;
    connections_enter(&http->connections, connection,
                      framing_is_between(&connection->framing) ? PHASE_IDLE : PHASE_HEADER);
    if (!is_last) http_refuse_framing(http, connection);
}

/* ---- answers ---- */

static ssize_t no_bytes(void *context, uint64_t position, char *bytes, size_t size)
{
    (void)context, (void)position, (void)bytes, (void)size;
    return MHD_CONTENT_READER_END_WITH_ERROR;
}

/* For HEAD and 304, without Content-Length. libmicrohttpd 0.9.75 sends the last chunk of an answer without body, so the
 * connection must end instead. The callback is never called. */
static struct MHD_Response *create_unsized_response(void)
{
    struct MHD_Response *response = MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, 1, no_bytes, NULL, NULL);
    if (response) MHD_set_response_options(response, MHD_RF_HTTP_VERSION_1_0_ONLY, MHD_RO_END);
    return response;
}

/* Takes ownership of the answer's bytes or file. */
static struct MHD_Response *create_response(struct exchange *exchange)
{
    struct answer *answer = &exchange->answer;
    struct MHD_Response *response;
    if (exchange->stream.is_begun)
        response = MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, STREAM_BLOCK, http_read_stream, exchange, NULL);
    else if (answer->file > 0)
        response = MHD_create_response_from_fd64(answer->size, answer->file);
    else if (answer->is_unsized)
        response = create_unsized_response();
    else if (answer->release) /* lent until the exchange ends */
        response = MHD_create_response_from_buffer(answer->size, answer->bytes, MHD_RESPMEM_PERSISTENT);
    else if (answer->bytes || answer->size == 0)
        response = MHD_create_response_from_buffer(answer->size, answer->bytes, MHD_RESPMEM_MUST_FREE);
    else /* A size without bytes (HEAD, 304): the callback is never called. */
        response = MHD_create_response_from_callback(answer->size, 1, no_bytes, NULL, NULL);
    if (response) {
        answer->bytes = NULL;
        answer->file = 0;
    }
    return response;
}

static bool add_headers(struct MHD_Response *response, const struct answer *answer)
{
    bool whole = !answer->close || MHD_add_response_header(response, "Connection", "close") == MHD_YES;
    for (size_t i = 0; i < answer->header_count && whole; i++)
        whole = MHD_add_response_header(response, answer->headers[i].name, answer->headers[i].value) == MHD_YES;
    return whole;
}

/* Passes the answer to libmicrohttpd. */
static enum MHD_Result reply(struct exchange *exchange)
{
    struct http *http = exchange->http;
    struct answer *answer = &exchange->answer;
    if (exchange->connection->phase == PHASE_REFUSED) return MHD_NO;
    if (exchange->connection->phase != PHASE_WRITE) /* answers of workers have entered it already */
        connections_enter(&http->connections, exchange->connection, PHASE_WRITE);
    router_finish(answer, exchange->http->service, &exchange->request);
    answer->close |= atomic_load(&http->leaving);
    exchange->file = answer->file;
    struct MHD_Response *response = answer->is_broken ? NULL : create_response(exchange);
    enum MHD_Result result = MHD_NO;
    if (response && add_headers(response, answer))
        result = MHD_queue_response(exchange->mhd, (unsigned)answer->status, response);
    if (response) MHD_destroy_response(response);
    exchange->replied = result == MHD_YES;
    if (result == MHD_YES) return MHD_YES;
    answer->is_broken = true;
    reply_past_library(exchange);
    return MHD_NO;
}

/* Answers before the body is here. Closing now would reset the connection while the client sends. So a short body is
 * read to its end, and a long one is answered at once. A client that waits for 100-continue is answered at once; it may
 * or may not send the body then, so its connection ends, too. */
static enum MHD_Result reply_early(struct exchange *exchange, bool is_chunked, bool expects_continue)
{
    if (is_chunked || exchange->length > DISCARD_MAX || (expects_continue && exchange->length > 0))
        reply_past_library(exchange);
    else
        exchange->step = STEP_DISCARD;
    return MHD_YES;
}

/* Counts large bodies that arrive fast and will soon be in the queue. If they were refused only then, an overloaded
 * daemon would have read them in vain. Slow bodies are not counted. */
static size_t count_coming(const struct http *http)
{
    const int64_t now = clock_ms();
    size_t count = 0;
    for (const struct connection *c = http->connections.first; c; c = c->next)
        count += c->phase == PHASE_BODY && now - c->began_ms < COMING_MS && c->exchange->step == STEP_BODY &&
                 http_lane_of(c->exchange->length) == QUEUE_LARGE;
    return count;
}

static struct load load_for(struct http *http, struct client *client, uint64_t body_bytes)
{
    const enum queue_lane lane = http_lane_of(body_bytes);
    return (struct load){
        .leaving = atomic_load(&http->leaving),
        .draining = atomic_load(&http->draining),
        .queue = queue_busy_with(http->queue, lane, lane == QUEUE_LARGE ? count_coming(http) : 0),
        .large_queue = queue_busy_with(http->queue, QUEUE_LARGE, 0),
        .answers_full = http_room_is_full(http),
        .client_full = http_room_is_taken_by(http, client),
        .retry_after_s = queue_wait_estimate_s(http->queue, lane),
    };
}

/* ---- requests ---- */

static enum MHD_Result read_accept(void *accept, enum MHD_ValueKind kind, const char *name, const char *value)
{
    (void)kind;
    if (value && strcasecmp(name, "Accept") == 0) accept_read(accept, value);
    return MHD_YES;
}

static const char *header(struct exchange *exchange, const char *name)
{
    return MHD_lookup_connection_value(exchange->mhd, MHD_HEADER_KIND, name);
}

struct header_list {
    const char *name;
    size_t used;
    char text[FRAMING_VALUES_MAX + 2 * FRAMING_FIELDS_MAX];
};

/* Joins the values of all headers of a name (RFC 9110, 5.3). framing.h bounds them. */
static enum MHD_Result join_values(void *context, enum MHD_ValueKind kind, const char *name, const char *value)
{
    struct header_list *list = context;
    (void)kind;
    const size_t length = value && strcasecmp(name, list->name) == 0 ? strlen(value) : 0;
    if (length == 0 || list->used + length + 2 >= sizeof list->text) return MHD_YES;
    list->used += (size_t)sprintf(list->text + list->used, "%s%s", list->used ? "," : "", value);
    return MHD_YES;
}

/* Finds the client for whom a trusted proxy asks. */
static void find_client(struct exchange *exchange)
{
    const struct connections *connections = &exchange->http->connections;
    struct header_list list = {.name = forwarded_header(connections->form)};
    if (!list.name) return;
    MHD_get_connection_values(exchange->mhd, MHD_HEADER_KIND, join_values, &list);
    exchange->client =
        forwarded_client(connections->form, &connections->trusted, &exchange->connection->address, list.text);
}

static void open_exchange(struct exchange *exchange, const char *method, const char *version)
{
    struct http *http = exchange->http;
    snprintf(exchange->method, sizeof exchange->method, "%s", method);
    exchange->request.method = exchange->method;
    exchange->request.content_type = header(exchange, "Content-Type");
    exchange->request.content_encoding = header(exchange, "Content-Encoding");
    exchange->request.authorization = header(exchange, "Authorization");
    exchange->request.if_none_match = header(exchange, "If-None-Match");
    exchange->request.mcp = (struct mcp_headers){header(exchange, "MCP-Protocol-Version"),
                                                 header(exchange, "Mcp-Method"), header(exchange, "Mcp-Name")};
    struct accept accept = {0};
    exchange->request.accept_encoding = header(exchange, "Accept-Encoding");
    exchange->request.origin = header(exchange, "Origin");
    exchange->request.fetch_site = header(exchange, "Sec-Fetch-Site");
    exchange->request.asked_method = header(exchange, "Access-Control-Request-Method");
    MHD_get_connection_values(exchange->mhd, MHD_HEADER_KIND, read_accept, &accept);
    exchange->request.parts = accept_parts(&accept);
    exchange->request.takes_open_metrics = accept_prefers(&accept, ACCEPT_TYPE_OPEN_METRICS, ACCEPT_TYPE_PLAIN);
    exchange->request.takes_tiff = accept_prefers(&accept, ACCEPT_TYPE_TIFF, ACCEPT_TYPE_PNG);
    if (exchange->connection->is_trusted) find_client(exchange);
    request_take_trace(&exchange->request, http->service, header(exchange, "traceparent"));
    request_take_id(&exchange->request, http->service, header(exchange, "X-Request-Id"));
    const char *length = header(exchange, "Content-Length");
    if (length) exchange->length = strtoull(length, NULL, 10); /* digits: framing_scan refuses other values */
    const char *connection = header(exchange, "Connection");
    if (strcmp(version, "HTTP/1.0") == 0)
        exchange->is_last = !connection || !strcasestr(connection, "keep-alive");
    else
        exchange->is_last = connection && strcasestr(connection, "close");
    http->in_flight++;
    exchange->opened = true;
}

static void split_target(struct exchange *exchange)
{
    static const char SCHEME[] = "http://";
    char *path = exchange->target;
    if (strncasecmp(path, SCHEME, sizeof SCHEME - 1) == 0) { /* RFC 9112, 3.2.2: the form for proxies */
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
    uint64_t most;
    open_exchange(exchange, method, version);
    split_target(exchange);
    connections_enter(&http->connections, exchange->connection, PHASE_BODY);
    const bool is_chunked = header(exchange, "Transfer-Encoding") != NULL;
    const bool expects_continue = header(exchange, "Expect") != NULL;
    exchange->holder = clients_join(&http->connections.clients, &exchange->client);
    exchange->request.load = load_for(http, exchange->holder, exchange->length);
    if (exchange->length > http->config->body_max_bytes) {
        problem_answer(answer, 413, "the body has %llu bytes; bodyMaxBytes is %llu",
                       (unsigned long long)exchange->length, (unsigned long long)http->config->body_max_bytes);
        return reply_early(exchange, is_chunked, expects_continue);
    }
    if (router_open(http->service, &exchange->request, answer) == REQUEST_ANSWERED)
        return reply_early(exchange, is_chunked, expects_continue);
    const char *forbids = connections_admit(&http->connections, exchange->connection, &exchange->client, &most);
    if (forbids) {
        char client[IP_TEXT_SIZE];
        ip_print(&exchange->client, client);
        answer_header(answer, "Retry-After", "%u", exchange->request.load.retry_after_s);
        problem_answer(answer, 429, "%s allows %llu requests in flight from %s", forbids, (unsigned long long)most,
                       client);
        answer->refusal = REFUSAL_CLIENT;
        return reply_early(exchange, is_chunked, expects_continue);
    }
    exchange->step = STEP_BODY;
    http_refuse_framing(http, exchange->connection); /* bytes after the header may be refused already */
    return MHD_YES;
}

static enum MHD_Result take_body(struct exchange *exchange, const char *bytes, size_t size)
{
    struct http *http = exchange->http;
    exchange->body_bytes += size;
    exchange->connection->body_bytes += size;
    if (exchange->step != STEP_BODY) return MHD_YES;
    switch (upload_add(&exchange->upload, &http->uploads, bytes, size, exchange->length)) {
    case UPLOAD_OK:
        return MHD_YES;
    case UPLOAD_TOO_LARGE:
        problem_answer(&exchange->answer, 413, "the body has more than bodyMaxBytes, %llu bytes",
                       (unsigned long long)http->config->body_max_bytes);
        break;
    case UPLOAD_NO_MEMORY:
        problem_busy(&exchange->answer, queue_wait_estimate_s(http->queue, QUEUE_LARGE), REFUSAL_UPLOADS);
        break;
    }
    reply_past_library(exchange);
    return MHD_YES;
}

enum MHD_Result http_on_request(void *context, struct MHD_Connection *mhd, const char *url, const char *method,
                                const char *version, const char *bytes, size_t *size, void **slot)
{
    struct exchange *exchange = *slot;
    (void)url;
    if (!exchange) { /* out of memory */
        struct connection *connection = connection_of(mhd);
        if (connection && connection->phase != PHASE_REFUSED) {
            struct http *http = context;
            struct answer answer = {0};
            answer_to_no_memory(&answer);
            http_log_connection(http, connection, NULL, &answer);
            send_past_library(http, connection, &answer);
        }
        return MHD_NO;
    }
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
