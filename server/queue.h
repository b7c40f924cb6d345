/* queue.h - a bounded queue and the threads that work it off.
 *
 * A job is a member of what it works for. It belongs to the queue from
 * queue_push until its `work` is called or queue_remove has given it back.
 */
#ifndef ZRASTERD_QUEUE_H
#define ZRASTERD_QUEUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"

struct queue;

struct queue_job {
    struct queue_job *next;
    int64_t pushed_us; /* by queue_push, on clock_us */
    /* Called on a worker. The queue does not touch the job any more, so `work` may
     * hand it to others. What it has in the arena is gone when it returns. */
    void (*work)(struct queue_job *job, struct zr_arena *arena);
};

struct queue_options {
    size_t workers;
    size_t capacity; /* jobs that wait, beside those that are worked on */
    size_t request_memory_bytes, keep_memory_bytes;
};

/* NULL where threads or memory cannot be had. */
struct queue *queue_create(const struct queue_options *options);

/* False, and the job stays the caller's, where the queue is full. */
bool queue_push(struct queue *queue, struct queue_job *job);

/* True: the job was still waiting and is the caller's again. False: a worker has it, or had it. */
bool queue_remove(struct queue *queue, struct queue_job *job);

bool queue_is_full(struct queue *queue);

/* Seconds until a job that came now might be begun, 1..60, from how long the last ones took. */
unsigned queue_wait_estimate_s(struct queue *queue);

/* Works off what waits and ends the threads. From then on the queue takes nothing, but
 * may still be asked. */
void queue_stop(struct queue *queue);

/* Stops it, where that is still to be done, and frees it. */
void queue_destroy(struct queue *queue);

#endif
