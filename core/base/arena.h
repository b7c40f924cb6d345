/* arena.h - base: all memory of one request, freed in one step.
 *
 * Invariant: the memory of a request never exceeds `ceiling` by more than the free part of one block. `held` counts
 * allocations and the free ends of blocks, except for the current block's. It does not depend on earlier requests. Once
 * an allocation has failed, all later ones fail too, so a stage may check zr_arena_ok once, at its end.
 *
 * Blocks survive zr_arena_reset: a worker that keeps its arena pays for first-touch page faults once. They are freed if
 * a request needs new blocks that would not fit beside them. Small allocations share blocks of ZR_ARENA_BLOCK. A larger
 * one gets a block of its own, a multiple of that or a little more, whose rest later ones share. Blocks are in huge
 * pages if the system has them, except for the rest behind the last whole one.
 *
 * Not thread-safe: one arena belongs to one thread at a time. */
#ifndef ZR_ARENA_H
#define ZR_ARENA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ZR_ARENA_ALIGN = 64, ZR_ARENA_BLOCK = 2 << 20 };

struct zr_arena_block;
struct zr_cancel;

struct zr_arena {
    size_t ceiling; /* bytes that one request may hold */
    size_t whole;   /* for the arena of a view beside others: ceiling of its request, for messages; 0: `ceiling` */
    size_t used;    /* bytes allocated since the last reset, including padding and charges */
    size_t held;    /* `used`, plus the free bytes of all blocks except the current one */
    size_t peak;    /* maximum of `used` since the last reset */
    size_t most;    /* upper bound of `held` since the last reset, with scratch arenas */
    size_t unit;    /* size of blocks; 0: ZR_ARENA_BLOCK */
    bool failed;
    size_t wanted;  /* first failure: the value of `held` that exceeded the ceiling, SIZE_MAX after an overflow; 0: the
                       system had no memory */
    bool is_within; /* in the caller's memory */
    const struct zr_cancel *cancel; /* of the current step, for functions that take the arena only; NULL: never */
    struct zr_arena_block *first, *spares; /* blocks with allocations, and empty blocks kept by a reset */
    struct zr_arena_block *current;        /* block with the newest allocation */
    size_t spare_bytes;
    struct zr_arena *lender; /* for a scratch arena: its parent */
};

void zr_arena_init(struct zr_arena *arena, size_t ceiling);
void zr_arena_free(struct zr_arena *arena);

/* Makes an arena in `size` bytes of the caller's memory, aligned to ZR_ARENA_ALIGN. It never allocates others and needs
 * no zr_arena_free. */
void zr_arena_init_within(struct zr_arena *arena, void *bytes, size_t size);

/* Returns the bytes that may still be allocated, charged, or used by a scratch arena. */
static inline size_t zr_arena_left(const struct zr_arena *arena)
{
    return arena->ceiling - arena->held;
}

/* Returns the bytes that an array of this size adds to `held` if it gets a block of its own. */
size_t zr_arena_block_bytes(size_t bytes);

/* Empties the arena, clears `failed` and `wanted`, and frees blocks beyond `keep` bytes. */
void zr_arena_reset(struct zr_arena *arena, size_t keep);

/* Return `count` objects of `size` bytes, aligned to ZR_ARENA_ALIGN, undefined or zero. Return NULL once the arena has
 * failed, or if count * size overflows size_t, which has 32 bits in WebAssembly. A count of 0 gives a pointer that must
 * not be read. */
void *zr_arena_alloc(struct zr_arena *arena, uint64_t count, size_t size);

/* The same, zeroed. The first access to large memory takes long: the arena fails once its `cancel` is raised. */
void *zr_arena_zero(struct zr_arena *arena, uint64_t count, size_t size);

/* Returns a copy of `size` bytes, or NULL once the arena has failed. The bytes may be NULL if `size` is 0. */
void *zr_arena_copy(struct zr_arena *arena, const void *bytes, size_t size);

/* Zeroes allocated memory. False if the arena's `cancel` is raised meanwhile. */
bool zr_arena_clear(const struct zr_arena *arena, void *bytes, size_t size);

/* Returns a larger array with the first `count` objects of `old`, which may be NULL. It grows in place if `old` is the
 * newest allocation and its block has room. */
void *zr_arena_grow(struct zr_arena *arena, void *old, uint64_t count, uint64_t new_count, size_t size);

/* Shrinks an array of `count` objects to `new_count` if it is the newest allocation of its block; otherwise does
 * nothing. Unless the block is the current one, the bytes still count as held, until later allocations take them. */
void zr_arena_trim(struct zr_arena *arena, void *array, size_t count, size_t new_count, size_t size);

/* Counts `bytes` that a library allocates elsewhere for the request, until they are refunded or the arena is reset.
 * Returns false, with the arena failed, if they exceed the ceiling. */
bool zr_arena_charge(struct zr_arena *arena, size_t bytes);
void zr_arena_refund(struct zr_arena *arena, size_t bytes);

/* A scratch arena holds temporary data of one step, such as a library's, up to zr_arena_left of `arena`. While it is
 * open, `arena` may only be used by zr_arena_alloc_beside, which counts both. Closing frees the scratch memory, and
 * adds its peak and failure to `arena`. */
struct zr_arena zr_arena_open_scratch(struct zr_arena *arena);
void *zr_arena_alloc_beside(struct zr_arena *arena, struct zr_arena *scratch, uint64_t count, size_t size);
void zr_arena_close_scratch(struct zr_arena *scratch, struct zr_arena *arena);

/* Memory that a part of the work has added to `used` and `held`, and bytes that it needed at once. */
struct zr_arena_share {
    size_t used, held, most;
};

/* A part of the work whose memory depends on nothing that the arena held before. It gets blocks of its own, of `unit`
 * bytes. Afterwards they have no free room, and the arena goes on in the block that it had before. So an arena that
 * shares the result of equal work has the same memory left as one that repeats it, if at least share.most was left. Not
 * for arenas in the caller's memory. */
struct zr_arena_part {
    size_t used, held, most, unit; /* of the arena, before */
    struct zr_arena_block *first, *current;
};
struct zr_arena_part zr_arena_open_part(struct zr_arena *arena, size_t unit);

/* Ends the part. `shared`: the share of equal work, which is counted instead if it is larger; or NULL. */
struct zr_arena_share zr_arena_close_part(struct zr_arena *arena, const struct zr_arena_part *part,
                                          const struct zr_arena_share *shared);

/* A step whose results are not needed behind it: it goes on in the current block. */
struct zr_arena_step {
    size_t used, held, most, current_used; /* before */
    struct zr_arena_block *first, *current;
};
struct zr_arena_step zr_arena_open_step(struct zr_arena *arena);

/* Frees all that was allocated in the step. Its own blocks become spares for later allocations. Not for scratch
 * arenas. */
void zr_arena_close_step(struct zr_arena *arena, const struct zr_arena_step *step);

/* Returns the size of all blocks. */
size_t zr_arena_bytes(const struct zr_arena *arena);

bool zr_arena_ok(const struct zr_arena *arena);

#endif
