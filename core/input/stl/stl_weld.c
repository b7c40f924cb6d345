#include "input/stl/stl_weld.h"

#include <stdatomic.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/prefetch.h"
#include "base/team.h"

enum { PARTS_MAX = 16, CORNERS_PER_PART = 1 << 13 };

/* Corners looked up while memory for the next block is prefetched. */
enum { AT_ONCE = 64, BLOCKS_PER_CANCEL_CHECK = 64 };

/* Hashes, and slots of a table, between two looks at the cancellation. */
enum { WORDS_PER_CANCEL_CHECK = 1 << 16 };

/* Of a file made so that its hashes collide, no more slots are looked at for a corner. Others need fewer than 100. */
enum { PROBES_MOST = 512 };

/* One hash of so many is looked at for the estimate, and no estimate is made of fewer corners. */
enum { SAMPLED = 64, ESTIMATE_LEAST = 1 << 16 };

/* Hash table of one part, with linear probing; parts divide the corners by their hashes. An entry holds the first
 * corner, plus 1, and its hash in the upper half. 0 is empty. */
struct table {
    uint64_t *slots;
    uint32_t count; /* different corners */
};

struct welding {
    const struct zr_cancel *cancel;
    const char *triangles;
    size_t corners;
    const uint32_t *hashes;
    uint32_t *firsts;
    uint32_t part_count;
    struct table tables[PARTS_MAX];
    uint32_t size, most; /* of each table: slots; different corners that it may have */
    atomic_bool is_given_up;
};

static uint32_t part_of(const struct welding *w, uint32_t hash)
{
    return (uint32_t)((uint64_t)hash * w->part_count >> 32);
}

/* Returns the slot within the part's table, from the remaining bits of the hash. */
static uint32_t slot_of(const struct welding *w, uint32_t hash)
{
    return (uint32_t)((uint64_t)(hash * w->part_count) * w->size >> 32);
}

/* Corners of a block that belong to one part. */
struct own {
    uint32_t count, corners[AT_ONCE];
};

static void list(const struct welding *w, const struct table *table, size_t begin, uint32_t part, struct own *own)
{
    const size_t end = w->corners - begin < AT_ONCE ? w->corners : begin + AT_ONCE;
    uint32_t count = 0;
    for (size_t i = begin; i < end; i++) {
        own->corners[count] = (uint32_t)i;
        count += part_of(w, w->hashes[i]) == part;
    }
    for (uint32_t i = 0; i < count; i++)
        zr_prefetch_written(&table->slots[slot_of(w, w->hashes[own->corners[i]])], 0, sizeof *table->slots);
    own->count = count;
}

static bool is_same(const struct welding *w, uint32_t a, uint32_t b)
{
    return memcmp(zr_stl_corner(w->triangles, a), zr_stl_corner(w->triangles, b), ZR_STL_VERTEX_BYTES) == 0;
}

/* Adds the corner if it is the first. Without an answer, as many are counted as end the search. */
static uint32_t find_first(const struct welding *w, struct table *table, uint32_t corner)
{
    const uint32_t hash = w->hashes[corner];
    uint32_t slot = slot_of(w, hash), probes = 0;
    for (; table->slots[slot] != 0; slot = slot + 1 == w->size ? 0 : slot + 1) {
        const uint32_t other = (uint32_t)table->slots[slot] - 1;
        if (table->slots[slot] >> 32 == hash && is_same(w, corner, other)) return other;
        if (++probes < PROBES_MOST) continue;
        table->count = w->most + 1;
        return corner;
    }
    table->slots[slot] = (uint64_t)hash << 32 | (corner + 1);
    table->count++;
    return corner;
}

static void find_firsts(const struct welding *w, struct table *table, const struct own *own)
{
    for (uint32_t i = 0; i < own->count; i++) {
        const uint32_t entry = (uint32_t)table->slots[slot_of(w, w->hashes[own->corners[i]])];
        zr_prefetch(zr_stl_corner(w->triangles, entry != 0 ? entry - 1 : 0), 0, ZR_STL_VERTEX_BYTES);
    }
    for (uint32_t i = 0; i < own->count; i++)
        w->firsts[own->corners[i]] = find_first(w, table, own->corners[i]);
}

static bool clear_table(const struct welding *w, const struct table *table)
{
    for (size_t at = 0; at < w->size; at += WORDS_PER_CANCEL_CHECK) {
        const size_t left = w->size - at, count = left < WORDS_PER_CANCEL_CHECK ? left : WORDS_PER_CANCEL_CHECK;
        if (zr_is_cancelled(w->cancel)) return false;
        memset(table->slots + at, 0, count * sizeof *table->slots);
    }
    return true;
}

/* Looks at other threads now and then. */
static bool goes_on(struct welding *w, const struct table *table, size_t at)
{
    if (table->count > w->most) atomic_store_explicit(&w->is_given_up, true, memory_order_relaxed);
    if (at % (AT_ONCE * BLOCKS_PER_CANCEL_CHECK) != 0) return table->count <= w->most;
    return !zr_is_cancelled(w->cancel) && !atomic_load_explicit(&w->is_given_up, memory_order_relaxed);
}

/* Counts in a table of its own, as those of other threads are in the same line of the caches. */
static void weld_part(void *context, size_t begin, size_t end)
{
    struct welding *w = context;
    for (size_t part = begin; part < end; part++) {
        struct own own[2];
        struct table table = w->tables[part];
        if (!clear_table(w, &table)) return;
        list(w, &table, 0, (uint32_t)part, &own[0]);
        for (size_t at = 0, which = 0; at < w->corners && goes_on(w, &table, at); at += AT_ONCE, which ^= 1) {
            if (w->corners - at > AT_ONCE) list(w, &table, at + AT_ONCE, (uint32_t)part, &own[which ^ 1]);
            find_firsts(w, &table, &own[which]);
        }
        goes_on(w, &table, 1); /* the last block */
        w->tables[part].count = table.count;
    }
}

/* ---- estimate ---- */

/* Returns about how many hashes are different, from those that end in zeros; `most` + 1 if there are more than that, or
 * if the arena failed. Equal ones have the same end, whatever the order of the file. */
static size_t estimate(const struct zr_run *run, const uint32_t *hashes, size_t count, size_t most)
{
    const size_t size = 4 * (most / SAMPLED + 1);
    uint32_t *seen = zr_arena_zero(run->arena, size, sizeof *seen);
    size_t different = 0;
    for (size_t i = 0; seen && i < count && different * SAMPLED <= most; i++) {
        if (i % WORDS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel)) break;
        if (hashes[i] % SAMPLED != 0 || hashes[i] == 0) continue;
        size_t slot = (size_t)((uint64_t)hashes[i] * size >> 32), probes = 0;
        while (seen[slot] != 0 && seen[slot] != hashes[i] && ++probes < PROBES_MOST)
            slot = slot + 1 == size ? 0 : slot + 1;
        if (probes == PROBES_MOST) different = most; /* made to collide */
        different += seen[slot] == 0;
        seen[slot] = hashes[i];
    }
    zr_arena_trim(run->arena, seen, size, 0, sizeof *seen);
    return seen && different * SAMPLED <= most ? different * SAMPLED : most + 1;
}

/* ---- the whole step ---- */

/* Sizes the tables for `count` different corners, and some more. They are at most half full, even behind one more block
 * than they may have. */
static bool place_tables(struct zr_arena *arena, struct welding *w, size_t count)
{
    const size_t share = count / w->part_count;
    w->most = (uint32_t)(share + share / 4 + 1024);
    w->size = 2 * (w->most + AT_ONCE);
    uint64_t *room = zr_arena_alloc(arena, (size_t)w->part_count * w->size, sizeof *room);
    for (uint32_t part = 0; room && part < w->part_count; part++)
        w->tables[part].slots = room + (size_t)part * w->size;
    return room != NULL;
}

size_t zr_stl_weld(const struct zr_run *run, const char *triangles, size_t corners, const uint32_t *hashes,
                   uint32_t *firsts)
{
    const uint32_t threads = (uint32_t)zr_team_size(run->team), parts = threads < PARTS_MAX ? threads : PARTS_MAX;
    struct welding w = {.cancel = run->cancel,
                        .triangles = triangles,
                        .corners = corners,
                        .hashes = hashes,
                        .firsts = firsts,
                        .part_count = corners < CORNERS_PER_PART ? 1 : parts};
    const size_t most = corners / 3, expected = corners < ESTIMATE_LEAST ? most : estimate(run, hashes, corners, most);
    size_t count = 0;
    if (expected > most || !place_tables(run->arena, &w, expected)) return 0;
    zr_team_ranges(run->team, w.part_count, 1, weld_part, &w);
    for (uint32_t part = 0; part < w.part_count; part++)
        count += w.tables[part].count;
    return zr_is_cancelled(run->cancel) || w.is_given_up || count > most ? 0 : count;
}
