/* answers.h - answers of addresses, kept between requests under the hash of all that determines their bytes (kept.h).
 *
 * An answer that is sent from here shares the kept bytes, which stay until all of its readers have them.
 * Thread: thread-safe.
 */
#ifndef ZRASTERD_ANSWERS_H
#define ZRASTERD_ANSWERS_H

#include <stdint.h>

#include "answer.h"
#include "kept.h"

/* Keeps up to `max_bytes`; 0: none. NULL without memory. Close it by kept_close. */
struct kept *answers_open(uint64_t max_bytes);

/* Completes an empty answer: status, headers and bytes. `is_pinned` is as given to answers_keep. False: none is kept.
 * `answers` may be NULL. */
bool answers_find(struct kept *answers, const struct zr_file_hash *key, struct answer *answer, bool *is_pinned);

/* Keeps a copy of an answer with bytes. `answers` may be NULL. */
void answers_keep(struct kept *answers, const struct zr_file_hash *key, const struct answer *answer, bool is_pinned);

/* Sizes of answers by the same hash, for Content-Length of answers to HEAD and of 304. A small table: newer sizes
 * displace older ones. Thread-safe. */
struct sizes;

/* NULL without memory. */
struct sizes *sizes_open(void);
void sizes_close(struct sizes *sizes);

/* Notes the size, and whether the version of the look is fixed. `sizes` may be NULL. */
void sizes_note(struct sizes *sizes, const struct zr_file_hash *key, size_t size, bool is_pinned);

/* Finds a noted size. False: there is none. `sizes` may be NULL. */
bool sizes_find(struct sizes *sizes, const struct zr_file_hash *key, size_t *size, bool *is_pinned);

#endif
