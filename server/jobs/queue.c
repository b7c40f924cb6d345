#include "queue.h"

#include <errno.h>
#include <malloc.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "clock.h"

enum { STACK_BYTES = 3 << 20, ACCEPTED_PER_WORKER = 2, OVERSEER_TICK_MS = 20, NESTED_STEPS = 4 };

/* A longer job on a worker counts as large. A job on the express counts as small, since it delays small ones. */
static const int64_t SMALL_US = QUEUE_EXPRESS_MS * INT64_C(1000);

struct lane {
    struct queue_job *first, *last;
    size_t waiting;
    double work_us; /* time of a job: moving average; 0: unknown */
};

struct worker {
    struct queue *queue;
    pthread_t thread;
    pthread_cond_t wake;
    bool is_express;
    bool is_idle;  /* waits in the stack; the thread that takes it out wakes it */
    bool is_busy;  /* has a job from `lane` */
    bool is_aside; /* has a job that waits, and no place */
    enum queue_lane lane;
    int64_t began_us, aside_us;
    struct worker *below;
    struct zr_arena arena;
    atomic_size_t used; /* bytes of its last jobs; older ones count less. The worker alone writes it */
};

struct queue {
    pthread_mutex_t lock;
    struct queue_options options;
    struct lane lanes[QUEUE_LANES];
    struct worker *idle; /* stack: the last one to work is woken first, since its memory is warm */
    size_t woken;        /* workers that were woken and have not taken a job yet */
    size_t busy;         /* jobs on workers that are not aside */
    size_t returning;    /* jobs that step back and wait for a place */
    pthread_cond_t returns;
    bool stopping;
    struct zr_cancel express_overdue; /* for the job on the express */
    pthread_t overseer;
    pthread_cond_t express_begins; /* wakes the overseer, which otherwise checks every OVERSEER_TICK_MS */
    bool overseer_runs, overseer_sleeps, overseer_ends;
    size_t worker_count;
    struct worker *express; /* last of the workers, behind those that stand in */
    struct worker workers[];
};

/* ---- with the lock held ---- */

static void append(struct queue *queue, struct queue_job *job, enum queue_lane number)
{
    struct lane *lane = &queue->lanes[number];
    job->lane = number;
    job->waiting = true;
    job->next = NULL;
    job->previous = lane->last;
    *(lane->last ? &lane->last->next : &lane->first) = job;
    lane->last = job;
    lane->waiting++;
}

static struct queue_job *take_out(struct queue *queue, struct queue_job *job)
{
    struct lane *lane = &queue->lanes[job->lane];
    *(job->previous ? &job->previous->next : &lane->first) = job->next;
    *(job->next ? &job->next->previous : &lane->last) = job->previous;
    job->waiting = false;
    lane->waiting--;
    return job;
}

/* Counts workers that are not free for a small job soon. */
static size_t count_held(const struct queue *queue)
{
    const int64_t now_us = clock_us();
    size_t held = 0;
    for (const struct worker *worker = queue->workers; worker < queue->express; worker++)
        held += worker->is_busy && !worker->is_aside &&
                (worker->lane == QUEUE_LARGE || now_us - worker->began_us > SMALL_US);
    return held;
}

/* Returns the predicted wait of a new job. Small jobs have the express and the workers without a large job. */
static double wait_us(const struct queue *queue, enum queue_lane number)
{
    const struct lane *small = &queue->lanes[QUEUE_SMALL], *large = &queue->lanes[QUEUE_LARGE];
    const size_t workers = queue->options.workers, held = count_held(queue);
    if (number == QUEUE_SMALL) {
        const size_t taken = held + large->waiting;
        return (double)small->waiting * small->work_us / (double)(taken < workers ? workers - taken + 1 : 1);
    }
    /* Running jobs are half done on average. */
    return (((double)large->waiting + 0.5 * (double)held) * large->work_us + (double)small->waiting * small->work_us) /
           (double)workers;
}

/* `coming`: jobs that will be pushed before the one in question. */
static enum refusal busy_with(const struct queue *queue, enum queue_lane number, size_t coming)
{
    const struct lane *lane = &queue->lanes[number];
    const size_t waiting = lane->waiting + coming;
    const double more_us = (double)coming * lane->work_us / (double)queue->options.workers;
    const bool is_behind = lane->first && clock_us() - lane->first->pushed_us > QUEUE_WAIT_MS * INT64_C(1000);
    if (waiting >= queue->options.capacity) return REFUSAL_QUEUE;
    if (waiting < ACCEPTED_PER_WORKER * queue->options.workers) return REFUSAL_NONE;
    return is_behind || wait_us(queue, number) + more_us > QUEUE_WAIT_MS * 1e3 ? REFUSAL_WAIT : REFUSAL_NONE;
}

static void learn(struct worker *worker, int64_t took_us)
{
    struct queue *queue = worker->queue;
    struct lane *lane = &queue->lanes[took_us > SMALL_US && !worker->is_express ? QUEUE_LARGE : worker->lane];
    lane->work_us += ((double)took_us - lane->work_us) / (lane->work_us > 0.0 ? 8.0 : 1.0);
}

/* Resets the averages after a pause: the next jobs need not take as long as the last ones. */
static void forget(struct queue *queue)
{
    for (const struct worker *worker = queue->workers; worker <= queue->express; worker++)
        if (worker->is_busy) return;
    for (int lane = 0; lane < QUEUE_LANES; lane++)
        if (queue->lanes[lane].waiting > 0) return;
    for (int lane = 0; lane < QUEUE_LANES; lane++)
        queue->lanes[lane].work_us = 0.0;
}

static struct queue_job *take_job(struct worker *worker)
{
    struct queue *queue = worker->queue;
    struct lane *small = &queue->lanes[QUEUE_SMALL], *large = &queue->lanes[QUEUE_LARGE];
    if (worker->is_express) {
        /* Woken workers will take as many jobs, and never need to put one back. */
        bool needed = queue->stopping || small->waiting + large->waiting > queue->woken;
        return small->first && needed ? take_out(queue, small->first) : NULL;
    }
    if (queue->busy + queue->returning >= queue->options.workers) { /* a job stepped back, maybe after this was woken */
        if (small->first) pthread_cond_signal(&queue->express->wake);
        return NULL;
    }
    if (small->first && (!large->first || small->first->pushed_us <= large->first->pushed_us))
        return take_out(queue, small->first);
    return large->first ? take_out(queue, large->first) : NULL;
}

/* Returns true if a thread without a job may end. A busy express may still put a job back. */
static bool is_over(const struct worker *worker)
{
    return worker->queue->stopping && (worker->is_express || !worker->queue->express->is_busy);
}

static void wake_worker(struct queue *queue)
{
    struct worker *worker = queue->idle;
    queue->idle = worker->below;
    worker->is_idle = false;
    queue->woken++;
    pthread_cond_signal(&worker->wake);
}

/* Wakes a thread for one more waiting job. */
static void wake_one(struct queue *queue)
{
    if (queue->idle && queue->busy + queue->returning + queue->woken < queue->options.workers)
        wake_worker(queue);
    else
        pthread_cond_signal(&queue->express->wake);
}

static void wake_all(struct queue *queue)
{
    while (queue->idle)
        wake_worker(queue);
    pthread_cond_signal(&queue->express->wake);
}

/* Pushes the worker on the stack; below all others if its memory has been returned, since theirs is warmer. */
static void join_idle(struct worker *worker)
{
    struct worker **link = &worker->queue->idle;
    while (worker->used == 0 && *link)
        link = &(*link)->below;
    worker->below = *link;
    *link = worker;
    worker->is_idle = true;
}

static void leave_idle(struct worker *worker)
{
    struct worker **link = &worker->queue->idle;
    while (*link != worker)
        link = &(*link)->below;
    *link = worker->below;
    worker->is_idle = false;
}

/* Waits for a job. False: `until` has passed without a wake-up. */
static bool wait_for_job(struct worker *worker, const struct timespec *until)
{
    struct queue *queue = worker->queue;
    if (!worker->is_express) join_idle(worker);
    int status = until ? pthread_cond_timedwait(&worker->wake, &queue->lock, until)
                       : pthread_cond_wait(&worker->wake, &queue->lock);
    if (worker->is_express) return status != ETIMEDOUT;
    if (!worker->is_idle) {
        queue->woken--;
        return true;
    }
    leave_idle(worker); /* while it trims or has a job, it would miss a wake-up, and `woken` would stay too high */
    return status != ETIMEDOUT;
}

/* Waits for the next job. NULL: the queue has stopped and none is left. */
static struct queue_job *next_job(struct worker *worker)
{
    struct queue *queue = worker->queue;
    const struct timespec until = clock_after_ms(queue->options.calm_ms);
    struct queue_job *job;
    bool calm = worker->used == 0;
    while (!(job = take_job(worker)) && !is_over(worker)) {
        if (wait_for_job(worker, calm ? NULL : &until)) continue;
        calm = true;
        forget(queue);
        worker->used = 0;
        pthread_mutex_unlock(&queue->lock);
        zr_arena_reset(&worker->arena, 0);
        malloc_trim(0); /* bodies, answers, memory of libraries: the heap keeps freed blocks below its end */
        pthread_mutex_lock(&queue->lock);
    }
    return job;
}

static void begin_job(struct worker *worker, struct queue_job *job)
{
    struct queue *queue = worker->queue;
    worker->is_busy = true;
    job->worker = worker;
    worker->lane = job->lane;
    worker->began_us = clock_us();
    job->overdue = worker->is_express ? &queue->express_overdue : NULL;
    if (!worker->is_express) {
        queue->busy++;
        return;
    }
    atomic_store(&queue->express_overdue.raised, false);
    if (queue->overseer_sleeps) pthread_cond_signal(&queue->express_begins);
}

/* Ends the count of a job as busy, for one that steps back. */
static void give_place(struct queue *queue)
{
    queue->busy--;
    if (queue->returning > 0) pthread_cond_signal(&queue->returns);
}

static void end_job(struct worker *worker)
{
    struct queue *queue = worker->queue;
    worker->is_busy = false;
    if (!worker->is_express) give_place(queue);
    learn(worker, clock_us() - worker->began_us);
    if (worker->is_express && queue->stopping) wake_all(queue);
}

/* ---- threads ---- */

/* Keeps somewhat more memory than was used, and a block for each of the parts that a request opens within another: a new
 * block costs a small request more than its picture. */
static void reset_arena(struct worker *worker)
{
    const size_t most_held = worker->arena.most, before = worker->used, older = before - before / 8;
    size_t used = most_held > older ? most_held : older;
    if (used == 0) used = 1; /* a job ran: libraries may hold memory */
    worker->used = used;
    /* Nested steps may each begin a block that holds little (base/arena.h). */
    const size_t keep = used + used / 2 + (size_t)NESTED_STEPS * ZR_ARENA_BLOCK;
    const size_t most = worker->queue->options.keep_memory_bytes;
    zr_arena_reset(&worker->arena, keep < most ? keep : most);
}

static void *work(void *argument)
{
    struct worker *worker = argument;
    struct queue *queue = worker->queue;
    zr_arena_init(&worker->arena, queue->options.request_memory_bytes);
    pthread_mutex_lock(&queue->lock);
    for (struct queue_job *job; (job = next_job(worker));) {
        begin_job(worker, job);
        pthread_mutex_unlock(&queue->lock);
        job->work(job, &worker->arena);
        reset_arena(worker);
        pthread_mutex_lock(&queue->lock);
        end_job(worker);
    }
    pthread_mutex_unlock(&queue->lock);
    zr_arena_free(&worker->arena);
    return NULL;
}

/* Watches the express, so that a job wrongly taken for small does not keep others from it. */
static void *oversee(void *argument)
{
    struct queue *queue = argument;
    const struct worker *express = queue->express;
    pthread_mutex_lock(&queue->lock);
    while (!queue->overseer_ends) {
        if (express->is_busy && queue->lanes[QUEUE_SMALL].first && clock_us() - express->began_us > SMALL_US)
            atomic_store(&queue->express_overdue.raised, true);
        const struct timespec until = clock_after_ms(OVERSEER_TICK_MS);
        queue->overseer_sleeps = !express->is_busy;
        if (queue->overseer_sleeps)
            pthread_cond_wait(&queue->express_begins, &queue->lock);
        else
            pthread_cond_timedwait(&queue->express_begins, &queue->lock, &until);
        queue->overseer_sleeps = false;
    }
    pthread_mutex_unlock(&queue->lock);
    return NULL;
}

static void init_workers(struct queue *queue)
{
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    queue->express = &queue->workers[queue->options.workers + queue->options.stand_ins];
    for (struct worker *worker = queue->workers; worker <= queue->express; worker++) {
        worker->queue = queue;
        worker->is_express = worker == queue->express;
        pthread_cond_init(&worker->wake, &attributes);
    }
    pthread_cond_init(&queue->express_begins, &attributes);
    pthread_cond_init(&queue->returns, &attributes);
    pthread_condattr_destroy(&attributes);
}

static int start_threads(struct queue *queue)
{
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_BYTES);
    int failure = 0;
    for (size_t i = 0; &queue->workers[i] <= queue->express && !failure; i++) {
        failure = pthread_create(&queue->workers[i].thread, &attributes, work, &queue->workers[i]);
        if (!failure) queue->worker_count++;
    }
    if (!failure) failure = pthread_create(&queue->overseer, &attributes, oversee, queue);
    queue->overseer_runs = !failure;
    pthread_attr_destroy(&attributes);
    return failure;
}

struct queue *queue_create(const struct queue_options *options)
{
    const size_t threads = options->workers + options->stand_ins + 1;
    struct queue *queue = calloc(1, sizeof *queue + threads * sizeof(struct worker));
    if (!queue) return NULL;
    queue->options = *options;
    pthread_mutex_init(&queue->lock, NULL);
    init_workers(queue);
    if (start_threads(queue) == 0) return queue;
    queue_destroy(queue);
    return NULL;
}

/* ---- from other threads ---- */

static enum refusal put(struct queue *queue, struct queue_job *job, enum queue_lane lane, bool is_new)
{
    pthread_mutex_lock(&queue->lock);
    const enum refusal busy = is_new && queue->stopping ? REFUSAL_DRAINING : busy_with(queue, lane, 0);
    if (!busy) {
        if (is_new) job->pushed_us = clock_us();
        append(queue, job, lane);
        wake_one(queue);
    }
    pthread_mutex_unlock(&queue->lock);
    return busy;
}

enum refusal queue_push(struct queue *queue, struct queue_job *job, enum queue_lane lane)
{
    return put(queue, job, lane, true);
}

enum refusal queue_put_back(struct queue *queue, struct queue_job *job)
{
    return put(queue, job, QUEUE_LARGE, false);
}

bool queue_remove(struct queue *queue, struct queue_job *job)
{
    pthread_mutex_lock(&queue->lock);
    bool found = job->waiting;
    if (found) take_out(queue, job);
    pthread_mutex_unlock(&queue->lock);
    return found;
}

void queue_step_aside(struct queue *queue, const struct queue_job *job)
{
    struct worker *worker = job->worker;
    pthread_mutex_lock(&queue->lock);
    worker->is_aside = true;
    worker->aside_us = clock_us();
    give_place(queue);
    if (queue->lanes[QUEUE_SMALL].first || queue->lanes[QUEUE_LARGE].first) wake_one(queue);
    pthread_mutex_unlock(&queue->lock);
}

void queue_step_back(struct queue *queue, const struct queue_job *job)
{
    struct worker *worker = job->worker;
    pthread_mutex_lock(&queue->lock);
    queue->returning++;
    while (queue->busy >= queue->options.workers)
        pthread_cond_wait(&queue->returns, &queue->lock);
    queue->returning--;
    worker->is_aside = false;
    worker->began_us += clock_us() - worker->aside_us;
    queue->busy++;
    pthread_mutex_unlock(&queue->lock);
}

enum refusal queue_busy_with(struct queue *queue, enum queue_lane lane, size_t coming)
{
    pthread_mutex_lock(&queue->lock);
    const enum refusal busy = busy_with(queue, lane, coming);
    pthread_mutex_unlock(&queue->lock);
    return busy;
}

unsigned queue_wait_estimate_s(struct queue *queue, enum queue_lane lane)
{
    pthread_mutex_lock(&queue->lock);
    double seconds = wait_us(queue, lane) / 1e6;
    pthread_mutex_unlock(&queue->lock);
    return seconds >= 59 ? 60 : 1 + (unsigned)seconds;
}

struct queue_state queue_look(struct queue *queue)
{
    struct queue_state state = {.workers = queue->options.workers};
    pthread_mutex_lock(&queue->lock);
    state.busy = queue->busy;
    for (int lane = 0; lane < QUEUE_LANES; lane++)
        state.waiting[lane] = queue->lanes[lane].waiting;
    for (size_t i = 0; i < queue->worker_count; i++)
        state.used_bytes += queue->workers[i].used;
    pthread_mutex_unlock(&queue->lock);
    return state;
}

void queue_stop(struct queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    queue->stopping = true;
    wake_all(queue);
    pthread_mutex_unlock(&queue->lock);
    for (size_t i = 0; i < queue->worker_count; i++)
        pthread_join(queue->workers[i].thread, NULL);
    queue->worker_count = 0;
    if (!queue->overseer_runs) return;
    pthread_mutex_lock(&queue->lock);
    queue->overseer_ends = true;
    pthread_cond_signal(&queue->express_begins);
    pthread_mutex_unlock(&queue->lock);
    pthread_join(queue->overseer, NULL);
    queue->overseer_runs = false;
}

void queue_destroy(struct queue *queue)
{
    if (!queue) return;
    queue_stop(queue);
    for (struct worker *worker = queue->workers; worker <= queue->express; worker++)
        pthread_cond_destroy(&worker->wake);
    pthread_cond_destroy(&queue->express_begins);
    pthread_cond_destroy(&queue->returns);
    pthread_mutex_destroy(&queue->lock);
    free(queue);
}
