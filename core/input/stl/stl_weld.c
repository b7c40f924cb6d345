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

/* Hash table of one part, with linear probing; parts divide the corners by their hashes. An entry holds the first
 * corner, plus 1, and its hash in the upper half. 0 is empty. */
struct table {
    uint64_t *slots;
    uint32_t size, count, most; /* slots; different corners, and how many there may be */
};

struct welding {
    const struct zr_cancel *cancel;
    const char *triangles;
    size_t corners;
    const uint32_t *hashes;
    uint32_t *firsts;
    uint32_t part_count;
    struct table tables[PARTS_MAX];
    atomic_bool is_given_up;
};

static uint32_t part_of(const struct welding *w, uint32_t hash)
{
    return (uint32_t)((uint64_t)hash * w->part_count >> 32);
}

/* Returns the slot within the part's table, from the remaining bits of the hash. */
static uint32_t slot_of(const struct welding *w, const struct table *table, uint32_t hash)
{
    return (uint32_t)((uint64_t)(hash * w->part_count) * table->size >> 32);
}

static void count_part(void *context, size_t begin, size_t end)
{
    struct welding *w = context;
    for (uint32_t part = (uint32_t)begin; part < end; part++) {
        uint32_t count = 0;
        for (size_t at = 0; at < w->corners && !zr_is_cancelled(w->cancel); at += WORDS_PER_CANCEL_CHECK) {
            const size_t left = w->corners - at,
                         behind = at + (left < WORDS_PER_CANCEL_CHECK ? left : WORDS_PER_CANCEL_CHECK);
            for (size_t i = at; i < behind; i++)
                count += part_of(w, w->hashes[i]) == part;
        }
        w->tables[part].size = count;
    }
}

/* Corners of a block that belong to one part. */
struct own {
    uint32_t count, corners[AT_ONCE];
};

static void list(const struct welding *w, size_t begin, uint32_t part, struct own *own)
{
    const struct table *table = &w->tables[part];
    const size_t end = w->corners - begin < AT_ONCE ? w->corners : begin + AT_ONCE;
    uint32_t count = 0;
    for (size_t i = begin; i < end; i++) {
        own->corners[count] = (uint32_t)i;
        count += part_of(w, w->hashes[i]) == part;
    }
    for (uint32_t i = 0; i < count; i++)
        zr_prefetch_written(&table->slots[slot_of(w, table, w->hashes[own->corners[i]])], 0, sizeof *table->slots);
    own->count = count;
}

static bool is_same(const struct welding *w, uint32_t a, uint32_t b)
{
    return memcmp(zr_stl_corner(w->triangles, a), zr_stl_corner(w->triangles, b), ZR_STL_VERTEX_BYTES) == 0;
}

static uint32_t find_first(const struct welding *w, struct table *table, uint32_t corner)
{
    const uint32_t hash = w->hashes[corner];
    uint32_t slot = slot_of(w, table, hash);
    for (; table->slots[slot] != 0; slot = slot + 1 == table->size ? 0 : slot + 1) {
        const uint32_t other = (uint32_t)table->slots[slot] - 1;
        if (table->slots[slot] >> 32 == hash && is_same(w, corner, other)) return other;
    }
    table->slots[slot] = (uint64_t)hash << 32 | (corner + 1);
    table->count++;
    return corner;
}

static void find_firsts(const struct welding *w, struct table *table, const struct own *own)
{
    for (uint32_t i = 0; i < own->count; i++) {
        const uint32_t entry = (uint32_t)table->slots[slot_of(w, table, w->hashes[own->corners[i]])];
        zr_prefetch(zr_stl_corner(w->triangles, entry != 0 ? entry - 1 : 0), 0, ZR_STL_VERTEX_BYTES);
    }
    for (uint32_t i = 0; i < own->count; i++)
        w->firsts[own->corners[i]] = find_first(w, table, own->corners[i]);
}

static void clear_table(const struct welding *w, const struct table *table)
{
    for (size_t at = 0; at < table->size && !zr_is_cancelled(w->cancel); at += WORDS_PER_CANCEL_CHECK) {
        const size_t left = table->size - at, count = left < WORDS_PER_CANCEL_CHECK ? left : WORDS_PER_CANCEL_CHECK;
        memset(table->slots + at, 0, count * sizeof *table->slots);
    }
}

static bool goes_on(struct welding *w, const struct table *table, size_t at)
{
    if (table->count > table->most) atomic_store_explicit(&w->is_given_up, true, memory_order_relaxed);
    if (at % (AT_ONCE * BLOCKS_PER_CANCEL_CHECK) != 0) return table->count <= table->most;
    return !zr_is_cancelled(w->cancel) && !atomic_load_explicit(&w->is_given_up, memory_order_relaxed);
}

static void weld_part(void *context, size_t begin, size_t end)
{
    struct welding *w = context;
    for (uint32_t part = (uint32_t)begin; part < end; part++) {
        struct own own[2];
        struct table *table = &w->tables[part];
        clear_table(w, table);
        if (zr_is_cancelled(w->cancel)) return; /* of a table that is not clear */
        list(w, 0, part, &own[0]);
        for (size_t at = 0, which = 0; at < w->corners && goes_on(w, table, at); at += AT_ONCE, which ^= 1) {
            if (w->corners - at > AT_ONCE) list(w, at + AT_ONCE, part, &own[which ^ 1]);
            find_firsts(w, table, &own[which]);
        }
    }
}

/* A table is at most half full: a third of its corners may be different, and those of one more block. */
static bool place_tables(struct zr_arena *arena, struct welding *w)
{
    size_t sum = 0;
    for (uint32_t part = 0; part < w->part_count; part++) {
        struct table *table = &w->tables[part];
        table->most = table->size / 3;
        table->size = 2 * (table->most + AT_ONCE);
        sum += table->size;
    }
    uint64_t *room = zr_arena_alloc(arena, sum, sizeof *room);
    for (uint32_t part = 0; room && part < w->part_count; part++) {
        w->tables[part].slots = room;
        room += w->tables[part].size;
    }
    return room != NULL;
}

size_t zr_stl_weld(const struct zr_run *run, const char *triangles, size_t corners, const uint32_t *hashes,
                   uint32_t *firsts)
{
    const uint32_t threads = (uint32_t)zr_team_size(run->team), most = threads < PARTS_MAX ? threads : PARTS_MAX;
    struct welding w = {.cancel = run->cancel,
                        .triangles = triangles,
                        .corners = corners,
                        .hashes = hashes,
                        .firsts = firsts,
                        .part_count = corners < CORNERS_PER_PART ? 1 : most};
    size_t count = 0;
    zr_team_ranges(run->team, w.part_count, 1, count_part, &w);
    if (!place_tables(run->arena, &w)) return 0;
    zr_team_ranges(run->team, w.part_count, 1, weld_part, &w);
    for (uint32_t part = 0; part < w.part_count; part++)
        count += w.tables[part].count;
    return zr_is_cancelled(run->cancel) || w.is_given_up ? 0 : count;
}
