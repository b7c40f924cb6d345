/* fragments.h - raster: all samples that see-through primitives cover in a tile or window, in one list a pixel, sorted
 * by depth.
 *
 * What cannot be decided by the z-buffer alone is kept here: which of them are seen, and through which, is for shading
 * to say. Eight bytes a fragment, however many lie over one another; of the places, four bytes each.
 * How:    the primitives are gone through twice: their fragments are counted, which tells where each list begins, and
 *         then put there.
 * Order:  nearest first; at equal depth the primitive that is earlier in the scene is in front.
 * Source: Carpenter, "The A-buffer, an Antialiased Hidden Surface Method", 1984.
 */
#ifndef ZR_FRAGMENTS_H
#define ZR_FRAGMENTS_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"

struct zr_fragments {
    uint32_t places;   /* pixels that have a list */
    uint32_t room;     /* of keys */
    uint32_t *ends;    /* where list i ends, and the next begins, at [i + 1]; until it is filled, where it goes on */
    uint64_t *keys;    /* a depth's bits over an owner: as numbers they are in the order of the list */
    bool is_filled_in; /* else fragments are counted */
};

static inline uint64_t zr_fragment_key(float depth, uint32_t owner)
{
    uint32_t bits; /* of no negative number, which are as great as it is */
    memcpy(&bits, &depth, sizeof bits);
    return (uint64_t)bits << 32 | owner;
}

static inline float zr_fragment_depth(uint64_t key)
{
    const uint32_t bits = (uint32_t)(key >> 32);
    float depth;
    memcpy(&depth, &bits, sizeof depth);
    return depth;
}

static inline uint32_t zr_fragment_owner(uint64_t key)
{
    return (uint32_t)key;
}

/* A list, nearest first. */
static inline const uint64_t *zr_fragments_of(const struct zr_fragments *fragments, uint32_t place, uint32_t *count)
{
    *count = fragments->ends[place + 1] - fragments->ends[place];
    return fragments->keys + fragments->ends[place];
}

/* Counts a fragment, or puts it where it belongs. */
static inline void zr_fragments_put(struct zr_fragments *fragments, uint32_t place, float depth, uint32_t owner)
{
    if (fragments->is_filled_in)
        fragments->keys[fragments->ends[place]++] = zr_fragment_key(depth, owner);
    else
        fragments->ends[place + 1]++;
}

/* In this order: begin, put all, fill in, put all again, sort.
 *
 * `lock`: of the arena, where threads share it; or NULL. zr_fragments_begin: room for as many places as *fragments had
 * before, or had none. False where there is no memory, where arena->cancel is raised, or are more fragments than can be
 * counted. Cancelled,
 * zr_fragments_sort leaves some lists unsorted. */
bool zr_fragments_begin(struct zr_arena *arena, pthread_mutex_t *lock, uint32_t places, struct zr_fragments *fragments);
bool zr_fragments_prefix_sum(struct zr_arena *arena, pthread_mutex_t *lock, struct zr_fragments *fragments);
void zr_fragments_sort(const struct zr_cancel *cancel, struct zr_fragments *fragments);

/* How many there are in all, once they are sorted. */
static inline uint32_t zr_fragments_count(const struct zr_fragments *fragments)
{
    return fragments->ends[fragments->places];
}

#endif
