#include "kept.h"

#include <malloc.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { CHAINS = 4096, BLOCK = 4096, NOTES = 1 << 14 };

struct kept {
    pthread_mutex_t lock;
    const struct kept_kind *kind;
    uint64_t max_bytes;
    struct kept_state state;
    struct kept_value *newest, *oldest; /* in the order of last use */
    struct kept_value *chains[CHAINS];
    _Atomic uint64_t notes[NOTES]; /* beginnings of hashes, in places that follow from them; inverted: too large */
};

/* A value that a request uses. */
struct kept_held {
    struct kept_value *value;
    struct kept_held *next;
};

const char *kept_word(enum kept_table table)
{
    static const char *const words[KEPT_TABLES] = {"images", "texts", "meshes", "answers"};
    return words[table];
}

struct kept *kept_open(const struct kept_kind *kind, uint64_t max_bytes)
{
    struct kept *kept = calloc(1, sizeof *kept);
    if (!kept) return NULL;
    kept->kind = kind;
    kept->max_bytes = max_bytes;
    pthread_mutex_init(&kept->lock, NULL);
    return kept;
}

/* ---- with the lock held ---- */

static struct kept_value **chain_of(struct kept *kept, const struct zr_file_hash *hash)
{
    return &kept->chains[(hash->bytes[0] | (size_t)hash->bytes[1] << 8) % CHAINS];
}

static struct kept_value *find_value(struct kept *kept, const struct zr_file_hash *hash)
{
    struct kept_value *value = *chain_of(kept, hash);
    while (value && memcmp(&value->hash, hash, sizeof *hash) != 0)
        value = value->next;
    return value;
}

static void unlink_use(struct kept *kept, struct kept_value *value)
{
    *(value->newer ? &value->newer->older : &kept->newest) = value->older;
    *(value->older ? &value->older->newer : &kept->oldest) = value->newer;
}

static void link_newest(struct kept *kept, struct kept_value *value)
{
    value->newer = NULL;
    value->older = kept->newest;
    *(kept->newest ? &kept->newest->newer : &kept->oldest) = value;
    kept->newest = value;
}

static void list_value(struct kept *kept, struct kept_value *value)
{
    struct kept_value **chain = chain_of(kept, &value->hash);
    value->next = *chain;
    value->is_listed = true;
    *chain = value;
    link_newest(kept, value);
    kept->state.count++;
    kept->state.bytes += value->bytes;
}

/* Moves a value to the list of removed ones. */
static void remove_value(struct kept *kept, struct kept_value *value, struct kept_value **removed)
{
    struct kept_value **link = chain_of(kept, &value->hash);
    while (*link != value)
        link = &(*link)->next;
    *link = value->next;
    unlink_use(kept, value);
    kept->state.count--;
    kept->state.bytes -= value->bytes;
    value->next = *removed;
    *removed = value;
}

/* Removes the least recently used values without users, until no more than `bytes` are kept. */
static void remove_down_to(struct kept *kept, uint64_t bytes, struct kept_value **removed)
{
    for (struct kept_value *value = kept->oldest, *newer; value && kept->state.bytes > bytes; value = newer) {
        newer = value->newer;
        if (value->users > 0) continue;
        remove_value(kept, value, removed);
        kept->state.dropped++;
    }
}

/* ---- all values ---- */

static void free_value(const struct kept *kept, struct kept_value *value)
{
    if (kept->kind->free)
        kept->kind->free(value);
    else
        free(value);
}

/* Frees removed values, without the lock: large ones take a while, for which nobody waits. */
static void free_removed(const struct kept *kept, struct kept_value *removed)
{
    for (struct kept_value *next; removed; removed = next) {
        next = removed->next;
        free_value(kept, removed);
    }
}

bool kept_drop(struct kept *kept)
{
    struct kept_value *removed = NULL;
    pthread_mutex_lock(&kept->lock);
    remove_down_to(kept, 0, &removed);
    pthread_mutex_unlock(&kept->lock);
    if (!removed) return false;
    free_removed(kept, removed);
    malloc_trim(0);
    return true;
}

void kept_close(struct kept *kept)
{
    if (!kept) return;
    kept_drop(kept);
    pthread_mutex_destroy(&kept->lock);
    free(kept);
}

struct kept_state kept_look(struct kept *kept)
{
    if (!kept) return (struct kept_state){0};
    pthread_mutex_lock(&kept->lock);
    const struct kept_state state = kept->state;
    pthread_mutex_unlock(&kept->lock);
    return state;
}

uint64_t kept_max_bytes(const struct kept *kept)
{
    return kept->max_bytes;
}

/* ---- notes ---- */

static uint64_t beginning_of(const struct zr_file_hash *hash)
{
    uint64_t beginning;
    memcpy(&beginning, hash->bytes, sizeof beginning);
    return beginning;
}

bool kept_is_noted(const struct kept *kept, const struct zr_file_hash *hash)
{
    const uint64_t beginning = beginning_of(hash);
    return atomic_load_explicit(&kept->notes[beginning % NOTES], memory_order_relaxed) == beginning;
}

bool kept_note(struct kept *kept, const struct zr_file_hash *hash)
{
    const uint64_t beginning = beginning_of(hash);
    _Atomic uint64_t *note = &kept->notes[beginning % NOTES];
    const uint64_t before = atomic_load_explicit(note, memory_order_relaxed);
    if (before != ~beginning) atomic_store_explicit(note, beginning, memory_order_relaxed);
    return before == beginning;
}

void kept_note_large(struct kept *kept, const struct zr_file_hash *hash)
{
    const uint64_t beginning = beginning_of(hash);
    atomic_store_explicit(&kept->notes[beginning % NOTES], ~beginning, memory_order_relaxed);
}

/* ---- values of one request ---- */

struct kept_value *kept_find(struct kept *kept, const struct zr_file_hash *hash, struct kept_held **held, void *out)
{
    struct kept_held *one = malloc(sizeof *one);
    pthread_mutex_lock(&kept->lock);
    struct kept_value *value = one ? find_value(kept, hash) : NULL;
    if (value) {
        value->users++;
        unlink_use(kept, value);
        link_newest(kept, value);
        if (kept->kind->take) kept->kind->take(value, out);
        kept->state.hits++;
    }
    pthread_mutex_unlock(&kept->lock);
    if (!value) {
        free(one);
        return NULL;
    }
    *one = (struct kept_held){value, *held};
    *held = one;
    return value;
}

void kept_miss(struct kept *kept)
{
    pthread_mutex_lock(&kept->lock);
    kept->state.misses++;
    pthread_mutex_unlock(&kept->lock);
}

bool kept_add(struct kept *kept, struct kept_value *value, struct kept_held **held)
{
    struct kept_held *one = held ? malloc(sizeof *one) : NULL;
    const uint64_t bytes = (value->bytes + BLOCK - 1) / BLOCK * BLOCK;
    struct kept_value *removed = NULL;
    bool stays = false;
    pthread_mutex_lock(&kept->lock);
    struct kept_value *there = find_value(kept, &value->hash);
    value->bytes = bytes;
    if (!there && bytes <= kept->max_bytes) remove_down_to(kept, kept->max_bytes - bytes, &removed);
    if (there) {
        if (kept->kind->join) kept->kind->join(there, value);
    } else if (bytes <= kept->max_bytes && kept->state.bytes <= kept->max_bytes - bytes && (one || !held)) {
        list_value(kept, value);
        stays = true;
    }
    if (one) {
        value->users = 1;
        *one = (struct kept_held){value, *held};
        *held = one;
        stays = true;
    }
    pthread_mutex_unlock(&kept->lock);
    free_removed(kept, removed);
    if (!stays) free_value(kept, value);
    return one || !held;
}

void kept_release(struct kept *kept, struct kept_held **held)
{
    if (!*held) return;
    pthread_mutex_lock(&kept->lock);
    for (struct kept_held *one = *held; one; one = one->next) {
        one->value->users--;
        if (one->value->is_listed) one->value = NULL; /* another thread may free it from now on */
    }
    pthread_mutex_unlock(&kept->lock);
    while (*held) {
        struct kept_held *next = (*held)->next;
        if ((*held)->value) free_value(kept, (*held)->value);
        free(*held);
        *held = next;
    }
}
