/* failing_malloc.h - support: selects allocations that fail, in memory that a test and its daemon share
 * (tests/server/preload). */
#ifndef TEST_FAILING_MALLOC_H
#define TEST_FAILING_MALLOC_H

#include <errno.h>
#include <stdatomic.h>
#include <stdbool.h>

struct failing_malloc {
    atomic_uint first; /* number of the first failing allocation, from 1; 0: none fails or is counted */
    atomic_uint every; /* period of later failures; 0: only the first fails */
    atomic_uint count, failed;
};

/* Counts an allocation and returns true if it fails. AddressSanitizer must not check this function: the dynamic linker
 * allocates before the sanitizer is ready. */
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

/* Restarts the counts, then selects the failures. */
static inline void failing_malloc_arm(struct failing_malloc *control, unsigned first, unsigned every)
{
    atomic_store(&control->count, 0);
    atomic_store(&control->failed, 0);
    atomic_store(&control->every, every);
    atomic_store(&control->first, first);
}

#endif
