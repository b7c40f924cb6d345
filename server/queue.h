/* queue.h - two bounded queues, and the threads that work them off.
 *
 * Fair to small jobs: what seems to be large waits in one queue, what seems to be small in
 * another. Workers take the oldest job of both. One thread more, the express, takes small
 * jobs alone, while every worker is busy: so a small one never waits until a large one ends,
 * however many of those there are. A job that turns out to be large there goes to the large; one that seems to be
 * small and yet has held the express up for QUEUE_EXPRESS_MS, while another waits for it, is told to go there.
 * Who runs shares the processors by the kernel's rules.
 *
 * Bounded in time: beyond two a worker, a queue takes only what would be begun within QUEUE_WAIT_MS, by how long the
 * last jobs of its kind took, and nothing while its oldest job has waited for longer than that; and no more than
 * `capacity`, whatever they take.
 *
 * A job is a member of what it works for. It belongs to the queue from queue_push until
 * its `work` is called or queue_remove has given it back; and again from queue_put_back on.
 *
 * Memory: a thread keeps about what its last jobs used, up to keep_memory_bytes, so that pages are not
 * touched for the first time again and again. After calm_ms without a job all goes back to the system.
 */
#ifndef ZRASTERD_QUEUE_H
#define ZRASTERD_QUEUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/cancel.h"

enum queue_lane { QUEUE_SMALL, QUEUE_LARGE, QUEUE_LANES };

/* QUEUE_EXPRESS_MS: six times what a small request may be predicted to take. */
enum { QUEUE_EXPRESS_MS = 60, QUEUE_WAIT_MS = 1000 };

struct queue;

struct queue_job {
    /* The queue's own, while it waits: */
    struct queue_job *next, *previous;
    enum queue_lane lane;
    bool waiting;

    int64_t pushed_us; /* by queue_push, on clock_us */
    /* By the queue, before `work`; NULL: a worker has it. Else it is on the express: if it is large after all,
     * queue_put_back, at the latest soon after this is raised. */
    const struct zr_cancel *overdue;
    /* Called on a worker. The queue does not touch the job any more, so `work` may
     * hand it to others. What it has in the arena is gone when it returns. */
    void (*work)(struct queue_job *job, struct zr_arena *arena);
};

struct queue_options {
    size_t workers;  /* the express not counted */
    size_t capacity; /* of each queue: jobs that wait, beside those that are worked on */
    size_t request_memory_bytes, keep_memory_bytes;
    uint64_t calm_ms;
};

/* NULL where threads or memory cannot be had. */
struct queue *queue_create(const struct queue_options *options);

/* False, and the job stays the caller's, where this queue is full. */
bool queue_push(struct queue *queue, struct queue_job *job, enum queue_lane lane);

/* From `work`, of a job that is on the express: it is large, and a worker shall take it. True: it is not
 * the caller's any more. False: the queue is full. */
bool queue_put_back(struct queue *queue, struct queue_job *job);

/* True: the job was still waiting and is the caller's again. False: a worker has it, or had it. */
bool queue_remove(struct queue *queue, struct queue_job *job);

/* It takes no more, by number or by time, once `coming` others have been pushed. */
bool queue_is_full(struct queue *queue, enum queue_lane lane, size_t coming);

/* Seconds until a job that came now might be begun, 1..60, from how long the last ones took. */
unsigned queue_wait_estimate_s(struct queue *queue, enum queue_lane lane);

/* Works off what waits and ends the threads. From then on the queue takes nothing, but
 * may still be asked. */
void queue_stop(struct queue *queue);

/* Stops it, where that is still to be done, and frees it. */
void queue_destroy(struct queue *queue);

#endif
