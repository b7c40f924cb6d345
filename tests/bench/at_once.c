#include "bench/at_once.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "bench/series.h"

struct painter {
    struct at_once *at_once;
    struct ours ours;
    bool ok;
};

/* The caller's thread is the first painter's. The others sleep at `called`; from there on they wait awake, since to be
 * woken takes a tenth of a small picture. */
struct at_once {
    pthread_barrier_t called;
    atomic_int awake, done;
    int painter_count;
    struct painter painters[];
};

static void wait_for(const struct at_once *at_once, const atomic_int *count)
{
    while (atomic_load(count) < at_once->painter_count)
        ;
}

static void paint(struct painter *painter)
{
    painter->ok = ours_draw(&painter->ours, false) != NULL;
    atomic_fetch_add(&painter->at_once->done, 1);
}

static void *paint_when_called(void *argument)
{
    struct painter *painter = argument;
    struct at_once *at_once = painter->at_once;
    for (;;) {
        pthread_barrier_wait(&at_once->called);
        atomic_fetch_add(&at_once->awake, 1);
        wait_for(at_once, &at_once->awake);
        paint(painter);
    }
    return NULL;
}

struct at_once *at_once_open(int threads)
{
    struct at_once *at_once = calloc(1, sizeof *at_once + (size_t)threads * sizeof *at_once->painters);
    if (!at_once || pthread_barrier_init(&at_once->called, NULL, (unsigned)threads) != 0) return NULL;
    at_once->painter_count = threads;
    for (int i = 0; i < threads; i++) {
        struct painter *painter = &at_once->painters[i];
        pthread_t thread;
        painter->at_once = at_once;
        if (!ours_open(&painter->ours, 1)) return NULL;
        if (i > 0 && pthread_create(&thread, NULL, paint_when_called, painter) != 0) return NULL;
    }
    return at_once;
}

void at_once_take(struct at_once *at_once, const struct work *work, const struct variant *variant)
{
    for (int i = 0; i < at_once->painter_count; i++)
        ours_take(&at_once->painters[i].ours, work, variant);
}

double at_once_draw(struct at_once *at_once)
{
    bool ok = true;
    atomic_store(&at_once->done, 0);
    atomic_store(&at_once->awake, 1);
    pthread_barrier_wait(&at_once->called);
    wait_for(at_once, &at_once->awake);
    double begin = now_ms();
    paint(&at_once->painters[0]);
    wait_for(at_once, &at_once->done);
    double took_ms = now_ms() - begin;
    for (int i = 0; i < at_once->painter_count; i++)
        ok &= at_once->painters[i].ok;
    return ok ? took_ms : -1.0;
}
