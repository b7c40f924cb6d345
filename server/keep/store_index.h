/* store_index.h - index of a store in memory: names, sizes and times of use.
 *
 * A balanced tree by name and a list by use. No I/O, no locks. Starts with store_index_init.
 */
#ifndef ZRASTERD_STORE_INDEX_H
#define ZRASTERD_STORE_INDEX_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/queue.h>
#include <time.h>

#include "store_file.h"

struct store_entry {
    char name[STORE_NAME_SIZE];
    uint64_t bytes; /* on disk */
    struct timespec used;
    TAILQ_ENTRY(store_entry) by_use;
};

struct store_index {
    void *by_name;                               /* tsearch's tree of entries */
    TAILQ_HEAD(store_order, store_entry) by_use; /* least recently used first */
    uint64_t bytes;                              /* of all entries */
};

void store_index_init(struct store_index *index);
void store_index_free(struct store_index *index);

/* Returns the entry of a name, or NULL. */
struct store_entry *store_index_find(const struct store_index *index, const char *name);

/* Adds an entry as the most recently used one; `name` must be new. False: out of memory. */
bool store_index_add(struct store_index *index, const char *name, uint64_t bytes, struct timespec used);

/* Makes an entry the most recently used one. */
void store_index_touch(struct store_index *index, struct store_entry *entry, struct timespec used);

void store_index_remove(struct store_index *index, struct store_entry *entry);

/* Returns the least recently used entry, or NULL. */
struct store_entry *store_index_oldest(const struct store_index *index);

#endif
