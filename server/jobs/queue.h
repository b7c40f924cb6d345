/* queue.h - two bounded queues of jobs, and the threads that run them.
 *
 * Fairness: small jobs wait in one queue, large jobs in another, by a first guess. Workers take the oldest job of both.
 * One more thread, the express, takes only small jobs, while all workers are busy. So a small job never waits for a
 * large one to end. If a job on the express turns out to be large, it moves to the large queue. A job on the express is
 * asked to move if it takes longer than QUEUE_EXPRESS_MS and another small job waits. Running threads share the
 * processors by the kernel's rules.
 *
 * Waiting: a job that waits for its reader steps aside. A thread that stands in takes its place, so waiting jobs cost
 * others nothing. When it steps back, it takes the place of the next worker to end, before all jobs that have not begun.
 *
 * Bounds: a queue accepts up to two jobs per worker. Beyond that it accepts only jobs that should start within
 * QUEUE_WAIT_MS, by the times of its last jobs, and none if its oldest job has waited longer than that. It never holds
 * more than `capacity` jobs.
 *
 * Ownership: a job is a member of its user's structure. The queue owns it from queue_push, or queue_put_back, until its
 * `work` is called or queue_remove returns it.
 *
 * Memory: a thread keeps about the memory that its last jobs used, up to keep_memory_bytes, to avoid page faults. After
 * calm_ms without a job, all of it returns to the system.
 */
#ifndef ZRASTERD_QUEUE_H
#define ZRASTERD_QUEUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "refusal.h"

enum queue_lane { QUEUE_SMALL, QUEUE_LARGE, QUEUE_LANES };

/* QUEUE_EXPRESS_MS: six times the largest predicted time of a small request. */
enum { QUEUE_EXPRESS_MS = 60, QUEUE_WAIT_MS = 1000 };

struct queue;

struct queue_job {
    /* For the queue, while the job waits: */
    struct queue_job *next, *previous;
    enum queue_lane lane;
    bool waiting;

    struct worker *worker; /* for the queue, while the job runs */
    int64_t pushed_us;     /* set by queue_push, on clock_us */
    /* Set by the queue before `work`. NULL: the job is on a worker. Otherwise it is on the express: if it is large, it
     * must call queue_put_back, at the latest soon after this is raised. */
    const struct zr_cancel *overdue;
    /* Runs the job on a worker or the express. The queue no longer uses the job, so `work` may pass it to others. Its
     * memory in the arena ends when it returns. */
    void (*work)(struct queue_job *job, struct zr_arena *arena);
};

struct queue_options {
    size_t workers;   /* without the express */
    size_t stand_ins; /* jobs that may step aside at once */
    size_t capacity;  /* waiting jobs per queue */
    size_t request_memory_bytes, keep_memory_bytes;
    uint64_t calm_ms;
};

/* NULL: no threads or no memory available. */
struct queue *queue_create(const struct queue_options *options);

/* Adds a job. REFUSAL_QUEUE or REFUSAL_WAIT: the queue is full, and the job stays the caller's. */
enum refusal queue_push(struct queue *queue, struct queue_job *job, enum queue_lane lane);

/* Called by `work` on the express for a large job: moves it to the workers. REFUSAL_NONE: the queue owns the job. Else it
 * is full. */
enum refusal queue_put_back(struct queue *queue, struct queue_job *job);

/* Called by `work` on a worker, not on the express, before and after a wait. queue_step_back returns once fewer than
 * options.workers jobs are at work. */
void queue_step_aside(struct queue *queue, const struct queue_job *job);
void queue_step_back(struct queue *queue, const struct queue_job *job);

/* True: the job was waiting and is the caller's again. False: it is or was on a worker. */
bool queue_remove(struct queue *queue, struct queue_job *job);

/* Returns the reason why the queue would accept no job after `coming` further jobs: REFUSAL_QUEUE by count, REFUSAL_WAIT
 * by time. */
enum refusal queue_busy_with(struct queue *queue, enum queue_lane lane, size_t coming);

/* Returns the predicted wait of a new job in s, 1..60, from the times of the last jobs. */
unsigned queue_wait_estimate_s(struct queue *queue, enum queue_lane lane);

struct queue_state {
    size_t waiting[QUEUE_LANES];
    size_t workers, busy; /* busy: jobs at work, without the express, and without those that wait for their readers */
    size_t used_bytes;    /* memory of the last jobs of all threads, which the threads keep for the next ones */
};

struct queue_state queue_look(struct queue *queue);

/* Runs all waiting jobs and ends the threads. Afterwards it accepts no job; the functions above may still be called. */
void queue_stop(struct queue *queue);

/* Stops the queue if it still runs, and frees it. */
void queue_destroy(struct queue *queue);

#endif
