#include "store_index.h"

#include <search.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* A name alone can be searched for, since it is the first member of an entry. */
_Static_assert(offsetof(struct store_entry, name) == 0, "compared as texts");

static int compare_names(const void *a, const void *b)
{
    return strcmp(a, b);
}

void store_index_init(struct store_index *index)
{
    *index = (struct store_index){0};
    TAILQ_INIT(&index->by_use);
}

void store_index_free(struct store_index *index)
{
    for (struct store_entry *entry; (entry = store_index_oldest(index));)
        store_index_remove(index, entry);
}

struct store_entry *store_index_find(const struct store_index *index, const char *name)
{
    void *const *found = tfind(name, &index->by_name, compare_names);
    return found ? *found : NULL;
}

bool store_index_add(struct store_index *index, const char *name, uint64_t bytes, struct timespec used)
{
    struct store_entry *entry = calloc(1, sizeof *entry);
    if (!entry) return false;
    strncpy(entry->name, name, STORE_NAME_SIZE - 1);
    entry->bytes = bytes;
    entry->used = used;
    if (!tsearch(entry, &index->by_name, compare_names)) {
        free(entry);
        return false;
    }
    TAILQ_INSERT_TAIL(&index->by_use, entry, by_use);
    index->bytes += bytes;
    return true;
}

void store_index_touch(struct store_index *index, struct store_entry *entry, struct timespec used)
{
    entry->used = used;
    TAILQ_REMOVE(&index->by_use, entry, by_use);
    TAILQ_INSERT_TAIL(&index->by_use, entry, by_use);
}

void store_index_remove(struct store_index *index, struct store_entry *entry)
{
    tdelete(entry, &index->by_name, compare_names);
    TAILQ_REMOVE(&index->by_use, entry, by_use);
    index->bytes -= entry->bytes;
    free(entry);
}

struct store_entry *store_index_oldest(const struct store_index *index)
{
    return TAILQ_FIRST(&index->by_use);
}
