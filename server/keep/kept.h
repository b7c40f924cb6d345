/* kept.h - values kept between requests under the SHA-256 of what they were made of.
 *
 * Safe:   a client cannot change the value of another client's file. It can only displace values, which are then made
 *         again. Answers are the same with and without kept values.
 * Notes:  hashes of earlier requests, in a table of fixed size; later hashes may replace them. A value is kept at its
 *         second request: single requests displace nothing.
 * Bounds: the bytes of all values, in blocks of 4096. The least recently used ones make room for new ones. A value that
 *         a request uses stays, and its bytes count, until that request has ended.
 * Thread: struct kept is thread-safe. One list of held values belongs to one request.
 */
#ifndef ZRASTERD_KEPT_H
#define ZRASTERD_KEPT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/hash.h"

struct kept;
struct kept_held;

/* The beginning of a value. The caller sets the first two members. */
struct kept_value {
    struct zr_file_hash hash;
    uint64_t bytes;          /* all of them; kept_add rounds up to whole blocks */
    size_t users;            /* number of requests that use it */
    bool is_listed;          /* false: only its users have it */
    struct kept_value *next; /* next value of the chain */
    struct kept_value *newer, *older;
};

/* Kinds of values; `lock` is held while the first two functions run. NULL: nothing is done; of `free`: free(). */
struct kept_kind {
    void (*take)(const struct kept_value *value, void *out);                /* copies what kept_find returns */
    void (*join)(struct kept_value *there, const struct kept_value *other); /* two values were made of one file */
    void (*free)(struct kept_value *value);
};

/* The tables of the daemon. */
enum kept_table { KEPT_IMAGES, KEPT_TEXTS, KEPT_MESHES, KEPT_ANSWERS, KEPT_TABLES };

/* Returns the table's name in metrics and in the answer of /healthz. */
const char *kept_word(enum kept_table table);

/* Keeps up to `max_bytes`; 0: none. NULL without memory. */
struct kept *kept_open(const struct kept_kind *kind, uint64_t max_bytes);

/* Frees all values, which no request may use any more. NULL does nothing. */
void kept_close(struct kept *kept);

/* Drops all values that no request uses, and returns their memory to the system. False if there are none. */
bool kept_drop(struct kept *kept);

struct kept_state {
    uint64_t count, bytes;          /* kept now */
    uint64_t hits, misses, dropped; /* since the start: found, made, and displaced by others */
};

/* Returns the counts; 0 if `kept` is NULL. */
struct kept_state kept_look(struct kept *kept);
uint64_t kept_max_bytes(const struct kept *kept);

/* Finds a value and adds it to *held. `out` is for kind->take. NULL if there is none. */
struct kept_value *kept_find(struct kept *kept, const struct zr_file_hash *hash, struct kept_held **held, void *out);

/* Counts a value that is made, since there was none. */
void kept_miss(struct kept *kept);

/* Returns true if the hash is noted, and notes it. */
bool kept_note(struct kept *kept, const struct zr_file_hash *hash);
bool kept_is_noted(const struct kept *kept, const struct zr_file_hash *hash);

/* Notes that a value is too large: kept_note no longer notes its hash. */
void kept_note_large(struct kept *kept, const struct zr_file_hash *hash);

/* Takes over a value, and frees it if there is no room for it or another one of this hash. If `held` is not NULL, the
 * value is added to *held, and not freed before it is released. False without memory: it is freed at once. */
bool kept_add(struct kept *kept, struct kept_value *value, struct kept_held **held);

/* Releases the values of a request, and empties the list. */
void kept_release(struct kept *kept, struct kept_held **held);

#endif
