/* texts.h - long data: URIs, decoded, kept between requests (kept.h, core/input/json/json_uris.h).
 *
 * A text is found by a hash of its size and some samples, and all of it is compared with a copy. One that differs from
 * the kept text of its hash has a next hash, made of the first difference. A text is kept when it is decoded for the
 * second time.
 * Thread: one struct texts_use belongs to one request.
 */
#ifndef ZRASTERD_TEXTS_H
#define ZRASTERD_TEXTS_H

#include <stdint.h>

#include "core.h"
#include "kept.h"

/* Keeps up to `max_bytes`, the copies of the texts included; 0: none. NULL without memory. Close it by kept_close. */
struct kept *texts_open(uint64_t max_bytes);

/* The texts of one request. `texts` may be NULL: none are kept. */
struct texts_use {
    struct kept *texts;
    struct kept_held *held;
    struct text_found *found;
};

/* Returns the functions for zr_request; `use` must outlive the scene. */
struct zr_kept_texts texts_lend(struct texts_use *use);

/* Computes the SHA-256 of bytes. That of the bytes of a kept text is computed once. `use` may be NULL. */
void texts_hash(const struct texts_use *use, const void *bytes, size_t size, struct zr_file_hash *hash);

/* Releases the texts once the scene is no longer used. */
void texts_release(struct texts_use *use);

#endif
