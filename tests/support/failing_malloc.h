/* failing_malloc.h - support: which allocations fail. A test and its daemon share one such page (tests/server/preload).
 */
#ifndef TEST_FAILING_MALLOC_H
#define TEST_FAILING_MALLOC_H

#include <errno.h>
#include <stdatomic.h>
#include <stdbool.h>

struct failing_malloc {
    atomic_uint first; /* the number of the first that fails, from 1; 0: none does, and none is counted */
    atomic_uint every; /* and each so many behind it; 0: that one alone */
    atomic_uint count, failed;
};

/* Whether the allocation that is asked for now fails. The dynamic linker allocates before the address sanitizer is
 * ready, so this is not checked by it. */
__attribute__((no_sanitize("address"))) static inline bool failing_malloc_fails(struct failing_malloc *control)
{
    const unsigned first = atomic_load(&control->first), every = atomic_load(&control->every);
    if (first == 0) return false;
    const unsigned number = atomic_fetch_add(&control->count, 1) + 1;
    if (number < first || (number > first && (every == 0 || (number - first) % every != 0))) return false;
    atomic_fetch_add(&control->failed, 1);
    errno = ENOMEM;
    return true;
}

/* From now on, counted anew. */
static inline void failing_malloc_arm(struct failing_malloc *control, unsigned first, unsigned every)
{
    atomic_store(&control->count, 0);
    atomic_store(&control->failed, 0);
    atomic_store(&control->every, every);
    atomic_store(&control->first, first);
}

#endif
