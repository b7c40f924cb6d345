/* store.h - assets on disk, each under the SHA-256 of its bytes.
 *
 * Files: one flat directory, one file per asset. A file is written under a temporary name, synced and renamed. A crash
 * leaves at most a temporary file, which the next start removes. Other files in the directory are left alone.
 * Bounds: the total size, in blocks of 4096 bytes. The least recently used assets make room for new ones. The
 * modification time of a file is its last use, so the order survives a restart.
 * Reading: each read checks the hash and removes a broken file. Bytes for a render are read, not mapped, so later
 * changes of the file do not matter. A file that is being sent stays readable, even after its name was removed to make
 * room; its size no longer counts.
 * Several daemons may share a directory. The files decide, the index in memory is a hint, and each daemon bounds the
 * files that it knows. Thread-safe.
 */
#ifndef ZRASTERD_STORE_H
#define ZRASTERD_STORE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "store_file.h"

/* Names passed to the functions below must be valid (store_is_name). */
struct store;

/* Opens an existing directory. NULL: `message` has the reason. */
struct store *store_open(const char *directory, uint64_t max_bytes, char *message, size_t message_size);
void store_close(struct store *store);

enum store_status {
    STORE_NEW,
    STORE_THERE,
    STORE_MISSING,
    STORE_TOO_LARGE, /* larger than the whole store */
    STORE_DISK_FULL, /* these three: see errno */
    STORE_READ_ONLY,
    STORE_FAILED,
    STORE_NO_MEMORY,
    STORE_CANCELLED
};

/* Stores a copy of `bytes` under their name. Waits for the disk. */
enum store_status store_put(struct store *store, const char *name, const void *bytes, size_t size);

/* Reads an asset into the arena and checks its hash. STORE_THERE, STORE_MISSING, STORE_FAILED, or STORE_NO_MEMORY of
 * the arena. */
enum store_status store_read(struct store *store, const char *name, struct zr_arena *arena, const void **bytes,
                             size_t *size);

/* Opens an asset after a check of its hash. STORE_THERE: *fd is at the beginning of its *size bytes, and the caller
 * closes it. Otherwise STORE_MISSING, STORE_FAILED or STORE_CANCELLED. Takes no memory. */
enum store_status store_fetch(struct store *store, const char *name, const struct zr_cancel *cancel, int *fd,
                              size_t *size);

/* Returns the size of all assets, in blocks of 4096 bytes. */
uint64_t store_bytes(struct store *store);

/* Finds the size of an asset without reading it. Counts as a use. STORE_THERE, STORE_MISSING or STORE_FAILED. */
enum store_status store_look(struct store *store, const char *name, size_t *size);

#endif
