/* prefetch.h - base: prefetches of memory. Any address is allowed: a prefetch never faults.
 *
 * Why:    hardware prefetchers stop at the end of a page and do not follow lists of indices.
 */
#ifndef ZR_PREFETCH_H
#define ZR_PREFETCH_H

#include <stddef.h>
#include <stdint.h>

enum { ZR_CACHE_LINE = 64, ZR_PAGE = 4096 };

/* Prefetches for reading the `bytes` bytes from p + ahead on. */
static inline void zr_prefetch(const void *p, size_t ahead, size_t bytes)
{
    for (size_t at = 0; at < bytes; at += ZR_CACHE_LINE)
        __builtin_prefetch((const void *)((uintptr_t)p + ahead + at));
}

/* The same for writing. */
static inline void zr_prefetch_written(const void *p, size_t ahead, size_t bytes)
{
    for (size_t at = 0; at < bytes; at += ZR_CACHE_LINE)
        __builtin_prefetch((const void *)((uintptr_t)p + ahead + at), 1);
}

#endif
