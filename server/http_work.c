#include "http_work.h"

#include <unistd.h>

#include "clock.h"
#include "problem.h"
#include "router.h"

static const char ANSWERS_FULL[] = "the answers that wait for their readers fill answerMemoryBytes";

enum queue_lane http_lane_of(uint64_t body_bytes)
{
    return body_bytes > REQUEST_SMALL_BYTES ? QUEUE_LARGE : QUEUE_SMALL;
}

bool http_answers_are_full(struct http *http)
{
    return atomic_load(&http->answer_bytes) >= http->config->answer_memory_bytes;
}

/* Returns the exchange to the loop: libmicrohttpd will call for its answer. */
static void finish_work(struct exchange *exchange)
{
    struct http *http = exchange->http;
    if (exchange->client_left) answer_free(&exchange->answer);
    upload_free(&exchange->upload, &http->uploads);
    connections_enter(&http->connections, exchange->connection, PHASE_WRITE);
    MHD_resume_connection(exchange->mhd);
}

void http_take_finished(struct http *http)
{
    pthread_mutex_lock(&http->lock);
    struct exchange *exchange = http->finished;
    http->finished = NULL;
    pthread_mutex_unlock(&http->lock);
    while (exchange) {
        struct exchange *next = exchange->next;
        finish_work(exchange);
        exchange = next;
    }
}

/* ---- on a worker ---- */

/* The loop resumes the connection: libmicrohttpd 0.9.75 can miss it if another thread resumes it during a run. */
static void hand_over(struct exchange *exchange)
{
    static const uint64_t ONE = 1;
    struct http *http = exchange->http;
    exchange->answer_bytes = exchange->answer.bytes ? exchange->answer.size : 0;
    atomic_fetch_add(&http->answer_bytes, exchange->answer_bytes);
    pthread_mutex_lock(&http->lock);
    const bool was_empty = !http->finished;
    exchange->next = http->finished;
    http->finished = exchange;
    pthread_mutex_unlock(&http->lock);
    if (was_empty) (void)!write(http->wake_fd, &ONE, sizeof ONE);
}

static enum request_next begin(struct exchange *exchange, struct zr_arena *arena)
{
    return router_work(exchange->http->service, &exchange->request, arena, &exchange->cancel, &exchange->times,
                       &exchange->answer);
}

/* Moves a large request from the express to the workers. True: it belongs to the queue. */
static bool put_back(struct exchange *exchange, struct zr_arena *arena)
{
    struct http *http = exchange->http;
    atomic_store(&exchange->work_began_ms, 0);
    exchange->request.small_only = false;
    exchange->cancel.parent = NULL;
    if (atomic_load(&exchange->cancel.raised)) { /* cancelled just now: answered here */
        zr_arena_reset(arena, SIZE_MAX);         /* a decompressed body must not count twice */
        begin(exchange, arena);
        return false;
    }
    exchange->times = NO_STEP_TIMES;
    if (queue_put_back(http->queue, &exchange->job)) return true;
    problem_busy(&exchange->answer, queue_wait_estimate_s(http->queue, QUEUE_LARGE), "the queue is full");
    return false;
}

static void work(struct queue_job *job, struct zr_arena *arena)
{
    struct exchange *exchange = (struct exchange *)(void *)((char *)job - offsetof(struct exchange, job));
    struct http *http = exchange->http;
    exchange->times.queue_ms = (double)(clock_us() - job->pushed_us) / 1000.0;
    atomic_store(&exchange->work_began_ms, clock_ms());
    exchange->request.small_only = job->overdue != NULL;
    exchange->cancel.parent = job->overdue;
    bool cancelled = atomic_load(&exchange->cancel.raised);
    if (!cancelled && !exchange->request.asset && http_answers_are_full(http)) /* assets take no memory */
        problem_busy(&exchange->answer, queue_wait_estimate_s(http->queue, QUEUE_LARGE), ANSWERS_FULL);
    else if (!cancelled && begin(exchange, arena) == REQUEST_LARGE && put_back(exchange, arena))
        return;
    if (atomic_load(&http->cut_short) && (cancelled || exchange->answer.status == 504)) {
        answer_free(&exchange->answer);
        problem_busy(&exchange->answer, 1, "the service went down");
    }
    hand_over(exchange);
}

/* ---- on the loop ---- */

int64_t http_work_deadline_ms(const struct exchange *exchange)
{
    const int64_t began = atomic_load(&exchange->work_began_ms);
    return began > 0 ? began + (int64_t)exchange->http->config->render_timeout_ms : INT64_MAX;
}

void http_cancel_work(struct exchange *exchange)
{
    atomic_store(&exchange->cancel.raised, true);
}

void http_abandon_work(struct http *http, struct exchange *exchange)
{
    exchange->client_left = true;
    http_cancel_work(exchange);
    if (queue_remove(http->queue, &exchange->job)) finish_work(exchange);
}

enum MHD_Result http_begin_work(struct exchange *exchange)
{
    struct http *http = exchange->http;
    exchange->request.render.bytes = exchange->upload.bytes ? exchange->upload.bytes : "";
    exchange->request.render.size = exchange->upload.size;
    exchange->step = STEP_ANSWER;
    exchange->job.work = work;
    if (exchange->connection->has_left) {
        exchange->client_left = true;
        return MHD_NO;
    }
    connections_enter(&http->connections, exchange->connection, PHASE_WORK);
    /* Suspended before it is pushed: a worker may finish before queue_push returns. */
    MHD_suspend_connection(exchange->mhd);
    enum queue_lane lane = http_lane_of(exchange->upload.size);
    if (!queue_push(http->queue, &exchange->job, lane)) {
        problem_busy(&exchange->answer, queue_wait_estimate_s(http->queue, lane), "the queue is full");
        finish_work(exchange);
    }
    return MHD_YES;
}
