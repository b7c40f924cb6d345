/* Connected components by runs of marks in rows, joined by union-find. Bands of rows are joined by themselves, then
 * across their borders; a component and its box are the same, whatever the order. */
#include "look/edge_marks.h"

enum { BAND = 64 }; /* rows that one thread takes at once */

struct run {
    uint32_t first, last; /* columns */
    uint32_t parent;      /* itself: this is the root of its component, and the box is that of all */
    uint32_t left, right, bottom, top;
};

struct specks {
    struct zr_edge_marks *marks;
    const struct zr_cancel *cancel;
    uint32_t *row_begin; /* of each row its first run, and behind the last row their count */
    struct run *runs;
};

static const uint64_t *row_of(const struct specks *specks, size_t y)
{
    return specks->marks->creases + y * specks->marks->words;
}

static uint64_t starts(const uint64_t *row, uint32_t i)
{
    return row[i] & ~(row[i] << 1 | (i > 0 ? row[i - 1] >> 63 : 0));
}

static uint64_t ends(const uint64_t *row, uint32_t i, uint32_t words)
{
    return row[i] & ~(row[i] >> 1 | (i + 1 < words ? row[i + 1] << 63 : 0));
}

static size_t bands_of(const struct zr_edge_marks *marks)
{
    return (marks->rows + BAND - 1) / BAND;
}

static size_t end_row(const struct specks *specks, size_t band)
{
    const size_t end = band * BAND;
    return end < specks->marks->rows ? end : specks->marks->rows;
}

static void count_runs(void *context, size_t begin, size_t end)
{
    const struct specks *specks = context;
    if (zr_is_cancelled(specks->cancel)) return;
    for (size_t y = begin * BAND; y < end_row(specks, end); y++) {
        const uint64_t *row = row_of(specks, y);
        uint32_t count = 0;
        for (uint32_t i = 0; i < specks->marks->words; i++)
            if (row[i]) count += (uint32_t)__builtin_popcountll(starts(row, i));
        specks->row_begin[y] = count;
    }
}

/* Counts become places. */
static uint32_t add_up(uint32_t *row_begin, uint32_t rows)
{
    uint32_t sum = 0;
    for (uint32_t y = 0; y < rows; y++) {
        const uint32_t count = row_begin[y];
        row_begin[y] = sum;
        sum += count;
    }
    return row_begin[rows] = sum;
}

static void list_row(const struct specks *specks, size_t y)
{
    const uint32_t begin = specks->row_begin[y], end = specks->row_begin[y + 1], words = specks->marks->words;
    if (begin == end) return;
    const uint64_t *row = row_of(specks, y);
    uint32_t first = begin, last = begin;
    for (uint32_t i = 0; i < words; i++) {
        if (!row[i]) continue;
        for (uint64_t bits = starts(row, i); bits; bits &= bits - 1)
            specks->runs[first++].first = i * 64 + (uint32_t)__builtin_ctzll(bits);
        for (uint64_t bits = ends(row, i, words); bits; bits &= bits - 1)
            specks->runs[last++].last = i * 64 + (uint32_t)__builtin_ctzll(bits);
    }
    for (uint32_t i = begin; i < end; i++) {
        struct run *run = &specks->runs[i];
        *run = (struct run){run->first, run->last, i, run->first, run->last, (uint32_t)y, (uint32_t)y};
    }
}

/* Halves the way for whoever comes next. */
static uint32_t root_of(struct run *runs, uint32_t i)
{
    while (runs[i].parent != i)
        i = runs[i].parent = runs[runs[i].parent].parent;
    return i;
}

static void join_runs(struct run *runs, uint32_t a, uint32_t b)
{
    a = root_of(runs, a), b = root_of(runs, b);
    if (a == b) return;
    struct run *low = &runs[a < b ? a : b], *high = &runs[a < b ? b : a];
    high->parent = low->parent;
    if (high->left < low->left) low->left = high->left;
    if (high->right > low->right) low->right = high->right;
    if (high->bottom < low->bottom) low->bottom = high->bottom;
    if (high->top > low->top) low->top = high->top;
}

/* Runs of row y, and of the row below it: those that touch, corners included. */
static void join_rows(const struct specks *specks, size_t y)
{
    struct run *runs = specks->runs;
    uint32_t below = specks->row_begin[y - 1], own = specks->row_begin[y];
    const uint32_t below_end = own, own_end = specks->row_begin[y + 1];
    while (below < below_end && own < own_end) {
        if (runs[below].first <= runs[own].last + 1 && runs[own].first <= runs[below].last + 1)
            join_runs(runs, below, own);
        if (runs[below].last < runs[own].last)
            below++;
        else
            own++;
    }
}

static void join_band(void *context, size_t begin, size_t end)
{
    const struct specks *specks = context;
    if (zr_is_cancelled(specks->cancel)) return;
    for (size_t band = begin; band < end; band++)
        for (size_t y = band * BAND; y < end_row(specks, band + 1); y++) {
            list_row(specks, y);
            if (y > band * BAND) join_rows(specks, y);
        }
}

static bool is_speck(const struct specks *specks, uint32_t i)
{
    const struct run *runs = specks->runs;
    while (runs[i].parent != i) /* nothing is written: other threads are here, too */
        i = runs[i].parent;
    const uint32_t size = ZR_EDGE_SPECK_PIXELS * specks->marks->side;
    return runs[i].right - runs[i].left + 1 < size && runs[i].top - runs[i].bottom + 1 < size;
}

static void clear_run(uint64_t *row, uint32_t first, uint32_t last)
{
    const uint64_t from = UINT64_MAX << first % 64, to = UINT64_MAX >> (63 - last % 64);
    const uint32_t begin = first / 64, end = last / 64;
    for (uint32_t i = begin; i <= end; i++)
        row[i] &= ~((i == begin ? from : UINT64_MAX) & (i == end ? to : UINT64_MAX));
}

static void clear_specks(void *context, size_t begin, size_t end)
{
    const struct specks *specks = context;
    if (zr_is_cancelled(specks->cancel)) return;
    for (size_t y = begin * BAND; y < end_row(specks, end); y++) {
        uint64_t *row = specks->marks->creases + y * specks->marks->words;
        for (uint32_t i = specks->row_begin[y]; i < specks->row_begin[y + 1]; i++)
            if (is_speck(specks, i)) clear_run(row, specks->runs[i].first, specks->runs[i].last);
    }
}

bool zr_edge_specks_drop(struct zr_edge_marks *marks, struct zr_arena *arena, struct zr_team *team,
                         const struct zr_cancel *cancel)
{
    struct specks specks = {.marks = marks, .cancel = cancel};
    specks.row_begin = zr_arena_alloc(arena, (size_t)marks->rows + 1, sizeof *specks.row_begin);
    if (!specks.row_begin) return false;
    zr_team_ranges(team, bands_of(marks), 1, count_runs, &specks);
    if (zr_is_cancelled(cancel)) return true; /* counts may be missing */
    specks.runs = zr_arena_alloc(arena, add_up(specks.row_begin, marks->rows), sizeof *specks.runs);
    if (!specks.runs) return false;
    zr_team_ranges(team, bands_of(marks), 1, join_band, &specks);
    if (zr_is_cancelled(cancel)) return true;
    for (size_t y = BAND; y < marks->rows; y += BAND)
        join_rows(&specks, y);
    zr_team_ranges(team, bands_of(marks), 1, clear_specks, &specks);
    return true;
}
