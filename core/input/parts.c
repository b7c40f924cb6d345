#include "input/parts.h"

#include <stdatomic.h>

#include "base/team.h"

struct parts {
    const struct zr_cancel *cancel;
    size_t first;
    zr_part_fn *read;
    void *context;
    atomic_size_t failed; /* the first so far */
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
    struct parts *parts = context;
    for (size_t part = parts->first + begin; part < parts->first + end; part++) {
        if (part > atomic_load_explicit(&parts->failed, memory_order_relaxed)) return;
        if (zr_is_cancelled(parts->cancel) || !parts->read(parts->context, part)) lower_to(&parts->failed, part);
    }
}

size_t zr_parts_read(struct zr_team *team, const struct zr_cancel *cancel, size_t first, size_t count, zr_part_fn *read,
                     void *context)
{
    struct parts parts = {cancel, first, read, context, count};
    zr_team_ranges(team, count - first, 1, read_range, &parts);
    return parts.failed;
}
