/* parts.h - input: cuts bytes into parts and reads them on all threads, up to the first part that fails.
 *
 * Why: faults are reported in the order of the bytes, and few files have any. So each part is read without reports.
 *      From the first part with a fault on, a single thread reads again and reports.
 */
#ifndef ZR_PARTS_H
#define ZR_PARTS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "core.h"

struct zr_part {
    const char *at, *end;
};

/* Returns the end of a part that begins at `at`: the end of a whole item at least `size` bytes further, or `end`. */
typedef const char *zr_cut_fn(const char *at, size_t size, const char *end);

/* Cuts bytes..end into parts, *count of them. NULL if memory runs out. */
struct zr_part *zr_parts_cut(struct zr_arena *arena, const char *bytes, const char *end, size_t part_size,
                             zr_cut_fn *cut, size_t *count);

/* Reads a part; false if one thread must read it again. Called for several parts at once. */
typedef bool zr_part_fn(void *context, size_t part);

/* Reads the parts first..count - 1. Returns the number of the first that failed, or `count`. All parts before it were
 * read; those after it may have been. `team` may be NULL, and so may `cancel`, which is polled before each part. */
size_t zr_parts_read(struct zr_team *team, const struct zr_cancel *cancel, size_t first, size_t count, zr_part_fn *read,
                     void *context);

#endif
