#include "input/text/parts.h"

#include <stdatomic.h>

#include "base/team.h"

struct zr_part *zr_parts_cut(struct zr_arena *arena, const char *bytes, const char *end, size_t part_size,
                             zr_cut_fn *cut, size_t *count)
{
    struct zr_part *parts = zr_arena_alloc(arena, (size_t)(end - bytes) / part_size + 1, sizeof *parts);
    *count = 0;
    for (const char *at = bytes; parts && at < end; at = parts[(*count)++].end)
        parts[*count] = (struct zr_part){at, (size_t)(end - at) > part_size ? cut(at, part_size, end) : end};
    return parts;
}

struct reading {
    const struct zr_cancel *cancel;
    size_t first;
    zr_part_fn *read;
    void *context;
    atomic_size_t failed; /* smallest number of a failed part; initially the count */
};

static void lower_to(atomic_size_t *least, size_t value)
{
    size_t old = atomic_load_explicit(least, memory_order_relaxed);
    while (value < old &&
           !atomic_compare_exchange_weak_explicit(least, &old, value, memory_order_relaxed, memory_order_relaxed))
        ;
}

static void read_range(void *context, size_t begin, size_t end)
{
    struct reading *reading = context;
    for (size_t part = reading->first + begin; part < reading->first + end; part++) {
        if (part > atomic_load_explicit(&reading->failed, memory_order_relaxed)) return;
        if (zr_is_cancelled(reading->cancel) || !reading->read(reading->context, part))
            lower_to(&reading->failed, part);
    }
}

size_t zr_parts_read(struct zr_team *team, const struct zr_cancel *cancel, size_t first, size_t count, zr_part_fn *read,
                     void *context)
{
    struct reading reading = {cancel, first, read, context, count};
    zr_team_ranges(team, count - first, 1, read_range, &reading);
    return reading.failed;
}
