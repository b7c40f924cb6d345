#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/checked.h"
#include "base/forbid.h"

#ifndef MADV_HUGEPAGE
#define MADV_HUGEPAGE MADV_NORMAL /* a system that has one size of pages */
#endif

/* Behind each allocation where AddressSanitizer watches: it forbids what was not allocated, so that one byte too far is
 * seen though the block goes on. */
enum { HEADER = ZR_ARENA_ALIGN, GAP = ZR_ASAN ? ZR_ARENA_ALIGN : 0 };

struct zr_arena_block {
    struct zr_arena_block *next;
    size_t capacity, used;
};

_Static_assert(sizeof(struct zr_arena_block) <= HEADER, "the header fits before the first allocation");

static char *block_bytes(struct zr_arena_block *block)
{
    return (char *)block + HEADER;
}

void zr_arena_init(struct zr_arena *arena, size_t ceiling)
{
    *arena = (struct zr_arena){.ceiling = ceiling};
}

void zr_arena_reset(struct zr_arena *arena, size_t keep)
{
    struct zr_arena_block **link = &arena->first;
    while (*link) {
        struct zr_arena_block *block = *link;
        if (block->capacity <= keep) {
            keep -= block->capacity;
            ZR_FORBID(block_bytes(block), block->used); /* what lies behind is forbidden still */
            block->used = 0;
            link = &block->next;
        } else {
            *link = block->next;
            free(block);
        }
    }
    arena->current = arena->first;
    arena->used = arena->peak = 0;
    arena->failed = false;
    arena->wanted = 0;
}

void zr_arena_free(struct zr_arena *arena)
{
    zr_arena_reset(arena, 0);
}

void zr_arena_init_within(struct zr_arena *arena, void *bytes, size_t size)
{
    struct zr_arena_block *block = bytes;
    *arena = (struct zr_arena){.ceiling = size - HEADER, .is_within = true, .first = block, .current = block};
    *block = (struct zr_arena_block){.capacity = size - HEADER};
}

/* `more` bytes beside those that are used: too many, or 0 where it is the system that has none. */
static void *fail(struct zr_arena *arena, size_t more)
{
    if (!arena->failed && more > 0) arena->wanted = more > SIZE_MAX - arena->used ? SIZE_MAX : arena->used + more;
    arena->failed = true;
    return NULL;
}

static void use(struct zr_arena *arena, size_t bytes)
{
    arena->used += bytes;
    if (arena->used > arena->peak) arena->peak = arena->used;
}

static size_t rounded_up(size_t bytes, size_t unit)
{
    return (bytes + unit - 1) & ~(unit - 1);
}

/* With room for `bytes` at least. NULL where the system has no more. */
static struct zr_arena_block *block_make(size_t bytes)
{
    if (bytes > SIZE_MAX - HEADER - ZR_ARENA_BLOCK) return NULL;
    const size_t size = rounded_up(HEADER + bytes, ZR_ARENA_BLOCK);
    struct zr_arena_block *block = aligned_alloc(ZR_ARENA_BLOCK, size);
    if (!block) return NULL;
    /* So that the processor looks up 2 MB at a time, and not 4 KB: 5 % of a million triangles, and what comes after
     * other work is up to 16 % faster. The system may refuse. */
    madvise(block, size, MADV_HUGEPAGE);
    *block = (struct zr_arena_block){.capacity = size - HEADER};
    ZR_FORBID(block_bytes(block), block->capacity);
    return block;
}

/* A block with room for `bytes` behind `current`: one that a reset left, or a
 * new one, linked in so that no kept block is lost. */
static struct zr_arena_block *next_block(struct zr_arena *arena, size_t bytes)
{
    struct zr_arena_block **link = arena->current ? &arena->current->next : &arena->first;
    for (struct zr_arena_block **search = link; *search; search = &(*search)->next)
        if ((*search)->capacity >= bytes) {
            struct zr_arena_block *found = *search;
            *search = found->next;
            found->next = *link;
            *link = found;
            return found;
        }
    struct zr_arena_block *block = arena->is_within ? NULL : block_make(bytes);
    if (!block) return NULL;
    block->next = *link;
    *link = block;
    return block;
}

void *zr_arena_alloc(struct zr_arena *arena, size_t count, size_t size)
{
    size_t bytes;
    if (arena->failed || !zr_mul_size(count, size, &bytes) || bytes > SIZE_MAX - ZR_ARENA_ALIGN - GAP)
        return fail(arena, SIZE_MAX);
    const size_t held = rounded_up(bytes, ZR_ARENA_ALIGN);
    if (held > arena->ceiling - arena->used) return fail(arena, held);

    struct zr_arena_block *block = arena->current;
    if (!block || held + GAP > block->capacity - block->used) {
        block = next_block(arena, held + GAP);
        if (!block) return fail(arena, 0);
        block->used = 0;
        arena->current = block;
    }
    void *result = block_bytes(block) + block->used;
    block->used += held + GAP;
    use(arena, held);
    ZR_PERMIT(result, bytes);
    return result;
}

void *zr_arena_zero(struct zr_arena *arena, size_t count, size_t size)
{
    void *result = zr_arena_alloc(arena, count, size);
    if (result) memset(result, 0, count * size);
    return result;
}

void *zr_arena_grow(struct zr_arena *arena, void *old, size_t count, size_t new_count, size_t size)
{
    size_t old_bytes, new_bytes;
    if (arena->failed || !zr_mul_size(count, size, &old_bytes) || !zr_mul_size(new_count, size, &new_bytes) ||
        new_bytes > SIZE_MAX - ZR_ARENA_ALIGN - GAP)
        return fail(arena, SIZE_MAX);
    size_t held = rounded_up(old_bytes, ZR_ARENA_ALIGN);
    struct zr_arena_block *block = arena->current;
    if (old && new_bytes >= old_bytes && block && (char *)old + held + GAP == block_bytes(block) + block->used) {
        /* The newest allocation: what follows it, if it fits, is its own. */
        size_t more = rounded_up(new_bytes, ZR_ARENA_ALIGN) - held;
        if (more <= block->capacity - block->used && more <= arena->ceiling - arena->used) {
            block->used += more;
            use(arena, more);
            ZR_PERMIT(old, new_bytes);
            return old;
        }
    }
    void *result = zr_arena_alloc(arena, new_count, size);
    if (result && old_bytes > 0) memcpy(result, old, old_bytes < new_bytes ? old_bytes : new_bytes);
    return result;
}

void zr_arena_trim(struct zr_arena *arena, void *array, size_t count, size_t new_count, size_t size)
{
    const size_t held = rounded_up(count * size, ZR_ARENA_ALIGN), kept = rounded_up(new_count * size, ZR_ARENA_ALIGN);
    struct zr_arena_block *block = arena->current;
    if (!block || (char *)array + held + GAP != block_bytes(block) + block->used) return;
    ZR_FORBID((char *)array + new_count * size, held + GAP - new_count * size);
    block->used -= held - kept;
    arena->used -= held - kept;
}

bool zr_arena_charge(struct zr_arena *arena, size_t bytes)
{
    if (arena->failed || bytes > arena->ceiling - arena->used) {
        fail(arena, bytes);
        return false;
    }
    use(arena, bytes);
    return true;
}

void zr_arena_refund(struct zr_arena *arena, size_t bytes)
{
    arena->used -= bytes;
}

struct zr_arena zr_arena_open_scratch(const struct zr_arena *arena)
{
    return (struct zr_arena){.ceiling = arena->ceiling - arena->used, .failed = arena->failed, .cancel = arena->cancel};
}

void *zr_arena_alloc_beside(struct zr_arena *arena, struct zr_arena *scratch, size_t count, size_t size)
{
    if (!zr_arena_charge(arena, scratch->used)) return NULL;
    void *result = zr_arena_alloc(arena, count, size);
    zr_arena_refund(arena, scratch->used);
    scratch->ceiling = arena->ceiling - arena->used;
    return result;
}

void zr_arena_close_scratch(struct zr_arena *scratch, struct zr_arena *arena)
{
    if (arena->used + scratch->peak > arena->peak) arena->peak = arena->used + scratch->peak;
    if (scratch->failed) fail(arena, scratch->wanted);
    zr_arena_free(scratch);
}

bool zr_arena_ok(const struct zr_arena *arena)
{
    return !arena->failed;
}
