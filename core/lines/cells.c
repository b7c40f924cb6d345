#include "lines/cells.h"

#include "base/cancel.h"
#include "base/run.h"
#include "base/sort.h"

/* Triangles are dealt to chunks, whose counts are kept apart. */
enum { CHUNKS_MOST = 16, HIDERS_PER_CHUNK = 4096, HIDERS_PER_CANCEL_CHECK = 1 << 10, SORTED_PER_RANGE = 16 };

/* Widens triangles, in pixels. */
static const double rim = 1e-5;

struct binning {
    const struct zr_window_mesh *mesh;
    const struct zr_cancel *cancel;
    uint32_t columns, rows, hider_count, chunk_count;
    uint32_t *counts; /* [chunk][cell]: entries, then the next free one */
    struct zr_cell_entry *entries;
};

static uint32_t chunk_begin(const struct binning *b, size_t chunk)
{
    return (uint32_t)(chunk * b->hider_count / b->chunk_count);
}

/* Range of x that a triangle covers between two heights. */
struct span {
    double low, high;
};

static void widen(struct span *span, double x)
{
    if (x < span->low) span->low = x;
    if (x > span->high) span->high = x;
}

static void widen_at(struct span *span, const struct zr_window_point *a, const struct zr_window_point *b, double y)
{
    if ((a->y < y) != (b->y < y)) widen(span, a->x + (y - a->y) / (b->y - a->y) * (b->x - a->x));
}

static struct span span_of(const struct zr_window_point *const corners[3], double low, double high)
{
    struct span span = {HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < 3; k++) {
        const struct zr_window_point *a = corners[k], *b = corners[(k + 1) % 3];
        if (a->y >= low && a->y <= high) widen(&span, a->x);
        widen_at(&span, a, b, low);
        widen_at(&span, a, b, high);
    }
    return span;
}

/* A triangle; its extents in steps of the window, from the lower left of cell 0. */
struct placed {
    uint32_t hider;
    int32_t low_x, low_y, high_x, high_y;
    float near;
};

/* Returns the largest float that is not greater. */
static float rounded_down(double value)
{
    const float near = (float)value;
    return (double)near > value ? nextafterf(near, -HUGE_VALF) : near;
}

/* Returns the step of a coordinate, held within 0 .. most. */
static int32_t step_of(double coordinate, uint32_t cells)
{
    const double step = (coordinate + ZR_WINDOW_MARGIN) * ZR_BOX_STEPS, most = (double)cells * ZR_CELL_STEPS;
    return step >= most ? (int32_t)most : step > 0.0 ? (int32_t)step : 0;
}

static uint8_t in_cell(int32_t step, uint32_t cell)
{
    const int32_t own = step - (int32_t)(cell * ZR_CELL_STEPS);
    return own < 0 ? 0 : own < ZR_CELL_STEPS ? (uint8_t)own : ZR_CELL_STEPS - 1;
}

static struct zr_cell_entry entry_in(const struct placed *p, uint32_t row, uint32_t column)
{
    return (struct zr_cell_entry){
        p->hider,
        p->near,
        {in_cell(p->low_x, column), in_cell(p->low_y, row), in_cell(p->high_x, column), in_cell(p->high_y, row)}};
}

static void add_to(const struct binning *b, uint32_t *counts, uint32_t row, uint32_t column, const struct placed *p)
{
    uint32_t *count = &counts[row * b->columns + column];
    if (b->entries) b->entries[*count] = entry_in(p, row, column);
    (*count)++;
}

/* Adds a triangle to the cells of a row. */
static void add_row(const struct binning *b, uint32_t *counts, uint32_t row, struct span span,
                    const struct placed *placed)
{
    if (!(span.high >= -ZR_WINDOW_MARGIN && span.low <= zr_cell_border(b->columns))) return;
    const uint32_t end = zr_cell_at(span.high + rim, b->columns);
    for (uint32_t column = zr_cell_at(span.low - rim, b->columns); column <= end; column++)
        add_to(b, counts, row, column, placed);
}

/* Adds a triangle to all cells that it overlaps: counts it, or with b->entries writes it. */
static void add(const struct binning *b, uint32_t *counts, uint32_t hider)
{
    const struct zr_window_point *corners[3];
    struct span across = {HUGE_VAL, -HUGE_VAL}, up = {HUGE_VAL, -HUGE_VAL};
    struct placed placed = {.hider = hider};
    double near = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        corners[k] = &b->mesh->points[b->mesh->corners[hider][k]];
        widen(&across, corners[k]->x);
        widen(&up, corners[k]->y);
        if (corners[k]->z < near) near = corners[k]->z;
    }
    if (b->entries) {
        placed.low_x = step_of(across.low - rim, b->columns);
        placed.high_x = step_of(across.high + rim, b->columns);
        placed.low_y = step_of(up.low - rim, b->rows);
        placed.high_y = step_of(up.high + rim, b->rows);
        placed.near = rounded_down(near);
    }
    const uint32_t first = zr_cell_at(up.low - rim, b->rows), last = zr_cell_at(up.high + rim, b->rows);
    if (first == last) {
        add_row(b, counts, first, across, &placed);
        return;
    }
    for (uint32_t row = first; row <= last; row++)
        add_row(b, counts, row,
                span_of(corners, row == first ? -HUGE_VAL : zr_cell_border(row) - rim,
                        row == last ? HUGE_VAL : zr_cell_border(row + 1) + rim),
                &placed);
}

static void bin_chunks(void *context, size_t begin, size_t end)
{
    const struct binning *b = context;
    for (size_t chunk = begin; chunk < end; chunk++) {
        uint32_t *counts = b->counts + chunk * b->columns * b->rows;
        for (uint32_t h = chunk_begin(b, chunk); h < chunk_begin(b, chunk + 1); h++) {
            if (h % HIDERS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(b->cancel)) return;
            if (b->mesh->traits[h] & ZR_TRIANGLE_HIDES) add(b, counts, h);
        }
    }
}

/* ---- long lists ---- */

struct sorting {
    const struct zr_cancel *cancel;
    const uint32_t *firsts;
    struct zr_cell_entry *entries, *sorted;
    uint64_t *keys;
};

/* Returns a number that ascends with a float. */
static uint32_t ordered(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits >> 31 ? ~bits : bits | UINT32_C(1) << 31;
}

/* Sorts a list by `near`, and keeps the order of entries with the same one. */
static void sort_cell(const struct sorting *s, uint32_t first, uint32_t count)
{
    struct zr_cell_entry *entries = s->entries + first, *sorted = s->sorted + first;
    uint64_t *keys = s->keys + first;
    for (uint32_t i = 0; i < count; i++)
        keys[i] = (uint64_t)ordered(entries[i].near) << 32 | i;
    zr_sort_u64(keys, count);
    for (uint32_t i = 0; i < count; i++)
        sorted[i] = entries[(uint32_t)keys[i]];
    memcpy(entries, sorted, count * sizeof *entries);
}

static void sort_range(void *context, size_t begin, size_t end)
{
    const struct sorting *s = context;
    for (size_t cell = begin; cell < end && !zr_is_cancelled(s->cancel); cell++) {
        const uint32_t count = s->firsts[cell + 1] - s->firsts[cell];
        if (count > ZR_CELL_UNSORTED_MOST) sort_cell(s, s->firsts[cell], count);
    }
}

static bool has_long_list(const uint32_t *firsts, size_t cells)
{
    for (size_t cell = 0; cell < cells; cell++)
        if (firsts[cell + 1] - firsts[cell] > ZR_CELL_UNSORTED_MOST) return true;
    return false;
}

/* Sorts long lists. False if the arena failed. */
static bool sort_long_lists(struct zr_arena *arena, struct zr_team *team, const struct binning *b,
                            const uint32_t *firsts)
{
    const size_t cells = (size_t)b->columns * b->rows;
    struct sorting s = {.cancel = b->cancel, .firsts = firsts, .entries = b->entries};
    if (!has_long_list(firsts, cells)) return true;
    s.sorted = zr_arena_alloc(arena, firsts[cells], sizeof *s.sorted);
    s.keys = zr_arena_alloc(arena, firsts[cells], sizeof *s.keys);
    if (!zr_arena_ok(arena)) return false;
    zr_team_ranges(team, cells, SORTED_PER_RANGE, sort_range, &s);
    return true;
}

/* Turns counts into indices of entries, cell by cell. False if there are more than 32 bits count. */
static bool sum_counts(const struct binning *b, uint32_t *firsts)
{
    const size_t cells = (size_t)b->columns * b->rows;
    uint64_t sum = 0;
    for (size_t cell = 0; cell < cells; cell++) {
        firsts[cell] = (uint32_t)sum;
        for (size_t chunk = 0; chunk < b->chunk_count; chunk++) {
            uint32_t *count = &b->counts[chunk * cells + cell];
            const uint32_t own = *count;
            *count = (uint32_t)sum;
            sum += own;
        }
    }
    firsts[cells] = (uint32_t)sum;
    return sum <= UINT32_MAX;
}

/* Returns the cells over a side of the window. */
static uint32_t cells_over(double pixels)
{
    return ((uint32_t)ceil(pixels) + 2 * ZR_WINDOW_MARGIN) / ZR_CELL_PIXELS + 1;
}

enum zr_status zr_cells_make(const struct zr_run *run, const struct zr_window_mesh *mesh, struct zr_cells *out)
{
    const uint32_t hiders = mesh->triangle_count + mesh->cut_count, chunks = hiders / HIDERS_PER_CHUNK + 1;
    struct binning b = {.mesh = mesh,
                        .cancel = run->cancel,
                        .columns = cells_over(mesh->view.width),
                        .rows = cells_over(mesh->view.height),
                        .hider_count = hiders,
                        .chunk_count = chunks < CHUNKS_MOST ? chunks : CHUNKS_MOST};
    const size_t cells = (size_t)b.columns * b.rows;
    uint32_t *firsts = zr_arena_alloc(run->arena, cells + 1, sizeof *firsts);
    b.counts = zr_arena_zero(run->arena, cells * b.chunk_count, sizeof *b.counts);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    zr_team_ranges(run->team, b.chunk_count, 1, bin_chunks, &b);
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    b.entries = sum_counts(&b, firsts) ? zr_arena_alloc(run->arena, firsts[cells], sizeof *b.entries) : NULL;
    if (!b.entries) return ZR_NO_MEMORY;
    zr_team_ranges(run->team, b.chunk_count, 1, bin_chunks, &b);
    if (!zr_is_cancelled(run->cancel) && !sort_long_lists(run->arena, run->team, &b, firsts)) return ZR_NO_MEMORY;
    *out = (struct zr_cells){.columns = b.columns, .rows = b.rows, .firsts = firsts, .entries = b.entries};
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}
