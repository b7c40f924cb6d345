#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "base/cancel.h"
#include "base/checked.h"
#include "base/forbid.h"

#ifndef MADV_HUGEPAGE
#define MADV_HUGEPAGE   MADV_NORMAL /* systems with a single page size */
#define MADV_NOHUGEPAGE MADV_NORMAL
#endif

/* Gap after each allocation under AddressSanitizer: unallocated bytes are poisoned, so that an overrun is detected
 * although the block continues. */
enum { HEADER = ZR_ARENA_ALIGN, GAP = ZR_ASAN ? ZR_ARENA_ALIGN : 0, PAGE = 4096 };

struct zr_arena_block {
    struct zr_arena_block *next;
    size_t size;           /* including the header */
    size_t capacity, used; /* bytes after the header */
};

_Static_assert(sizeof(struct zr_arena_block) <= HEADER, "the header fits before the first allocation");

static char *block_bytes(struct zr_arena_block *block)
{
    return (char *)block + HEADER;
}

static size_t room_in(const struct zr_arena_block *block)
{
    return block ? block->capacity - block->used : 0;
}

static size_t rounded_up(size_t bytes, size_t unit)
{
    return (bytes + unit - 1) & ~(unit - 1);
}

/* ---- blocks ---- */

/* Returns the size of a block with room for `bytes` and the header: a multiple of `unit`, a power of two from a page to
 * a huge page. A rest of at most a sixteenth of a unit is rounded up to pages instead. SIZE_MAX if no such block can
 * exist. Whole huge pages: the system clears as many bytes in small ones fifty times as slowly. */
static size_t block_size(size_t bytes, size_t unit)
{
    if (bytes > SIZE_MAX - HEADER - ZR_ARENA_BLOCK) return SIZE_MAX;
    const size_t whole = rounded_up(HEADER + bytes, unit), beyond = (HEADER + bytes) % unit;
    return whole == unit || beyond > unit / 16 ? whole : rounded_up(HEADER + bytes, PAGE);
}

size_t zr_arena_block_bytes(size_t bytes)
{
    return block_size(rounded_up(bytes, ZR_ARENA_ALIGN), ZR_ARENA_BLOCK) - HEADER;
}

/* Returns NULL if the system has no memory. */
static struct zr_arena_block *block_make(size_t size)
{
    void *bytes;
    const bool is_small = size < ZR_ARENA_BLOCK;
    if (size == SIZE_MAX || posix_memalign(&bytes, is_small ? PAGE : ZR_ARENA_BLOCK, size) != 0) return NULL;
    /* Huge pages: the TLB maps 2 MB per entry instead of 4 KB. This saves 5 % of a million triangles, and up to 16 %
     * after other work. The part after the last whole 2 MB would take a huge page too, mostly outside the block. The
     * system may refuse. */
    const size_t whole = size & ~((size_t)ZR_ARENA_BLOCK - 1);
    if (whole > 0) madvise(bytes, whole, MADV_HUGEPAGE);
    if (size > whole && !is_small) madvise((char *)bytes + whole, size - whole, MADV_NOHUGEPAGE);
    struct zr_arena_block *block = bytes;
    *block = (struct zr_arena_block){.size = size, .capacity = size - HEADER};
    ZR_FORBID(block_bytes(block), block->capacity);
    return block;
}

/* Frees the spare blocks. Their memory goes back to the system at once: free may keep it. */
static void free_spares(struct zr_arena *arena)
{
    while (arena->spares) {
        struct zr_arena_block *block = arena->spares;
        const size_t size = block->size;
        arena->spares = block->next;
        if (size >= ZR_ARENA_BLOCK) madvise((char *)block + PAGE, (size & ~((size_t)PAGE - 1)) - PAGE, MADV_DONTNEED);
        free(block);
    }
    arena->spare_bytes = 0;
}

/* Takes the smallest spare block that is large enough, unless more than half of it would be unused; NULL: none. Returns
 * the bytes beyond `size` to the system, as a new block would not have them: a request's memory does not depend on
 * earlier requests. */
static struct zr_arena_block *take_spare(struct zr_arena *arena, size_t size)
{
    struct zr_arena_block **best = NULL;
    for (struct zr_arena_block **link = &arena->spares; *link; link = &(*link)->next)
        if ((*link)->size >= size && (*link)->size / 2 <= size && (!best || (*link)->size < (*best)->size)) best = link;
    if (!best) return NULL;
    struct zr_arena_block *block = *best;
    *best = block->next;
    arena->spare_bytes -= block->size;
    block->capacity = size - HEADER;
    if (block->size > size) madvise((char *)block + size, block->size - size, MADV_DONTNEED);
    return block;
}

/* Returns a block that has room for `bytes`, among those with allocations; NULL: none. */
static struct zr_arena_block *find_room(const struct zr_arena *arena, size_t bytes)
{
    for (struct zr_arena_block *block = arena->first; block; block = block->next)
        if (room_in(block) >= bytes) return block;
    return NULL;
}

/* Empties a block, which is in no list. */
static void make_spare(struct zr_arena *arena, struct zr_arena_block *block)
{
    ZR_FORBID(block_bytes(block), block->used); /* the rest is still poisoned */
    block->used = 0;
    block->next = arena->spares;
    arena->spares = block;
    arena->spare_bytes += block->size;
}

/* ---- arenas ---- */

void zr_arena_init(struct zr_arena *arena, size_t ceiling)
{
    *arena = (struct zr_arena){.ceiling = ceiling};
}

void zr_arena_reset(struct zr_arena *arena, size_t keep)
{
    struct zr_arena_block *lists[] = {arena->first, arena->spares};
    arena->first = arena->current = arena->spares = NULL;
    arena->spare_bytes = 0;
    for (int i = 0; i < 2; i++)
        for (struct zr_arena_block *block = lists[i], *next; block; block = next) {
            next = block->next;
            if (block->size > keep - arena->spare_bytes) {
                free(block);
                continue;
            }
            make_spare(arena, block);
        }
    arena->used = arena->held = arena->peak = arena->most = 0;
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
    *block = (struct zr_arena_block){.size = size, .capacity = size - HEADER};
}

/* Marks the arena as failed, for `more` bytes beyond the held ones; 0: the system had no memory. */
static void *fail(struct zr_arena *arena, size_t more)
{
    if (!arena->failed && more > 0) arena->wanted = more > SIZE_MAX - arena->held ? SIZE_MAX : arena->held + more;
    arena->failed = true;
    return NULL;
}

static void use(struct zr_arena *arena, size_t bytes)
{
    arena->used += bytes;
    arena->held += bytes;
    if (arena->used > arena->peak) arena->peak = arena->used;
    if (arena->held > arena->most) arena->most = arena->held;
}

/* Spare blocks do not count as held; frees them if `more` bytes would not fit beside them. */
static void make_room(struct zr_arena *arena, size_t more)
{
    struct zr_arena *keeper = arena->lender ? arena->lender : arena;
    if (keeper->spares && more + keeper->spare_bytes > zr_arena_left(arena)) free_spares(keeper);
}

/* Adds a block to the request, spare or new. */
static struct zr_arena_block *add_block(struct zr_arena *arena, size_t bytes)
{
    const size_t size = block_size(bytes, arena->unit ? arena->unit : ZR_ARENA_BLOCK);
    struct zr_arena_block *block = take_spare(arena, size);
    if (!block && !arena->is_within) {
        make_room(arena, size);
        block = block_make(size);
    }
    if (!block) return NULL;
    block->next = arena->first;
    arena->first = block;
    return block;
}

/* Makes a block with room for `bytes` the current one. The free bytes of the previous one then count as held. */
static bool change_block(struct zr_arena *arena, size_t bytes)
{
    const size_t left_over = room_in(arena->current);
    struct zr_arena_block *block = find_room(arena, bytes);
    const size_t held = arena->held + left_over - room_in(block);
    if (held > arena->ceiling || bytes - GAP > arena->ceiling - held) {
        fail(arena, left_over - room_in(block) + bytes - GAP);
        return false;
    }
    arena->held = held;
    if (!block) block = add_block(arena, bytes);
    if (!block) {
        fail(arena, 0);
        return false;
    }
    arena->current = block;
    return true;
}

void *zr_arena_alloc(struct zr_arena *arena, uint64_t count, size_t size)
{
    size_t bytes;
    if (arena->failed || !zr_mul_size(count, size, &bytes) || bytes > SIZE_MAX - ZR_ARENA_ALIGN - GAP)
        return fail(arena, SIZE_MAX);
    const size_t taken = rounded_up(bytes, ZR_ARENA_ALIGN);
    if (taken > zr_arena_left(arena)) return fail(arena, taken);
    if ((!arena->current || taken + GAP > room_in(arena->current)) && !change_block(arena, taken + GAP)) return NULL;
    struct zr_arena_block *block = arena->current;
    void *result = block_bytes(block) + block->used;
    block->used += taken + GAP;
    use(arena, taken);
    ZR_PERMIT(result, bytes);
    return result;
}

void *zr_arena_zero(struct zr_arena *arena, uint64_t count, size_t size)
{
    void *result = zr_arena_alloc(arena, count, size);
    if (result && !zr_arena_clear(arena, result, (size_t)count * size)) return fail(arena, 0);
    return result;
}

void *zr_arena_copy(struct zr_arena *arena, const void *bytes, size_t size)
{
    void *copy = zr_arena_alloc(arena, size, 1);
    if (copy && size > 0) memcpy(copy, bytes, size);
    return copy;
}

bool zr_arena_clear(const struct zr_arena *arena, void *bytes, size_t size)
{
    for (size_t at = 0; at < size; at += ZR_ARENA_BLOCK) {
        if (at > 0 && zr_is_cancelled(arena->cancel)) return false;
        memset((char *)bytes + at, 0, size - at < ZR_ARENA_BLOCK ? size - at : ZR_ARENA_BLOCK);
    }
    return true;
}

void *zr_arena_grow(struct zr_arena *arena, void *old, uint64_t count, uint64_t new_count, size_t size)
{
    size_t old_bytes, new_bytes;
    if (arena->failed || !zr_mul_size(count, size, &old_bytes) || !zr_mul_size(new_count, size, &new_bytes) ||
        new_bytes > SIZE_MAX - ZR_ARENA_ALIGN - GAP)
        return fail(arena, SIZE_MAX);
    const size_t taken = rounded_up(old_bytes, ZR_ARENA_ALIGN);
    struct zr_arena_block *block = arena->current;
    if (old && new_bytes >= old_bytes && block && (char *)old + taken + GAP == block_bytes(block) + block->used) {
        /* the newest allocation: extend it in place if the block has room */
        size_t more = rounded_up(new_bytes, ZR_ARENA_ALIGN) - taken;
        if (more <= room_in(block) && more <= zr_arena_left(arena)) {
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
    const size_t taken = rounded_up(count * size, ZR_ARENA_ALIGN), kept = rounded_up(new_count * size, ZR_ARENA_ALIGN);
    if (!array) return;
    const char *end = (const char *)array + taken + GAP;
    struct zr_arena_block *block = arena->current; /* in a step, it is not among the others */
    if (block && end != block_bytes(block) + block->used)
        for (block = arena->first; block && end != block_bytes(block) + block->used;)
            block = block->next;
    if (!block) return;
    ZR_FORBID((char *)array + new_count * size, taken + GAP - new_count * size);
    block->used -= taken - kept;
    arena->used -= taken - kept;
    if (block == arena->current) arena->held -= taken - kept;
}

bool zr_arena_charge(struct zr_arena *arena, size_t bytes)
{
    if (arena->failed || bytes > zr_arena_left(arena)) {
        fail(arena, bytes);
        return false;
    }
    make_room(arena, bytes);
    use(arena, bytes);
    return true;
}

void zr_arena_refund(struct zr_arena *arena, size_t bytes)
{
    arena->used -= bytes;
    arena->held -= bytes;
}

struct zr_arena zr_arena_open_scratch(struct zr_arena *arena)
{
    return (struct zr_arena){
        .ceiling = zr_arena_left(arena), .failed = arena->failed, .cancel = arena->cancel, .lender = arena};
}

void *zr_arena_alloc_beside(struct zr_arena *arena, struct zr_arena *scratch, uint64_t count, size_t size)
{
    const size_t held = scratch->held;
    if (!zr_arena_charge(arena, held)) return NULL;
    void *result = zr_arena_alloc(arena, count, size);
    zr_arena_refund(arena, held);
    scratch->ceiling = zr_arena_left(arena);
    return result;
}

void zr_arena_close_scratch(struct zr_arena *scratch, struct zr_arena *arena)
{
    const size_t most = arena->ceiling - scratch->ceiling + scratch->most; /* held beside it at most, and its own */
    if (arena->used + scratch->peak > arena->peak) arena->peak = arena->used + scratch->peak;
    if (most > arena->most) arena->most = most;
    if (scratch->failed) fail(arena, scratch->wanted);
    zr_arena_free(scratch);
}

struct zr_arena_part zr_arena_open_part(struct zr_arena *arena, size_t unit)
{
    const struct zr_arena_part part = {arena->used, arena->held,  arena->most,
                                       arena->unit, arena->first, arena->current};
    arena->first = arena->current = NULL;
    arena->most = arena->held;
    arena->unit = unit;
    return part;
}

struct zr_arena_share zr_arena_close_part(struct zr_arena *arena, const struct zr_arena_part *part,
                                          const struct zr_arena_share *shared)
{
    struct zr_arena_block **end = &arena->first;
    const size_t left_over = room_in(arena->current);
    if (left_over > zr_arena_left(arena))
        fail(arena, left_over);
    else
        arena->held += left_over;
    if (arena->held > arena->most) arena->most = arena->held;
    for (; *end; end = &(*end)->next)
        (*end)->capacity = (*end)->used;
    *end = part->first;
    arena->current = part->current;
    arena->unit = part->unit;
    if (shared && arena->used < part->used + shared->used) arena->used = part->used + shared->used;
    if (shared && arena->held < part->held + shared->held) arena->held = part->held + shared->held;
    const struct zr_arena_share share = {arena->used - part->used, arena->held - part->held, arena->most - part->held};
    if (arena->used > arena->peak) arena->peak = arena->used;
    if (arena->most < arena->held) arena->most = arena->held;
    if (arena->most < part->most) arena->most = part->most;
    return share;
}

struct zr_arena_step zr_arena_open_step(struct zr_arena *arena)
{
    const struct zr_arena_step step = {.used = arena->used,
                                       .held = arena->held,
                                       .most = arena->most,
                                       .current_used = arena->current ? arena->current->used : 0,
                                       .first = arena->first,
                                       .current = arena->current};
    arena->first = NULL;
    arena->most = arena->held;
    return step;
}

void zr_arena_close_step(struct zr_arena *arena, const struct zr_arena_step *step)
{
    struct zr_arena_block *current = step->current;
    for (struct zr_arena_block *block = arena->first, *next; block; block = next) {
        next = block->next;
        make_spare(arena, block);
    }
    if (current) {
        ZR_FORBID(block_bytes(current) + step->current_used, current->used - step->current_used);
        current->used = step->current_used;
    }
    arena->first = step->first;
    arena->current = current;
    arena->used = step->used;
    arena->held = step->held;
    if (arena->most < step->most) arena->most = step->most;
}

size_t zr_arena_bytes(const struct zr_arena *arena)
{
    size_t bytes = arena->spare_bytes;
    for (const struct zr_arena_block *block = arena->first; block; block = block->next)
        bytes += block->size;
    return bytes;
}

bool zr_arena_ok(const struct zr_arena *arena)
{
    return !arena->failed;
}
