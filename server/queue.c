#include "queue.h"

#include <malloc.h>
#include <pthread.h>
#include <stdlib.h>

#include "clock.h"

/* LARGE_BYTES: a request that used as much leaves memory worth giving back. */
enum { STACK_BYTES = 1 << 20, LARGE_BYTES = 8 << 20 };

struct queue {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    struct queue_options options;
    struct queue_job *first;
    size_t waiting, running;
    double work_us; /* moving average over the last jobs */
    bool stopping;
    size_t worker_count;
    pthread_t workers[];
};

/* With the lock held. NULL once the queue stops and nothing waits. */
static struct queue_job *take_job(struct queue *queue)
{
    while (!queue->first && !queue->stopping)
        pthread_cond_wait(&queue->changed, &queue->lock);
    struct queue_job *job = queue->first;
    if (job) {
        queue->first = job->next;
        queue->waiting--;
        queue->running++;
    }
    return job;
}

static void *work(void *argument)
{
    struct queue *queue = argument;
    struct zr_arena arena;
    zr_arena_init(&arena, queue->options.request_memory_bytes);
    pthread_mutex_lock(&queue->lock);
    for (struct queue_job *job; (job = take_job(queue));) {
        pthread_mutex_unlock(&queue->lock);
        int64_t began = clock_us();
        job->work(job, &arena);
        double took = (double)(clock_us() - began);
        bool was_large = arena.used > LARGE_BYTES;
        zr_arena_reset(&arena, queue->options.keep_memory_bytes);
        /* cJSON's trees lie in malloc's heap, which keeps what is freed below its end. */
        if (was_large) malloc_trim(0);
        pthread_mutex_lock(&queue->lock);
        queue->running--;
        queue->work_us += (took - queue->work_us) / 8;
    }
    pthread_mutex_unlock(&queue->lock);
    zr_arena_free(&arena);
    return NULL;
}

struct queue *queue_create(const struct queue_options *options)
{
    struct queue *queue = calloc(1, sizeof *queue + options->workers * sizeof(pthread_t));
    if (!queue) return NULL;
    queue->options = *options;
    pthread_mutex_init(&queue->lock, NULL);
    pthread_cond_init(&queue->changed, NULL);
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK_BYTES);
    int failure = 0;
    while (queue->worker_count < options->workers && !failure) {
        failure = pthread_create(&queue->workers[queue->worker_count], &attributes, work, queue);
        if (!failure) queue->worker_count++;
    }
    pthread_attr_destroy(&attributes);
    if (failure) {
        queue_destroy(queue);
        return NULL;
    }
    return queue;
}

bool queue_push(struct queue *queue, struct queue_job *job)
{
    pthread_mutex_lock(&queue->lock);
    bool room = !queue->stopping && queue->waiting < queue->options.capacity;
    if (room) {
        job->next = NULL;
        job->pushed_us = clock_us();
        struct queue_job **link = &queue->first;
        while (*link)
            link = &(*link)->next;
        *link = job;
        queue->waiting++;
        pthread_cond_signal(&queue->changed);
    }
    pthread_mutex_unlock(&queue->lock);
    return room;
}

bool queue_remove(struct queue *queue, struct queue_job *job)
{
    pthread_mutex_lock(&queue->lock);
    struct queue_job **link = &queue->first;
    while (*link && *link != job)
        link = &(*link)->next;
    bool found = *link != NULL;
    if (found) {
        *link = job->next;
        queue->waiting--;
    }
    pthread_mutex_unlock(&queue->lock);
    return found;
}

bool queue_is_full(struct queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    bool full = queue->waiting >= queue->options.capacity;
    pthread_mutex_unlock(&queue->lock);
    return full;
}

unsigned queue_wait_estimate_s(struct queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    double jobs = (double)(queue->waiting + queue->running);
    double seconds = jobs * queue->work_us / (double)queue->options.workers / 1e6;
    pthread_mutex_unlock(&queue->lock);
    return seconds >= 59 ? 60 : 1 + (unsigned)seconds;
}

void queue_stop(struct queue *queue)
{
    pthread_mutex_lock(&queue->lock);
    queue->stopping = true;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
    for (size_t i = 0; i < queue->worker_count; i++)
        pthread_join(queue->workers[i], NULL);
    queue->worker_count = 0;
}

void queue_destroy(struct queue *queue)
{
    if (!queue) return;
    queue_stop(queue);
    pthread_cond_destroy(&queue->changed);
    pthread_mutex_destroy(&queue->lock);
    free(queue);
}
