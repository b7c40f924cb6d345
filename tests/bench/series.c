#include "bench/series.h"

#include <stdlib.h>
#include <time.h>

#include "bench/turns.h"

/* The warm-up also fills the cache of shaders that Mesa keeps on disk. */
enum { WARM_UP = 2 };
enum { ROUNDS_MIN = 9, ROUNDS_IF_SLOW = 7, SLOW_MS = 200, ROUNDS_MAX = 201, BUDGET_MS = 500 };

double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

void series_add(struct series *series, double ms)
{
    if (series->count < SERIES_MAX) series->ms[series->count++] = ms;
}

static int by_value(const void *a, const void *b)
{
    double d = *(const double *)a - *(const double *)b;
    return (d > 0) - (d < 0);
}

double series_percentile(const struct series *series, int percent)
{
    struct series sorted = *series;
    if (sorted.count == 0) return 0.0;
    qsort(sorted.ms, (size_t)sorted.count, sizeof *sorted.ms, by_value);
    return sorted.ms[(sorted.count * percent - 1) / 100];
}

double series_median(const struct series *series)
{
    return series_percentile(series, 50);
}

static int rounds_of(int asked, double round_ms)
{
    if (asked > 0) return asked < SERIES_MAX ? asked : SERIES_MAX;
    double fit = BUDGET_MS / (round_ms > 0.01 ? round_ms : 0.01);
    int least = round_ms > SLOW_MS ? ROUNDS_IF_SLOW : ROUNDS_MIN;
    int rounds = fit < least ? least : fit > ROUNDS_MAX ? ROUNDS_MAX : (int)fit;
    return rounds | 1;
}

bool series_run(struct series *series, int count, int asked, bool (*round)(void *context, struct series *series),
                void *context)
{
    double round_ms = 0;
    for (int i = 0; i < WARM_UP; i++) {
        double begin = now_ms();
        if (!round(context, series)) return false;
        round_ms = now_ms() - begin;
    }
    for (int i = 0; i < count; i++)
        series[i].count = 0;
    for (int rounds = rounds_of(asked, round_ms); rounds > 0; rounds--) {
        if (!round(context, series)) return false;
        turns_pass();
    }
    return true;
}
