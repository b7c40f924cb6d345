#include "histogram.h"

const struct histogram_bounds histogram_seconds = {
    14, {0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0}};

const struct histogram_bounds histogram_bytes = {
    10, {1024, 4096, 16384, 65536, 262144, 1048576, 4194304, 16777216, 67108864, 268435456}};

void histogram_add(struct histogram *histogram, const struct histogram_bounds *bounds, double value)
{
    size_t bucket = 0;
    while (bucket < bounds->count && value > bounds->values[bucket])
        bucket++;
    histogram->buckets[bucket]++;
    histogram->sum += value;
}

uint64_t histogram_count(const struct histogram *histogram)
{
    uint64_t count = 0;
    for (size_t i = 0; i <= HISTOGRAM_BOUNDS_MAX; i++)
        count += histogram->buckets[i];
    return count;
}
