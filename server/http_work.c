#include "http_work.h"

#include "clock.h"
#include "problem.h"

enum queue_lane http_lane_of(uint64_t body_bytes)
{
    return body_bytes > API_SMALL_BYTES ? QUEUE_LARGE : QUEUE_SMALL;
}

/* The exchange belongs to libmicrohttpd's thread again. */
static void finish_work(struct exchange *exchange)
{
    struct http *http = exchange->http;
    struct MHD_Connection *connection = exchange->connection;
    if (watchdog_leave_work(http->watchdog, exchange->watch)) answer_free(&exchange->answer);
    upload_free(&exchange->upload, &http->uploads);
    MHD_resume_connection(connection);
}

static enum api_next begin(struct exchange *exchange, struct zr_arena *arena)
{
    return api_work(exchange->http->api, &exchange->request, arena, &exchange->cancel, &exchange->times,
                    &exchange->answer);
}

/* What is large goes from the express to the workers. True: it is not ours any more. */
static bool put_back(struct exchange *exchange, struct zr_arena *arena)
{
    struct http *http = exchange->http;
    watchdog_work_waits(http->watchdog, exchange->watch);
    exchange->request.small_only = false;
    if (atomic_load(&exchange->cancel.raised)) { /* just now: that has an answer, too */
        zr_arena_reset(arena, SIZE_MAX);         /* an inflated body is not to count twice */
        begin(exchange, arena);
        return false;
    }
    exchange->times = API_NO_TIMES;
    if (queue_put_back(http->queue, &exchange->job)) return true;
    api_refuse_busy(&exchange->answer, queue_wait_estimate_s(http->queue), "the queue is full");
    return false;
}

static void work(struct queue_job *job, struct zr_arena *arena)
{
    struct exchange *exchange = (struct exchange *)(void *)((char *)job - offsetof(struct exchange, job));
    struct http *http = exchange->http;
    exchange->times.queue_ms = (double)(clock_us() - job->pushed_us) / 1000.0;
    watchdog_work_begins(http->watchdog, exchange->watch);
    exchange->request.small_only = job->on_express;
    bool cancelled = atomic_load(&exchange->cancel.raised);
    if (!cancelled && begin(exchange, arena) == API_LARGE && put_back(exchange, arena)) return;
    if (atomic_load(&http->cut_short) && (cancelled || exchange->answer.status == 504)) {
        answer_free(&exchange->answer);
        api_refuse_busy(&exchange->answer, 1, "the service went down");
    }
    finish_work(exchange);
}

static bool withdraw(void *context, void *owner)
{
    return queue_remove(((struct http *)context)->queue, &((struct exchange *)owner)->job);
}

static void release(void *context, void *owner)
{
    (void)context;
    finish_work(owner);
}

static void expired(void *context, struct watch *watch, struct answer *answer)
{
    struct http *http = context;
    struct exchange *exchange = watch->owner;
    struct api_request nameless = {0};
    if (!exchange) api_take_id(http->api, &nameless, NULL);
    problem_answer(answer, 408, exchange ? "the body came too slowly" : "the header came too slowly");
    api_finish(answer, exchange ? exchange->request.id : nameless.id);
}

const struct watchdog_calls HTTP_WATCHDOG_CALLS = {expired, withdraw, release};

enum MHD_Result http_begin_work(struct exchange *exchange)
{
    struct http *http = exchange->http;
    exchange->request.render.bytes = exchange->upload.bytes ? exchange->upload.bytes : "";
    exchange->request.render.size = exchange->upload.size;
    exchange->step = STEP_ANSWER;
    exchange->job.work = work;
    if (!watchdog_enter_work(http->watchdog, exchange->watch, &exchange->cancel)) return MHD_NO;
    /* First suspended, then pushed: a worker may be done before queue_push returns. */
    MHD_suspend_connection(exchange->connection);
    if (!queue_push(http->queue, &exchange->job, http_lane_of(exchange->upload.size))) {
        api_refuse_busy(&exchange->answer, queue_wait_estimate_s(http->queue), "the queue is full");
        finish_work(exchange);
    }
    return MHD_YES;
}
