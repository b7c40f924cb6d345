/* prefetch.h - base: memory that is asked for before it is used. Any address may be: none is touched.
 *
 * Why:    processors look ahead by themselves, but no farther than to the end of a page, and not along lists.
 */
#ifndef ZR_PREFETCH_H
#define ZR_PREFETCH_H

#include <stddef.h>
#include <stdint.h>

enum { ZR_CACHE_LINE = 64, ZR_PAGE = 4096 };

/* Prefetches `bytes` bytes, which begin `ahead` bytes beyond p. */
static inline void zr_prefetch(const void *p, size_t ahead, size_t bytes)
{
    for (size_t at = 0; at < bytes; at += ZR_CACHE_LINE)
        __builtin_prefetch((const void *)((uintptr_t)p + ahead + at));
}

/* The same of what will be written. */
static inline void zr_prefetch_written(const void *p, size_t ahead, size_t bytes)
{
    for (size_t at = 0; at < bytes; at += ZR_CACHE_LINE)
        __builtin_prefetch((const void *)((uintptr_t)p + ahead + at), 1);
}

#endif
