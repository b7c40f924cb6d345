#include "queue.h"

#include <errno.h>
#include <malloc.h>
#include <pthread.h>
#include <stdlib.h>

#include "clock.h"

enum { STACK_BYTES = 1 << 20 };

struct lane {
    struct queue_job *first;
    size_t waiting;
};

struct worker {
    struct queue *queue;
    pthread_t thread;
    pthread_cond_t wake;
    bool is_express;
    bool is_idle; /* in the stack, and waiting: who else takes it out wakes it */
    struct worker *below;
    struct zr_arena arena;
    size_t used; /* by its last jobs; older ones count less and less */
};

struct queue {
    pthread_mutex_t lock;
    struct queue_options options;
    struct lane lanes[QUEUE_LANES];
    struct worker *idle;   /* a stack: who worked last is the first to be woken, for its memory is warm */
    size_t running, woken; /* woken: workers on their way to a job */
    double work_us;        /* moving average over the last jobs */
    bool express_busy, stopping;
    size_t worker_count;
    struct worker *express; /* the last of the workers */
    struct worker workers[];
};

/* ---- with the lock held ---- */

static void append(struct lane *lane, struct queue_job *job)
{
    struct queue_job **link = &lane->first;
    while (*link)
        link = &(*link)->next;
    job->next = NULL;
    *link = job;
    lane->waiting++;
}

static struct queue_job *take_first(struct lane *lane)
{
    struct queue_job *job = lane->first;
    lane->first = job->next;
    lane->waiting--;
    return job;
}

static struct queue_job *take_job(struct worker *worker)
{
    struct queue *queue = worker->queue;
    struct lane *small = &queue->lanes[QUEUE_SMALL], *large = &queue->lanes[QUEUE_LARGE];
    if (worker->is_express) {
        /* Workers on their way, who would not have to put anything back, come to as many jobs. */
        bool needed = queue->stopping || small->waiting + large->waiting > queue->woken;
        return small->first && needed ? take_first(small) : NULL;
    }
    if (small->first && (!large->first || small->first->pushed_us <= large->first->pushed_us)) return take_first(small);
    return large->first ? take_first(large) : NULL;
}

/* The express may still put a job back. */
static bool is_over(const struct worker *worker)
{
    return worker->queue->stopping && (worker->is_express || !worker->queue->express_busy);
}

/* One more job is waiting. */
static void wake_one(struct queue *queue)
{
    struct worker *worker = queue->idle;
    if (worker) {
        queue->idle = worker->below;
        worker->is_idle = false;
        queue->woken++;
    }
    pthread_cond_signal(worker ? &worker->wake : &queue->express->wake);
}

static void wake_all(struct queue *queue)
{
    while (queue->idle)
        wake_one(queue);
    pthread_cond_signal(&queue->express->wake);
}

/* On top of the stack; or, where its memory went back, below all others: theirs is no colder. */
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

/* False once `until` has come, and nobody woke us. */
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
    leave_idle(worker); /* who trims, or takes a job unasked, would not hear a wake and not count it off */
    return status != ETIMEDOUT;
}

/* NULL once the queue stops and nothing waits. */
static struct queue_job *next_job(struct worker *worker)
{
    struct queue *queue = worker->queue;
    const struct timespec until = clock_after_ms(queue->options.calm_ms);
    struct queue_job *job;
    bool calm = worker->used == 0;
    while (!(job = take_job(worker)) && !is_over(worker)) {
        if (wait_for_job(worker, calm ? NULL : &until)) continue;
        calm = true;
        worker->used = 0;
        pthread_mutex_unlock(&queue->lock);
        zr_arena_reset(&worker->arena, 0);
        malloc_trim(0); /* bodies, answers and what libraries had: the heap keeps what is freed below its end */
        pthread_mutex_lock(&queue->lock);
    }
    if (job) {
        queue->running++;
        if (worker->is_express) queue->express_busy = true;
    }
    return job;
}

/* ---- threads ---- */

/* Blocks of an arena are not filled to their ends, so somewhat more than was used is kept, and one block at least: a
 * new one costs a small request more than its picture does. */
static void reset_arena(struct worker *worker)
{
    size_t used = worker->arena.used, older = worker->used - worker->used / 8;
    worker->used = used > older ? used : older;
    if (worker->used == 0) worker->used = 1; /* something was done: libraries may have memory */
    const size_t keep = worker->used + worker->used / 2 + ZR_ARENA_BLOCK;
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
        job->on_express = worker->is_express;
        pthread_mutex_unlock(&queue->lock);
        int64_t began = clock_us();
        job->work(job, &worker->arena);
        double took = (double)(clock_us() - began);
        reset_arena(worker);
        pthread_mutex_lock(&queue->lock);
        queue->running--;
        queue->work_us += (took - queue->work_us) / 8;
        if (worker->is_express) queue->express_busy = false;
        if (worker->is_express && queue->stopping) wake_all(queue);
    }
    pthread_mutex_unlock(&queue->lock);
    zr_arena_free(&worker->arena);
    return NULL;
}

static void init_workers(struct queue *queue)
{
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    queue->express = &queue->workers[queue->options.workers];
    for (struct worker *worker = queue->workers; worker <= queue->express; worker++) {
        worker->queue = queue;
        worker->is_express = worker == queue->express;
        pthread_cond_init(&worker->wake, &attributes);
    }
    pthread_condattr_destroy(&attributes);
}

static int start_threads(struct queue *queue)
{
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_BYTES);
    int failure = 0;
    for (size_t i = 0; i <= queue->options.workers && !failure; i++) {
        failure = pthread_create(&queue->workers[i].thread, &attributes, work, &queue->workers[i]);
        if (!failure) queue->worker_count++;
    }
    pthread_attr_destroy(&attributes);
    return failure;
}

struct queue *queue_create(const struct queue_options *options)
{
    struct queue *queue = calloc(1, sizeof *queue + (options->workers + 1) * sizeof(struct worker));
    if (!queue) return NULL;
    queue->options = *options;
    pthread_mutex_init(&queue->lock, NULL);
    init_workers(queue);
    if (start_threads(queue) == 0) return queue;
    queue_destroy(queue);
    return NULL;
}

/* ---- from other threads ---- */

bool queue_push(struct queue *queue, struct queue_job *job, enum queue_lane lane)
{
    pthread_mutex_lock(&queue->lock);
    bool room = !queue->stopping && queue->lanes[lane].waiting < queue->options.capacity;
    if (room) {
        job->pushed_us = clock_us();
        append(&queue->lanes[lane], job);
        wake_one(queue);
    }
    pthread_mutex_unlock(&queue->lock);
    return room;
}

bool queue_put_back(struct queue *queue, struct queue_job *job)
{
    pthread_mutex_lock(&queue->lock);
    bool room = queue->lanes[QUEUE_LARGE].waiting < queue->options.capacity;
    if (room) {
        append(&queue->lanes[QUEUE_LARGE], job);
        wake_one(queue);
    }
    pthread_mutex_unlock(&queue->lock);
    return room;
}

static bool remove_from(struct lane *lane, const struct queue_job *job)
{
    struct queue_job **link = &lane->first;
    while (*link && *link != job)
        link = &(*link)->next;
    if (!*link) return false;
    *link = job->next;
    lane->waiting--;
    return true;
}

bool queue_remove(struct queue *queue, struct queue_job *job)
{
    pthread_mutex_lock(&queue->lock);
    bool found = remove_from(&queue->lanes[QUEUE_SMALL], job) || remove_from(&queue->lanes[QUEUE_LARGE], job);
    pthread_mutex_unlock(&queue->lock);
    return found;
}

bool queue_is_full(struct queue *queue, enum queue_lane lane)
{
    pthread_mutex_lock(&queue->lock);
    bool full = queue->lanes[lane].waiting >= queue->options.capacity;
    pthread_mutex_unlock(&queue->lock);
    return full;
}

unsigned queue_wait_estimate_s(struct queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    size_t jobs = queue->lanes[QUEUE_SMALL].waiting + queue->lanes[QUEUE_LARGE].waiting + queue->running;
    double seconds = (double)jobs * queue->work_us / (double)queue->options.workers / 1e6;
    pthread_mutex_unlock(&queue->lock);
    return seconds >= 59 ? 60 : 1 + (unsigned)seconds;
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
}

void queue_destroy(struct queue *queue)
{
    if (!queue) return;
    queue_stop(queue);
    for (struct worker *worker = queue->workers; worker <= queue->express; worker++)
        pthread_cond_destroy(&worker->wake);
    pthread_mutex_destroy(&queue->lock);
    free(queue);
}
