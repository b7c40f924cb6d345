/* sizes.h - sizes of answers of addresses, by the hash of all that determines their bytes, for Content-Length of
 * answers to HEAD and of 304. A small table: newer sizes displace older ones. Thread-safe.
 */
#ifndef ZRASTERD_SIZES_H
#define ZRASTERD_SIZES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/hash.h"

struct sizes;

/* NULL without memory. */
struct sizes *sizes_open(void);
void sizes_close(struct sizes *sizes);

/* Notes the size, and whether the look has no version that may change. `sizes` may be NULL. */
void sizes_note(struct sizes *sizes, const struct zr_file_hash *key, size_t size, bool is_pinned);

/* False: it is not known. `sizes` may be NULL. */
bool sizes_find(struct sizes *sizes, const struct zr_file_hash *key, size_t *size, bool *is_pinned);

#endif
