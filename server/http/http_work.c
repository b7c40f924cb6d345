#include "http_work.h"

#include <unistd.h>

#include "clock.h"
#include "http_end.h"
#include "http_equal.h"
#include "http_room.h"
#include "problem.h"
#include "routes/parts.h"

enum queue_lane http_lane_of(uint64_t body_bytes)
{
    return body_bytes > REQUEST_SMALL_BYTES ? QUEUE_LARGE : QUEUE_SMALL;
}

/* ---- on a worker ---- */

/* Puts the exchange on the list of the loop. It resumes the connection: libmicrohttpd 0.9.75 can miss it if another
 * thread resumes it during a run. If work has ended, the exchange may be gone at once. */
static void report(struct exchange *exchange, bool has_answer, bool has_ended)
{
    static const uint64_t ONE = 1;
    struct http *http = exchange->http;
    pthread_mutex_lock(&http->lock);
    const bool was_empty = !http->reports;
    exchange->has_answer |= has_answer;
    exchange->has_ended |= has_ended;
    if (!exchange->is_reported) {
        exchange->is_reported = true;
        exchange->next = http->reports;
        http->reports = exchange;
    }
    pthread_mutex_unlock(&http->lock);
    if (was_empty) (void)!write(http->wake_fd, &ONE, sizeof ONE);
}

static void hand_over(struct exchange *exchange, struct answer *answer, size_t bytes, bool has_ended)
{
    exchange->answer = *answer;
    *answer = (struct answer){0};
    exchange->answer_bytes = bytes;
    http_room_take(exchange, bytes);
    report(exchange, true, has_ended);
}

/* ---- of a stream, on a worker ---- */

static enum refusal open_stream(void *context)
{
    return http_room_open_stream(context);
}

static void begin_stream(void *context, struct answer *answer)
{
    hand_over(context, answer, STREAM_ROOM, false);
}

static void wake_reader(void *context)
{
    report(context, false, false);
}

/* While work waits for the reader, its clock stops, and its memory counts as that of answers. The memory is added
 * before another work can take the place, and subtracted once the place is taken back. */
static enum refusal wait_for_reader(void *context, bool begins)
{
    struct exchange *exchange = context;
    struct http *http = exchange->http;
    struct queue *queue = http->queue;
    const size_t held = exchange->stream.held_bytes;
    enum refusal refusal = REFUSAL_NONE;
    if (begins) {
        refusal = http_room_take_stream(exchange, held);
        if (refusal) exchange->stream.held_bytes = 0; /* it ends at once */
        exchange->spent_ms = clock_ms() - atomic_load(&exchange->work_began_ms);
        atomic_store(&exchange->work_began_ms, 0);
        queue_step_aside(queue, &exchange->job);
    } else {
        queue_step_back(queue, &exchange->job);
        http_room_return(exchange, held);
        atomic_store(&exchange->work_began_ms, clock_ms() - exchange->spent_ms);
    }
    return refusal;
}

static void prepare_stream(struct exchange *exchange)
{
    const struct stream_owner owner = {open_stream, begin_stream, wake_reader, wait_for_reader, exchange};
    if (exchange->request.parts == ACCEPT_NO_PARTS) return;
    stream_init(&exchange->stream, &owner);
    exchange->request.stream = &exchange->stream;
}

/* ---- work ---- */

static enum request_next begin(struct exchange *exchange, struct zr_arena *arena)
{
    const struct request *request = &exchange->request;
    const struct zr_cancel *cancel = &exchange->cancel;
    return request->route->work(&(struct work){.service = exchange->http->service,
                                               .request = request,
                                               .arena = arena,
                                               .cancel = cancel,
                                               .reading = request->small_only ? cancel->parent : cancel,
                                               .times = &exchange->times,
                                               .answer = &exchange->made});
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
    const enum refusal busy = queue_put_back(http->queue, &exchange->job);
    if (!busy) return true;
    problem_busy(&exchange->made, queue_wait_estimate_s(http->queue, QUEUE_LARGE), busy);
    return false;
}

static void work(struct queue_job *job, struct zr_arena *arena)
{
    struct exchange *exchange = (struct exchange *)(void *)((char *)job - offsetof(struct exchange, job));
    struct http *http = exchange->http;
    struct answer *made = &exchange->made;
    exchange->times.queue_ms = (double)(clock_us() - job->pushed_us) / 1000.0;
    atomic_store(&exchange->work_began_ms, clock_ms());
    exchange->request.small_only = job->overdue != NULL;
    exchange->cancel.parent = job->overdue;
    exchange->request.load.answers_short = http_room_is_small(http, 0);
    bool cancelled = atomic_load(&exchange->cancel.raised);
    if (!cancelled && !exchange->request.asset && http_room_is_full(http)) /* assets take no memory */
        problem_busy(made, queue_wait_estimate_s(http->queue, QUEUE_LARGE), REFUSAL_ANSWERS);
    else if (!cancelled && begin(exchange, arena) == REQUEST_LARGE && put_back(exchange, arena))
        return;
    if (atomic_load(&http->cut_short) && (cancelled || made->status == 504)) {
        answer_free(made);
        problem_busy(made, 1, REFUSAL_DRAINING);
    }
    http_room_close_stream(exchange);
    if (exchange->stream.is_begun) {
        parts_end(&exchange->stream, made);
        report(exchange, false, true);
    } else {
        hand_over(exchange, made, made->bytes ? made->size : 0, true);
    }
}

/* ---- on the loop ---- */

bool http_is_streaming(const struct exchange *exchange)
{
    return exchange->is_working && exchange->connection->phase == PHASE_WRITE;
}

/* The reader's deadline moves by the time in which the stream had no bytes. */
static void resume_stream(struct exchange *exchange)
{
    if (!exchange->is_suspended) return;
    exchange->is_suspended = false;
    connections_pause(exchange->connection, clock_ms() - exchange->suspended_ms);
    MHD_resume_connection(exchange->mhd);
}

ssize_t http_read_stream(void *context, uint64_t position, char *bytes, size_t size)
{
    struct exchange *exchange = context;
    const ptrdiff_t count = stream_read(&exchange->stream, bytes, size);
    (void)position;
    if (count == STREAM_AT_END) return MHD_CONTENT_READER_END_OF_STREAM;
    if (count == STREAM_AT_BREAK) return MHD_CONTENT_READER_END_WITH_ERROR;
    exchange->answer.size += (size_t)count;
    if (count > 0) return count;
    exchange->is_suspended = true;
    exchange->suspended_ms = clock_ms();
    MHD_suspend_connection(exchange->mhd);
    return 0;
}

void http_cut_stream(struct exchange *exchange)
{
    http_cancel_work(exchange);
    if (exchange->request.stream) stream_close(&exchange->stream);
    if (!exchange->is_over) resume_stream(exchange);
}

/* Returns a connection to libmicrohttpd, which will call for its answer. */
static void begin_answer(struct exchange *exchange)
{
    if (exchange->client_left) answer_free(&exchange->answer);
    connections_enter(&exchange->http->connections, exchange->connection, PHASE_WRITE);
    MHD_resume_connection(exchange->mhd);
}

static void end_work(struct exchange *exchange)
{
    exchange->is_working = false;
    http_equal_leave(exchange);
    upload_free(&exchange->upload, &exchange->http->uploads);
}

/* Gives the exchange to a worker, or refuses it. */
static void push(struct exchange *exchange)
{
    struct http *http = exchange->http;
    const enum queue_lane lane = http_lane_of(exchange->upload.size);
    const enum refusal busy = queue_push(http->queue, &exchange->job, lane);
    if (!busy) return;
    problem_busy(&exchange->answer, queue_wait_estimate_s(http->queue, lane), busy);
    end_work(exchange);
    begin_answer(exchange);
}

/* Returns true if an answer depends on nothing but the request: errors may tell of a moment, a place or a deadline. */
static bool is_shareable(const struct answer *answer)
{
    return answer->status >= 200 && answer->status < 400 && !answer->is_broken && answer->file <= 0;
}

/* Gives a follower the answer of its leader. False: there is no room, and it stays to be worked on. */
static bool share_answer(struct exchange *leader, struct exchange *follower)
{
    struct http *http = leader->http;
    if (!is_shareable(&leader->answer) || http_room_is_full(http)) return false;
    if (http_room_is_taken_by(http, follower->holder)) return false; /* its answers have half of the room */
    if (!answer_share(&leader->answer, &follower->answer)) return false;
    http->shared_answers++;
    follower->answer_bytes = follower->answer.bytes ? follower->answer.size : 0;
    http_room_take(follower, follower->answer_bytes);
    end_work(follower);
    begin_answer(follower);
    return true;
}

static void end_following(struct exchange *leader)
{
    for (struct exchange *follower; (follower = http_equal_take_follower(leader));)
        if (!share_answer(leader, follower)) push(follower);
}

static struct exchange *take_report(struct http *http, bool *has_answer, bool *has_ended)
{
    pthread_mutex_lock(&http->lock);
    struct exchange *exchange = http->reports;
    if (exchange) {
        http->reports = exchange->next;
        *has_answer = exchange->has_answer;
        *has_ended = exchange->has_ended;
        exchange->is_reported = exchange->has_answer = exchange->has_ended = false;
    }
    pthread_mutex_unlock(&http->lock);
    return exchange;
}

void http_take_reports(struct http *http)
{
    struct exchange *exchange;
    bool has_answer = false, has_ended = false;
    while ((exchange = take_report(http, &has_answer, &has_ended))) {
        if (has_ended) end_work(exchange);
        if (has_ended) end_following(exchange);
        if (exchange->is_over && has_ended)
            http_close_exchange(exchange);
        else if (has_answer)
            begin_answer(exchange);
        else if (!exchange->is_over)
            resume_stream(exchange);
    }
}

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
    struct exchange *leader = exchange->leader;
    exchange->client_left = true;
    if (exchange->followers) return;
    http_cut_stream(exchange);
    if (!leader && !queue_remove(http->queue, &exchange->job)) return;
    end_work(exchange);
    begin_answer(exchange);
    if (leader && leader->client_left) http_abandon_work(http, leader); /* unless others follow it */
}

enum MHD_Result http_begin_work(struct exchange *exchange)
{
    struct http *http = exchange->http;
    exchange->request.body = exchange->upload.bytes ? exchange->upload.bytes : "";
    exchange->request.body_size = exchange->upload.size;
    exchange->step = STEP_ANSWER;
    exchange->job.work = work;
    if (exchange->connection->has_left) {
        exchange->client_left = true;
        return MHD_NO;
    }
    connections_enter(&http->connections, exchange->connection, PHASE_WORK);
    /* Suspended before it is pushed: a worker may finish before queue_push returns. */
    MHD_suspend_connection(exchange->mhd);
    prepare_stream(exchange);
    exchange->is_working = true;
    if (http_equal_follow(exchange)) return MHD_YES;
    http_equal_lead(exchange);
    push(exchange);
    return MHD_YES;
}
