#include "http_end.h"

#include <stdlib.h>

#include "clock.h"
#include "log/log.h"

/* The times of work belong to the worker until it ends. */
void http_log_exchange(struct exchange *exchange)
{
    const char *detail = exchange->answer.detail;
    if (exchange->logged || exchange->http->is_self_test) return;
    exchange->logged = true;
    if (exchange->was_slow)
        detail = "the answer was read too slowly";
    else if (exchange->client_left)
        detail = "the client left";
    else if (!exchange->answer.status)
        detail = "the request was malformed or not whole";
    else if (!exchange->is_working && exchange->stream.is_begun)
        detail = exchange->made.detail;
    log_request(&(struct log_request){
        .id = exchange->request.id,
        .remote = exchange->remote,
        .method = exchange->method,
        .path = exchange->request.path,
        .query = exchange->request.query,
        .traceparent = exchange->traceparent,
        .detail = detail,
        .status = exchange->replied ? exchange->answer.status : 0,
        .aborted = !exchange->is_whole,
        .bytes_in = exchange->body_bytes,
        .bytes_out = exchange->bytes_out,
        .total_ms = (double)(clock_us() - exchange->began_us) / 1000.0,
        .times = exchange->is_working ? NO_STEP_TIMES : exchange->times,
    });
}

void http_close_exchange(struct exchange *exchange)
{
    struct http *http = exchange->http;
    http_log_exchange(exchange);
    atomic_fetch_sub(&http->answer_bytes, exchange->answer_bytes);
    upload_free(&exchange->upload, &http->uploads);
    if (exchange->request.stream) stream_free(&exchange->stream);
    request_free(&exchange->request);
    answer_free(&exchange->answer);
    answer_free(&exchange->made);
    free(exchange->target);
    if (exchange->opened) http->in_flight--;
    free(exchange);
}
