#include "bench/http/crowd.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "bench/bench.h"
#include "bench/series.h"

struct painter {
    struct crowd *crowd;
    struct ours ours;
    double begun_ms, ended_ms;
    bool ok;
};

/* The caller's thread is the first painter's. The others sleep at `called`; from there on they wait awake, since to be
 * woken takes a tenth of a small picture. */
struct crowd {
    pthread_barrier_t called;
    atomic_int awake, done;
    int painter_count;
    struct painter painters[];
};

static void wait_for(const struct crowd *crowd, const atomic_int *count)
{
    while (atomic_load(count) < crowd->painter_count)
        ;
}

/* Each tells when it began: nobody knows who has a processor when all are awake. */
static void paint(struct painter *painter)
{
    painter->begun_ms = now_ms();
    painter->ok = ours_draw(&painter->ours, false) != NULL;
    painter->ended_ms = now_ms();
    atomic_fetch_add(&painter->crowd->done, 1);
}

/* True when all are awake. */
static bool is_called(struct crowd *crowd)
{
    const int status = pthread_barrier_wait(&crowd->called);
    if (status != 0 && status != PTHREAD_BARRIER_SERIAL_THREAD) return false;
    atomic_fetch_add(&crowd->awake, 1);
    wait_for(crowd, &crowd->awake);
    return true;
}

static void *paint_when_called(void *argument)
{
    struct painter *painter = argument;
    while (is_called(painter->crowd))
        paint(painter);
    return NULL;
}

static bool start(struct crowd *crowd, int number)
{
    struct painter *painter = &crowd->painters[number];
    pthread_t thread;
    painter->crowd = crowd;
    return ours_open(&painter->ours, 1) &&
           (number == 0 || pthread_create(&thread, NULL, paint_when_called, painter) == 0);
}

struct crowd *crowd_open(int threads)
{
    struct crowd *crowd = calloc(1, sizeof *crowd + (size_t)threads * sizeof *crowd->painters);
    bool ok = crowd && pthread_barrier_init(&crowd->called, NULL, (unsigned)threads) == 0;
    for (int i = 0; ok && i < threads; i++) {
        crowd->painter_count = i + 1;
        ok = start(crowd, i);
    }
    if (!ok) bench_complain("%d pictures cannot be drawn at once: there is no thread or no memory", threads);
    return ok ? crowd : NULL;
}

void crowd_take(struct crowd *crowd, const struct work *work, const struct variant *variant)
{
    for (int i = 0; i < crowd->painter_count; i++)
        ours_take(&crowd->painters[i].ours, work, variant);
}

double crowd_draw(struct crowd *crowd)
{
    const struct painter *first = &crowd->painters[0];
    atomic_store(&crowd->done, 0);
    atomic_store(&crowd->awake, 1);
    pthread_barrier_wait(&crowd->called);
    wait_for(crowd, &crowd->awake);
    paint(&crowd->painters[0]);
    wait_for(crowd, &crowd->done);
    double begun_ms = first->begun_ms, ended_ms = first->ended_ms;
    bool ok = first->ok;
    for (const struct painter *p = first + 1; p < first + crowd->painter_count; p++) {
        if (p->begun_ms < begun_ms) begun_ms = p->begun_ms;
        if (p->ended_ms > ended_ms) ended_ms = p->ended_ms;
        ok &= p->ok;
    }
    return ok ? ended_ms - begun_ms : -1.0;
}
