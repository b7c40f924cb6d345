/* parts.h - input: bytes in parts, which all threads read, up to the first that cannot be read so.
 *
 * Why: faults are told in the order of the bytes, and few files have any. So each part is read as if there were none,
 *      and where one has, a single thread reads on from there, and tells. */
#ifndef ZR_PARTS_H
#define ZR_PARTS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "zraster.h"

struct zr_part {
    const char *at, *end;
};

/* Where a part may end that begins at `at`: behind something whole, of `size` bytes or a little more, or at `end`. */
typedef const char *zr_cut_fn(const char *at, size_t size, const char *end);

/* The parts of bytes..end, *count of them; NULL where memory is used up. */
struct zr_part *zr_parts_cut(struct zr_arena *arena, const char *bytes, const char *end, size_t part_size,
                             zr_cut_fn *cut, size_t *count);

/* False where a part must be read again, by one thread. Called for several parts at once. */
typedef bool zr_part_fn(void *context, size_t part);

/* Parts from `first` to `count` - 1. Returns the first that was not read, or `count`: all parts before it were, of
 * those behind it nothing is known. `team` may be NULL, and so may `cancel`: it is looked at before each part. */
size_t zr_parts_read(struct zr_team *team, const struct zr_cancel *cancel, size_t first, size_t count, zr_part_fn *read,
                     void *context);

#endif
