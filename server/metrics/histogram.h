/* histogram.h - a histogram with fixed bounds. Not thread-safe. */
#ifndef ZRASTERD_HISTOGRAM_H
#define ZRASTERD_HISTOGRAM_H

#include <stddef.h>
#include <stdint.h>

enum { HISTOGRAM_BOUNDS_MAX = 16 };

/* Upper bounds of the buckets, increasing; the last bucket has none. */
struct histogram_bounds {
    size_t count;
    double values[HISTOGRAM_BOUNDS_MAX];
};

/* Seconds from 1 ms to 30 s; bytes from 1 KiB to 256 MiB. */
extern const struct histogram_bounds histogram_seconds, histogram_bytes;

struct histogram {
    uint64_t buckets[HISTOGRAM_BOUNDS_MAX + 1]; /* not cumulative */
    double sum;
};

/* Counts a value: in the first bucket whose bound is not below it. */
void histogram_add(struct histogram *histogram, const struct histogram_bounds *bounds, double value);

/* Returns the number of values. */
uint64_t histogram_count(const struct histogram *histogram);

#endif
