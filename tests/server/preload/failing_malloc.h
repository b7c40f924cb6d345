/* failing_malloc.h - the page that a test and its daemon share: which allocations of the daemon fail. */
#ifndef TEST_FAILING_MALLOC_H
#define TEST_FAILING_MALLOC_H

#include <stdatomic.h>
#include <stdbool.h>

struct failing_malloc {
    atomic_uint first; /* the number of the first that fails; 0: none does, and none is counted */
    atomic_uint every; /* and each so many behind it; 0: that one alone */
    atomic_uint count, failed;
};

#endif
