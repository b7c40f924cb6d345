/* store.h - assets on disk, each under the SHA-256 of its bytes.
 *
 * One directory, flat, a file an asset. Files come whole: written under a temporary name,
 * synced and renamed; a crash leaves a temporary file at most, which the next start removes.
 * What they take is bounded, in whole blocks of 4096 bytes: where room is needed, those that were
 * not used for longest go. A file's time of modification is when it was used last, so the order
 * outlives the process. The hash is checked each time, and a broken file is removed. What a render reads is read, not
 * mapped: whatever happens to the file afterwards, the bytes stay. A file that is sent to a client stays, too, until it
 * has been sent, even where its name made room for others: it is counted no more.
 * Several daemons may share a directory: the files are the truth, what is known of them in
 * memory a hint, so each bounds what it knows of. Whatever else lies there is left alone.
 * Thread-safe.
 */
#ifndef ZRASTERD_STORE_H
#define ZRASTERD_STORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "store_name.h"

/* Names given to the functions below must be such (store_is_name). */
struct store;

/* NULL: `message` says why not. */
struct store *store_open(const char *directory, uint64_t max_bytes, char *message, size_t message_size);
void store_close(struct store *store);

enum store_status {
    STORE_NEW,
    STORE_THERE,
    STORE_MISSING,
    STORE_TOO_LARGE, /* for all of the store */
    STORE_DISK_FULL, /* these three: errno says more */
    STORE_READ_ONLY,
    STORE_FAILED,
    STORE_NO_MEMORY,
    STORE_CANCELLED
};

/* Keeps a copy of `bytes`, whose name it must be. Waits for the disk. */
enum store_status store_put(struct store *store, const char *name, const void *bytes, size_t size);

/* STORE_THERE, and the bytes lie in the arena, proven to be those of that name; or STORE_MISSING,
 * STORE_FAILED, or STORE_NO_MEMORY of the arena. */
enum store_status store_read(struct store *store, const char *name, struct zr_arena *arena, const void **bytes,
                             size_t *size);

/* STORE_THERE, and *fd is its file, whose *size bytes from the beginning have been proven to be those of that name; the
 * caller closes it. Or STORE_MISSING, STORE_FAILED, STORE_CANCELLED. Takes no memory. */
enum store_status store_fetch(struct store *store, const char *name, const struct zr_cancel *cancel, int *fd,
                              size_t *size);

/* A look at its file, not at its bytes. Counts as a use. STORE_THERE, STORE_MISSING or STORE_FAILED. */
enum store_status store_look(struct store *store, const char *name, size_t *size);

#endif
