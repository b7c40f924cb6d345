#include "mesh/weld.h"

#include "base/prefetch.h"

enum { POSITIONS_A_PART = 1 << 13, POSITIONS_A_RANGE = 1 << 12 };

/* Positions that are looked up while memory for the next ones is on its way: without, the three million corners of a
 * million triangles took two thirds longer. */
enum { AT_ONCE = 64 };

/* Cells are dealt out to parts by their hashes. Each part has a hash table of its own, with linear probing, of the
 * first positions of vertices: plus 1, and the hash in the upper half, so that what is of another cell is not looked
 * at. 0 is nobody. It has twice as many slots as there are positions in the part. */
struct table {
    uint64_t *slots;
    uint32_t count;
};

struct welding {
    const struct zr_cancel *cancel;
    const struct zr_weld_input *places;
    enum zr_isa isa;
    struct zr_weld_grid grid;
    float square; /* of the tolerance */
    uint32_t part_count;
    struct table tables[ZR_WELD_PARTS_MAX];
    uint32_t *cells;  /* of positions: hashes, and whether they are near a border */
    uint32_t *firsts; /* of positions: the first one of their vertex */
};

static uint32_t hash_of(const struct welding *w, uint32_t position)
{
    return w->cells[position] & ~1u;
}

static uint32_t part_of(const struct welding *w, uint32_t hash)
{
    return (uint32_t)((uint64_t)hash * w->part_count >> 32);
}

/* Within its part, by what is left of the hash. */
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

/* The first of the vertices that begin in the cell, and not behind `position`, and are near to it; `position` where
 * there is none. *end: the empty slot behind them. Those of a cell are in no order of their own where they come from
 * the end of a table to its beginning, so all of them are looked at, but none is before one that is at the very same
 * place. */
static uint32_t find(const struct welding *w, const struct table *table, uint32_t hash, uint32_t position,
                     uint32_t *end)
{
    const zr_vec4 *place = &w->places->at[position];
    uint32_t first = position, slot = slot_of(w, table, hash);
    for (; table->slots[slot] != 0; slot = slot + 1 == table->count ? 0 : slot + 1) {
        const uint32_t other = (uint32_t)table->slots[slot] - 1;
        if (table->slots[slot] >> 32 != hash || other >= first) continue;
        const zr_vec4 *at = &w->places->at[other];
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
    static zr_weld_cells_fn *const cells_of[ZR_ISA_COUNT] = ZR_KERNELS(zr_weld_cells);
    const struct welding *w = context;
    cells_of[w->isa](w->places->at + begin, end - begin, &w->grid, w->cells + begin);
}

static void count_part(void *context, size_t begin, size_t end)
{
    struct welding *w = context;
    for (uint32_t part = (uint32_t)begin; part < end; part++) {
        uint32_t count = 0;
        for (uint32_t i = 0; i < w->places->count; i++)
            count += part_of(w, w->cells[i]) == part;
        w->tables[part].count = count;
    }
}

/* Positions of a part. */
struct own {
    uint32_t count, positions[AT_ONCE];
};

static void list(const struct welding *w, uint32_t begin, uint32_t part, struct own *own)
{
    const struct table *table = &w->tables[part];
    const uint32_t left = w->places->count - begin, end = begin + (left < AT_ONCE ? left : AT_ONCE);
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
        zr_prefetch(&w->places->at[entry != 0 ? entry - 1 : 0], 0, sizeof *w->places->at);
    }
    for (uint32_t i = 0; i < own->count; i++) {
        const uint32_t position = own->positions[i];
        uint32_t end;
        w->firsts[position] = find(w, table, hash_of(w, position), position, &end);
        if (w->firsts[position] == position) table->slots[end] = (uint64_t)hash_of(w, position) << 32 | (position + 1);
    }
}

static void weld_part(void *context, size_t begin, size_t end)
{
    const struct welding *w = context;
    const uint32_t count = w->places->count;
    for (uint32_t part = (uint32_t)begin; part < end; part++) {
        struct own own[2];
        memset(w->tables[part].slots, 0, w->tables[part].count * sizeof *w->tables[part].slots);
        list(w, 0, part, &own[0]);
        for (uint32_t at = 0, which = 0; at < count && !zr_is_cancelled(w->cancel); which ^= 1) {
            at += count - at < AT_ONCE ? count - at : AT_ONCE;
            list(w, at, part, &own[which ^ 1]);
            find_firsts(w, &w->tables[part], &own[which]);
        }
    }
}

/* ---- beyond borders ---- */

struct along {
    int32_t cell, beyond; /* the neighbour's, or the same again where no border is near */
};

/* As the kernel has it; what is added is so large that it leaves a float no fraction. */
static struct along along_axis(float place, float low, float cells_per_unit)
{
    const float in_cells = (place - low) * cells_per_unit, most = (float)ZR_WELD_CELLS_MOST, no_fraction = 0x1p23f;
    const float positive = in_cells > 0.0f ? in_cells : 0.0f, within = positive < most ? positive : most;
    const float cell = (within + no_fraction) - no_fraction, off = within - cell;
    const int32_t step = (off > ZR_WELD_INNER) - (off < -ZR_WELD_INNER);
    return (struct along){(int32_t)cell, (int32_t)cell + step};
}

/* Hashes of up to seven cells. */
static int list_neighbours(const struct welding *w, uint32_t position, uint32_t hashes[7])
{
    const zr_vec4 *place = &w->places->at[position];
    const struct along x = along_axis(place->x, w->grid.low.x, w->grid.cells_per_unit),
                       y = along_axis(place->y, w->grid.low.y, w->grid.cells_per_unit),
                       z = along_axis(place->z, w->grid.low.z, w->grid.cells_per_unit);
    const int axes = (x.beyond != x.cell) + 2 * (y.beyond != y.cell) + 4 * (z.beyond != z.cell);
    int count = 0;
    for (int k = axes; k > 0; k = (k - 1) & axes) /* every choice of some of them */
        hashes[count++] = zr_weld_hash(k & 1 ? x.beyond : x.cell, k & 2 ? y.beyond : y.cell, k & 4 ? z.beyond : z.cell);
    return count;
}

/* A cell in which a position is looked for. */
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

/* Each changes what is said of its own positions only, and probes at no others'. */
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

/* ---- all of it ---- */

/* Firsts become numbers; whatever is before a position has one already. */
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

uint32_t zr_weld_make(struct zr_team *team, const struct zr_cancel *cancel, const struct zr_weld_input *places,
                      uint64_t *room, uint32_t *vertices)
{
    const float tolerance = ZR_WELD_TOLERANCE * places->diagonal;
    const uint32_t threads = (uint32_t)zr_team_size(team),
                   most = threads < ZR_WELD_PARTS_MAX ? threads : ZR_WELD_PARTS_MAX;
    struct welding w = {
        .cancel = cancel,
        .places = places,
        .isa = zr_team_isa(team),
        .grid = {places->low, tolerance > 0.0f ? 1.0f / (ZR_WELD_CELL_TOLERANCES * tolerance) : 0.0f},
        .square = tolerance * tolerance,
        .part_count = places->count < POSITIONS_A_PART ? 1 : most,
        .cells = (uint32_t *)(void *)(room + zr_weld_slots(places->count)),
        .firsts = vertices,
    };
    zr_team_ranges(team, places->count, POSITIONS_A_RANGE, find_cells, &w);
    zr_team_ranges(team, w.part_count, 1, count_part, &w);
    place_tables(&w, room);
    zr_team_ranges(team, w.part_count, 1, weld_part, &w);
    if (zr_is_cancelled(cancel)) return 0;
    zr_team_ranges(team, places->count, POSITIONS_A_RANGE, join_range, &w);
    return number(vertices, places->count);
}
