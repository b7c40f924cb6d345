/* fragments.h - raster: lists of all fragments of transparent primitives in a tile or window, one list per pixel,
 * sorted by depth.
 *
 * A z-buffer alone cannot decide these fragments; the shading stage blends or masks them. A fragment takes eight bytes,
 * and a pixel four.
 * How:    the primitives are drawn twice: first their fragments are counted, which gives the start of each list, and
 *         then they are stored.
 * Order:  nearest first; at equal depth, the earlier primitive of the scene is in front.
 * Source: Carpenter, "The A-buffer, an Antialiased Hidden Surface Method", 1984. */
#ifndef ZR_FRAGMENTS_H
#define ZR_FRAGMENTS_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"

/* Receives the places of fragments instead of lists: a bit for each, in rows of 64. */
struct zr_fragment_marks {
    uint32_t begin, end; /* owners begin .. end - 1 have their bits in `rows`; others call `turn` first */
    uint64_t *rows;
    void (*turn)(struct zr_fragment_marks *marks, uint32_t owner); /* sets the members above for the owner */
    uint32_t stride;                                               /* places of a row; 64 of them have bits */
    float *depths;                                                 /* of the marked places, or NULL */
};

/* Marks up to 64 places of one row, from `first` on. */
static inline void zr_fragment_marks_put(struct zr_fragment_marks *marks, uint32_t first, uint64_t bits, uint32_t owner)
{
    if (owner < marks->begin || owner >= marks->end) marks->turn(marks, owner);
    marks->rows[first / marks->stride] |= bits << first % marks->stride;
}

struct zr_fragments {
    uint32_t places; /* number of pixels, each with a list */
    uint32_t room;   /* capacity of keys */
    uint32_t *ends;  /* ends[i + 1]: end of list i and start of the next; during the second pass, ends[i] is the next
                      * free key of list i */
    uint64_t *keys;  /* depth bits over owner id: their numeric order is that of the list */
    struct zr_fragment_marks *marks; /* or NULL; if set, nothing else is used */
    bool is_filled_in;               /* second pass: fragments are stored, not counted */
};

static inline uint64_t zr_fragment_key(float depth, uint32_t owner)
{
    uint32_t bits; /* bits of non-negative floats have the order of the floats */
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

/* Returns a list, nearest first, and its length in *count. */
static inline const uint64_t *zr_fragments_of(const struct zr_fragments *fragments, uint32_t place, uint32_t *count)
{
    *count = fragments->ends[place + 1] - fragments->ends[place];
    return fragments->keys + fragments->ends[place];
}

/* Counts a fragment, stores it in its list, or marks its place. */
static inline void zr_fragments_put(struct zr_fragments *fragments, uint32_t place, float depth, uint32_t owner)
{
    if (fragments->marks) {
        zr_fragment_marks_put(fragments->marks, place, 1, owner);
        if (fragments->marks->depths) fragments->marks->depths[place] = depth;
    } else if (fragments->is_filled_in)
        fragments->keys[fragments->ends[place]++] = zr_fragment_key(depth, owner);
    else
        fragments->ends[place + 1]++;
}

/* Call in this order: zr_fragments_begin, put all, zr_fragments_prefix_sum, put all again, zr_fragments_sort.
 * `places`: the number of lists, the same in each use of *fragments. `lock`: guards an arena that threads share; else
 * NULL. False if memory runs out, if arena->cancel is raised, or if the fragments are too many to be counted. If
 * cancelled, zr_fragments_sort leaves some lists unsorted. */
bool zr_fragments_begin(struct zr_arena *arena, pthread_mutex_t *lock, uint32_t places, struct zr_fragments *fragments);
bool zr_fragments_prefix_sum(struct zr_arena *arena, pthread_mutex_t *lock, struct zr_fragments *fragments);
void zr_fragments_sort(const struct zr_cancel *cancel, struct zr_fragments *fragments);

/* Sorts keys in increasing order. */
void zr_fragment_keys_sort(uint64_t *keys, uint32_t count);

/* Returns the total number of fragments, after sorting. */
static inline uint32_t zr_fragments_count(const struct zr_fragments *fragments)
{
    return fragments->ends[fragments->places];
}

#endif
