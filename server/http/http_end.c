#include "http_end.h"

#include <stdlib.h>

#include "clock.h"
#include "http_room.h"
#include "log/log.h"
#include "metrics/metrics.h"

/* All requests pass here once: those of exchanges, and those that libmicrohttpd never saw. */
static void tell(const struct http *http, const struct ip *peer, const struct ip *client, struct log_request *request)
{
    char peer_text[IP_TEXT_SIZE], client_text[IP_TEXT_SIZE];
    if (http->is_self_test) return;
    ip_print(peer, peer_text);
    ip_print(client, client_text);
    request->remote = peer_text;
    request->client = client_text;
    log_request(request);
    metrics_count(http->service->metrics, request);
}

/* The times of work belong to the worker until it ends. */
void http_log_exchange(struct exchange *exchange)
{
    const struct answer *answer = &exchange->answer;
    const bool is_at_work = exchange->is_working;
    const char *detail = answer->detail;
    if (exchange->logged) return;
    exchange->logged = true;
    if (exchange->was_slow)
        detail = "the answer was read too slowly";
    else if (exchange->client_left)
        detail = "the client left";
    else if (!answer->status)
        detail = "the request was malformed or not whole";
    else if (!is_at_work && exchange->stream.is_begun)
        detail = exchange->made.detail;
    tell(exchange->http, &exchange->peer, &exchange->client,
         &(struct log_request){
             .id = exchange->request.id,
             .method = exchange->method,
             .route = exchange->request.route ? exchange->request.route->path : NULL,
             .path = exchange->request.path,
             .query = exchange->request.query,
             .look = answer_find(answer, "Zraster-Look"),
             .warnings = answer->warnings + (is_at_work ? 0 : exchange->made.warnings),
             .trace = &exchange->request.trace,
             .detail = detail,
             .status = exchange->replied ? answer->status : 0,
             .refusal = answer->refusal,
             .client_left = exchange->client_left,
             .was_slow = exchange->was_slow,
             .aborted = !exchange->is_whole,
             .bytes_in = exchange->body_bytes,
             .bytes_out = exchange->bytes_out,
             .total_ms = (double)(clock_us() - exchange->began_us) / 1000.0,
             .times = is_at_work ? NO_STEP_TIMES : exchange->times,
         });
}

void http_log_connection(const struct http *http, const struct connection *connection, const char *id,
                         const struct answer *answer)
{
    tell(http, &connection->peer, &connection->address,
         &(struct log_request){
             .id = id,
             .status = answer->status,
             .refusal = answer->refusal,
             .aborted = answer->status == 0,
             .bytes_out = answer->size,
             .total_ms = (double)(clock_ms() - connection->began_ms),
             .times = NO_STEP_TIMES,
             .detail = answer->detail,
         });
}

void http_close_exchange(struct exchange *exchange)
{
    struct http *http = exchange->http;
    http_log_exchange(exchange);
    http_room_leave(exchange);
    upload_free(&exchange->upload, &http->uploads);
    if (exchange->request.stream) stream_free(&exchange->stream);
    free(exchange->request.render);
    answer_free(&exchange->answer);
    answer_free(&exchange->made);
    free(exchange->target);
    if (exchange->opened) http->in_flight--;
    free(exchange);
}
