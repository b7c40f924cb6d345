#include "mesh/weld.h"

#include "base/prefetch.h"

enum { POSITIONS_PER_PART = 1 << 13, POSITIONS_PER_RANGE = 1 << 12 };

/* Positions looked up while memory for the next block is prefetched. Without this, the three million corners of a
 * million triangles took two thirds longer. */
enum { AT_ONCE = 64 };

/* Hash table of one part, with linear probing; parts divide the cells by their hashes. An entry holds the first
 * position of a vertex, plus 1, and the hash in the upper half, which skips entries of other cells. 0 is empty. The
 * table has at least twice as many slots as the part has positions. */
struct table {
    uint64_t *slots;
    uint32_t count;
};

struct welding {
    const struct zr_cancel *cancel;
    const struct zr_weld_input *input;
    enum zr_isa isa;
    struct zr_weld_grid grid;
    float square; /* square of the tolerance */
    uint32_t part_count;
    struct table tables[ZR_WELD_PARTS_MAX];
    uint32_t *cells;  /* per position: hash of its cell; bit 0: near a border */
    uint32_t *firsts; /* per position: first position of its vertex */
};

static uint32_t hash_of(const struct welding *w, uint32_t position)
{
    return w->cells[position] & ~1u;
}

static uint32_t part_of(const struct welding *w, uint32_t hash)
{
    return (uint32_t)((uint64_t)hash * w->part_count >> 32);
}

/* Returns the slot within the part's table, from the remaining bits of the hash. */
static uint32_t slot_of(const struct welding *w, const struct table *table, uint32_t hash)
{
    return (uint32_t)((uint64_t)(hash * w->part_count) * table->count >> 32);
}

static bool is_same(const zr_vec4 *a, const zr_vec4 *b)
{
    return a->x == b->x && a->y == b->y && a->z == b->z;
}

static bool is_near(const struct welding *w, const zr_vec4 *a, const zr_vec4 *b)
{
    const float x = a->x - b->x, y = a->y - b->y, z = a->z - b->z;
    return (x * x + y * y) + z * z <= w->square;
}

/* Returns the first vertex of the cell that is near `position` and not after it, or `position` if there is none. Sets
 * *end to the empty slot after the cell's entries. Entries of a cell are out of order if they wrap around the end of
 * the table, so all of them are compared. A vertex at the same position ends the search: no earlier one can be near
 * it. */
static uint32_t find(const struct welding *w, const struct table *table, uint32_t hash, uint32_t position,
                     uint32_t *end)
{
    const zr_vec4 *place = &w->input->at[position];
    uint32_t first = position, slot = slot_of(w, table, hash);
    for (; table->slots[slot] != 0; slot = slot + 1 == table->count ? 0 : slot + 1) {
        const uint32_t other = (uint32_t)table->slots[slot] - 1;
        if (table->slots[slot] >> 32 != hash || other >= first) continue;
        const zr_vec4 *at = &w->input->at[other];
        if (is_same(place, at)) {
            first = other;
            break;
        }
        if (is_near(w, place, at)) first = other;
    }
    *end = slot;
    return first;
}

/* ---- within cells ---- */

static void find_cells(void *context, size_t begin, size_t end)
{
    const struct welding *w = context;
    zr_weld_cells_of(w->isa)(w->input->at + begin, end - begin, &w->grid, w->cells + begin);
}

static void count_part(void *context, size_t begin, size_t end)
{
    struct welding *w = context;
    for (uint32_t part = (uint32_t)begin; part < end; part++) {
        uint32_t count = 0;
        for (uint32_t i = 0; i < w->input->count; i++)
            count += part_of(w, w->cells[i]) == part;
        w->tables[part].count = count;
    }
}

/* Positions of a block that belong to one part. */
struct own {
    uint32_t count, positions[AT_ONCE];
};

static void list(const struct welding *w, uint32_t begin, uint32_t part, struct own *own)
{
    const struct table *table = &w->tables[part];
    const uint32_t left = w->input->count - begin, end = begin + (left < AT_ONCE ? left : AT_ONCE);
    uint32_t count = 0;
    for (uint32_t i = begin; i < end; i++) {
        own->positions[count] = i;
        count += part_of(w, w->cells[i]) == part;
    }
    for (uint32_t i = 0; i < count; i++)
        zr_prefetch_written(&table->slots[slot_of(w, table, hash_of(w, own->positions[i]))], 0, sizeof *table->slots);
    own->count = count;
}

static void find_firsts(const struct welding *w, const struct table *table, const struct own *own)
{
    for (uint32_t i = 0; i < own->count; i++) {
        const uint32_t entry = (uint32_t)table->slots[slot_of(w, table, hash_of(w, own->positions[i]))];
        zr_prefetch(&w->input->at[entry != 0 ? entry - 1 : 0], 0, sizeof *w->input->at);
    }
    for (uint32_t i = 0; i < own->count; i++) {
        const uint32_t position = own->positions[i];
        uint32_t end;
        w->firsts[position] = find(w, table, hash_of(w, position), position, &end);
        if (w->firsts[position] == position) table->slots[end] = (uint64_t)hash_of(w, position) << 32 | (position + 1);
    }
}

/* The first access to large memory takes long. */
static void clear(const struct welding *w, const struct table *table)
{
    enum { SLOTS_AT_ONCE = 1 << 17 };
    for (size_t at = 0; at < table->count && !zr_is_cancelled(w->cancel); at += SLOTS_AT_ONCE) {
        const size_t left = table->count - at;
        memset(table->slots + at, 0, (left < SLOTS_AT_ONCE ? left : SLOTS_AT_ONCE) * sizeof *table->slots);
    }
}

static void weld_part(void *context, size_t begin, size_t end)
{
    const struct welding *w = context;
    const uint32_t count = w->input->count;
    for (uint32_t part = (uint32_t)begin; part < end; part++) {
        struct own own[2];
        clear(w, &w->tables[part]);
        list(w, 0, part, &own[0]);
        for (uint32_t at = 0, which = 0; at < count && !zr_is_cancelled(w->cancel); which ^= 1) {
            at += count - at < AT_ONCE ? count - at : AT_ONCE;
            list(w, at, part, &own[which ^ 1]);
            find_firsts(w, &w->tables[part], &own[which]);
        }
    }
}

/* ---- across borders ---- */

struct along {
    int32_t cell, beyond; /* the neighbour's, or the same if no border is near */
};

/* Equals cell_along of the kernel. The added constant leaves a float no fraction bits. */
static struct along along_axis(float place, float low, float cells_per_unit)
{
    const float in_cells = (place - low) * cells_per_unit, most = (float)ZR_WELD_CELLS_MOST, no_fraction = 0x1p23f;
    const float positive = in_cells > 0.0f ? in_cells : 0.0f, within = positive < most ? positive : most;
    const float cell = (within + no_fraction) - no_fraction, off = within - cell;
    const int32_t step = (off > ZR_WELD_INNER) - (off < -ZR_WELD_INNER);
    return (struct along){(int32_t)cell, (int32_t)cell + step};
}

/* Lists the hashes of up to seven neighbouring cells and returns their number. */
static int list_neighbours(const struct welding *w, uint32_t position, uint32_t hashes[7])
{
    const zr_vec4 *place = &w->input->at[position];
    const struct along x = along_axis(place->x, w->grid.low.x, w->grid.cells_per_unit),
                       y = along_axis(place->y, w->grid.low.y, w->grid.cells_per_unit),
                       z = along_axis(place->z, w->grid.low.z, w->grid.cells_per_unit);
    const int axes = (x.beyond != x.cell) + 2 * (y.beyond != y.cell) + 4 * (z.beyond != z.cell);
    int count = 0;
    for (int k = axes; k > 0; k = (k - 1) & axes) /* all non-empty subsets */
        hashes[count++] = zr_weld_hash(k & 1 ? x.beyond : x.cell, k & 2 ? y.beyond : y.cell, k & 4 ? z.beyond : z.cell);
    return count;
}

/* A neighbouring cell to search for a position. */
struct probe {
    uint32_t position, hash;
};

enum { PROBES_MOST = 7 * AT_ONCE };

static uint32_t list_probes(const struct welding *w, size_t begin, size_t end, struct probe probes[PROBES_MOST])
{
    uint32_t count = 0, hashes[7];
    for (uint32_t i = (uint32_t)begin; i < end; i++) {
        if (w->firsts[i] != i || !(w->cells[i] & 1u)) continue;
        const int neighbours = list_neighbours(w, i, hashes);
        for (int k = 0; k < neighbours; k++) {
            const struct table *table = &w->tables[part_of(w, hashes[k])];
            if (table->count == 0) continue;
            zr_prefetch(&table->slots[slot_of(w, table, hashes[k])], 0, sizeof *table->slots);
            probes[count++] = (struct probe){i, hashes[k]};
        }
    }
    return count;
}

/* Joins the positions of a range across cell borders. Threads read and write `firsts` of their own positions only. */
static void join_range(void *context, size_t begin, size_t end)
{
    const struct welding *w = context;
    struct probe probes[PROBES_MOST];
    if (zr_is_cancelled(w->cancel)) return;
    for (size_t at = begin; at < end; at += AT_ONCE) {
        const uint32_t count = list_probes(w, at, end - at < AT_ONCE ? end : at + AT_ONCE, probes);
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t position = probes[i].position, hash = probes[i].hash;
            uint32_t last;
            const uint32_t first = find(w, &w->tables[part_of(w, hash)], hash, position, &last);
            if (first < w->firsts[position]) w->firsts[position] = first;
        }
    }
}

/* ---- the whole step ---- */

/* Replaces first positions by vertex numbers, in ascending order, so that a first has its number already. */
static uint32_t number(uint32_t *vertices, uint32_t positions)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < positions; i++)
        vertices[i] = vertices[i] == i ? count++ : vertices[vertices[i]];
    return count;
}

static void place_tables(struct welding *w, uint64_t *room)
{
    for (uint32_t part = 0; part < w->part_count; part++) {
        struct table *table = &w->tables[part];
        *table = (struct table){room, 2 * table->count + 1};
        room += table->count;
    }
}

uint32_t zr_weld_make(struct zr_team *team, const struct zr_cancel *cancel, const struct zr_weld_input *input,
                      uint64_t *room, uint32_t *vertices)
{
    const float tolerance = ZR_WELD_TOLERANCE * input->diagonal;
    const uint32_t threads = (uint32_t)zr_team_size(team),
                   most = threads < ZR_WELD_PARTS_MAX ? threads : ZR_WELD_PARTS_MAX;
    struct welding w = {
        .cancel = cancel,
        .input = input,
        .isa = zr_team_isa(team),
        .grid = {input->low, tolerance > 0.0f ? 1.0f / (ZR_WELD_CELL_TOLERANCES * tolerance) : 0.0f},
        .square = tolerance * tolerance,
        .part_count = input->count < POSITIONS_PER_PART ? 1 : most,
        .cells = (uint32_t *)(void *)(room + zr_weld_slots(input->count)),
        .firsts = vertices,
    };
    zr_team_ranges(team, input->count, POSITIONS_PER_RANGE, find_cells, &w);
    zr_team_ranges(team, w.part_count, 1, count_part, &w);
    place_tables(&w, room);
    zr_team_ranges(team, w.part_count, 1, weld_part, &w);
    if (zr_is_cancelled(cancel)) return 0;
    zr_team_ranges(team, input->count, POSITIONS_PER_RANGE, join_range, &w);
    return number(vertices, input->count);
}
