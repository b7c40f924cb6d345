/* arena.h - base: all memory of one request, given back in one step.
 *
 * Invariant: what a request holds never exceeds `ceiling` by more than what is free in one block. What it holds is what
 * was allocated, and what is left at the ends of blocks, but for the block in which the next allocation may be. It
 * does not depend on earlier requests. Once an allocation has failed, every later one fails too, so a stage may check
 * zr_arena_ok once, at its end.
 *
 * Blocks survive zr_arena_reset: a worker that keeps its arena pays for first-touch page faults once. They go back to
 * the system where the next request needs the room for others. Small allocations share blocks of ZR_ARENA_BLOCK; a
 * larger one has a block of its own, at whose end there is up to an eighth of it. All are in pages of ZR_ARENA_BLOCK
 * where the system has them, but for what a block has behind its last whole one.
 * Not thread-safe: one arena belongs to one thread at a time.
 */
#ifndef ZR_ARENA_H
#define ZR_ARENA_H

#include <stdbool.h>
#include <stddef.h>

enum { ZR_ARENA_ALIGN = 64, ZR_ARENA_BLOCK = 2 << 20 };

struct zr_arena_block;
struct zr_cancel;

struct zr_arena {
    size_t ceiling; /* bytes that one request may allocate */
    size_t used;    /* bytes allocated since the last reset, padding and charges included */
    size_t held;    /* these, and what is free in blocks, but for the current one */
    size_t peak;    /* the most that `used` has been since then */
    bool failed;
    size_t wanted; /* what `held` would have been, where the first failure was the ceiling's; SIZE_MAX: more than can be
                      counted; 0: it was the system that had no more */
    bool is_within;                        /* bytes of somebody else's */
    const struct zr_cancel *cancel;        /* of the step under way, for who has no more than its arena; NULL: never */
    struct zr_arena_block *first, *spares; /* those with allocations, and those that a reset kept */
    struct zr_arena_block *current;        /* with the newest allocation */
    size_t spare_bytes;
    struct zr_arena *lender; /* of a scratch arena: the one that it is beside */
};

void zr_arena_init(struct zr_arena *arena, size_t ceiling);
void zr_arena_free(struct zr_arena *arena);

/* An arena in `size` bytes that somebody else has, aligned to ZR_ARENA_ALIGN: it takes no others, and needs no
 * zr_arena_free. */
void zr_arena_init_within(struct zr_arena *arena, void *bytes, size_t size);

/* Bytes that may still be allocated, charged, or be what a scratch arena has. */
static inline size_t zr_arena_left(const struct zr_arena *arena)
{
    return arena->ceiling - arena->held;
}

/* What an array of that many bytes adds to `held` of an arena, where it has a block of its own. */
size_t zr_arena_block_bytes(size_t bytes);

/* Empties the arena, clears a failure and what was wanted, and gives blocks beyond `keep` bytes back
 * to the system. */
void zr_arena_reset(struct zr_arena *arena, size_t keep);

/* `count` objects of `size` bytes, aligned to ZR_ARENA_ALIGN, contents undefined.
 * NULL once the arena has failed, also when count * size overflows. A count of 0
 * gives a pointer that must not be read. */
void *zr_arena_alloc(struct zr_arena *arena, size_t count, size_t size);

/* The same of zeros. To touch large memory for the first time takes long: once `cancel` is raised, the arena fails. */
void *zr_arena_zero(struct zr_arena *arena, size_t count, size_t size);

/* Zeros in memory that was allocated before. False where `cancel` was raised meanwhile. */
bool zr_arena_clear(const struct zr_arena *arena, void *bytes, size_t size);

/* A larger array with the first `count` objects of `old` (which may be NULL).
 * In place where `old` was the newest allocation and its block has room. */
void *zr_arena_grow(struct zr_arena *arena, void *old, size_t count, size_t new_count, size_t size);

/* Gives back what an array of `count` objects has beyond the first `new_count`, where it was the newest allocation;
 * else nothing happens. */
void zr_arena_trim(struct zr_arena *arena, void *array, size_t count, size_t new_count, size_t size);

/* Counts `bytes` that a library holds elsewhere on the request's behalf, until they are
 * refunded or the arena is reset. False, and the arena has failed, where they do not fit. */
bool zr_arena_charge(struct zr_arena *arena, size_t bytes);
void zr_arena_refund(struct zr_arena *arena, size_t bytes);

/* An arena for what one step needs and the request does not keep, such as what a library works with: it may take what
 * `arena` has left. Meanwhile that is allocated from by zr_arena_alloc_beside alone, which leaves the scratch what it
 * has. To close it gives its memory back to the system; `arena` has its peak and its failure from then on. */
struct zr_arena zr_arena_open_scratch(struct zr_arena *arena);
void *zr_arena_alloc_beside(struct zr_arena *arena, struct zr_arena *scratch, size_t count, size_t size);
void zr_arena_close_scratch(struct zr_arena *scratch, struct zr_arena *arena);

bool zr_arena_ok(const struct zr_arena *arena);

#endif
