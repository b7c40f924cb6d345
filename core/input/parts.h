/* parts.h - input: a text in parts, which all threads read, up to the first that cannot be read so.
 *
 * Why: faults are told in the order of the text, and few texts have any. So each part is read as if there were none,
 *      and where one has, a single thread reads on from there, and tells. */
#ifndef ZR_PARTS_H
#define ZR_PARTS_H

#include <stdbool.h>
#include <stddef.h>

#include "zraster.h"

/* False where a part must be read again, by one thread. Called for several parts at once. */
typedef bool zr_part_fn(void *context, size_t part);

/* Parts from `first` to `count` - 1. Returns the first that was not read, or `count`: all parts before it were, of
 * those behind it nothing is known. `team` may be NULL, and so may `cancel`; cancelled, it soon returns. */
size_t zr_parts_read(struct zr_team *team, const struct zr_cancel *cancel, size_t first, size_t count, zr_part_fn *read,
                     void *context);

#endif
