/* Finds connected components as runs of marked pixels in rows, joined by union-find. Bands of rows are joined
 * separately, then across their borders; components and boxes do not depend on the order. */
#include "base/run.h"
#include "effects/edge_marks.h"

enum { BAND = 16 }; /* rows of pixels per task */

struct run {
    uint32_t first, last; /* columns of samples, multiples of whole pixels */
    uint32_t parent;      /* its own index for the root of a component; the root's box contains all runs */
    uint32_t left, right; /* box: columns of samples */
    uint32_t bottom, top; /* box: rows of pixels */
};

struct specks {
    struct zr_edge_marks *marks;
    const struct zr_cancel *cancel;
    uint32_t *row_begin; /* first run of each row; after the last row, the number of runs */
    struct run *runs;
};

/* Sets all bits of each group of `side` bits that has one set. */
static uint64_t fill_pixels(uint64_t bits, uint32_t side)
{
    static const uint64_t first_bits[] = {
        [2] = UINT64_C(0x5555555555555555), [4] = UINT64_C(0x1111111111111111), [8] = UINT64_C(0x0101010101010101)};
    if (side == 1) return bits;
    for (uint32_t i = 1; i < side; i *= 2)
        bits |= bits >> i;
    return (bits & first_bits[side]) * ((1u << side) - 1);
}

/* Returns word i of pixel row y, with each pixel as wide as its samples. Bits beyond the picture are 0. */
static uint64_t word_at(const struct specks *specks, size_t y, uint32_t i)
{
    const struct zr_edge_marks *marks = specks->marks;
    const uint64_t *samples = marks->creases + y * marks->side * marks->words + i;
    uint64_t any = 0;
    for (uint32_t row = 0; row < marks->side; row++)
        any |= samples[(size_t)row * marks->words];
    return fill_pixels(any, marks->side);
}

/* A word of a row, with the words before and after it. */
struct window {
    uint64_t before, own, behind;
};

static struct window first_window(const struct specks *specks, size_t y)
{
    return (struct window){0, 0, word_at(specks, y, 0)};
}

/* Returns the window of word i, from that of word i - 1. */
static struct window next_window(const struct specks *specks, size_t y, uint32_t i, const struct window *last)
{
    return (struct window){last->own, last->behind, i + 1 < specks->marks->words ? word_at(specks, y, i + 1) : 0};
}

static uint64_t starts(const struct window *window)
{
    return window->own & ~(window->own << 1 | window->before >> 63);
}

static uint64_t ends(const struct window *window)
{
    return window->own & ~(window->own >> 1 | window->behind << 63);
}

static size_t bands_of(const struct zr_edge_marks *marks)
{
    return (marks->height + BAND - 1) / BAND;
}

static size_t end_row(const struct specks *specks, size_t band)
{
    const size_t end = band * BAND;
    return end < specks->marks->height ? end : specks->marks->height;
}

static void count_runs(void *context, size_t begin, size_t end)
{
    const struct specks *specks = context;
    if (zr_is_cancelled(specks->cancel)) return;
    for (size_t y = begin * BAND; y < end_row(specks, end); y++) {
        struct window window = first_window(specks, y);
        uint32_t count = 0;
        for (uint32_t i = 0; i < specks->marks->words; i++) {
            window = next_window(specks, y, i, &window);
            if (window.own) count += (uint32_t)__builtin_popcountll(starts(&window));
        }
        specks->row_begin[y] = count;
    }
}

/* Replaces counts by their exclusive prefix sum. */
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
    const uint32_t begin = specks->row_begin[y], end = specks->row_begin[y + 1];
    if (begin == end) return;
    struct window window = first_window(specks, y);
    uint32_t first = begin, last = begin;
    for (uint32_t i = 0; i < specks->marks->words; i++) {
        window = next_window(specks, y, i, &window);
        for (uint64_t bits = starts(&window); bits; bits &= bits - 1)
            specks->runs[first++].first = i * 64 + (uint32_t)__builtin_ctzll(bits);
        for (uint64_t bits = ends(&window); bits; bits &= bits - 1)
            specks->runs[last++].last = i * 64 + (uint32_t)__builtin_ctzll(bits);
    }
    for (uint32_t i = begin; i < end; i++) {
        struct run *run = &specks->runs[i];
        *run = (struct run){run->first, run->last, i, run->first, run->last, (uint32_t)y, (uint32_t)y};
    }
}

/* Returns the root of a run, halving the path to it for later searches. */
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

/* Joins the runs of row y with those of the row below that touch them, corners included. */
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
    while (runs[i].parent != i) /* no path halving: other threads read the runs */
        i = runs[i].parent;
    const uint32_t across = runs[i].right / specks->marks->side - runs[i].left / specks->marks->side;
    const uint32_t least = specks->marks->speck_pixels;
    return across < least && runs[i].top - runs[i].bottom < least;
}

static void clear_run(const struct zr_edge_marks *marks, size_t y, const struct run *run)
{
    const uint64_t from = UINT64_MAX << run->first % 64, to = UINT64_MAX >> (63 - run->last % 64);
    const uint32_t begin = run->first / 64, end = run->last / 64;
    for (uint32_t k = 0; k < marks->side; k++) {
        uint64_t *row = marks->creases + (y * marks->side + k) * marks->words;
        for (uint32_t i = begin; i <= end; i++)
            row[i] &= ~((i == begin ? from : UINT64_MAX) & (i == end ? to : UINT64_MAX));
    }
}

static void clear_specks(void *context, size_t begin, size_t end)
{
    const struct specks *specks = context;
    if (zr_is_cancelled(specks->cancel)) return;
    for (size_t y = begin * BAND; y < end_row(specks, end); y++)
        for (uint32_t i = specks->row_begin[y]; i < specks->row_begin[y + 1]; i++)
            if (is_speck(specks, i)) clear_run(specks->marks, y, &specks->runs[i]);
}

bool zr_edge_specks_drop(const struct zr_run *run, struct zr_edge_marks *marks)
{
    struct specks specks = {.marks = marks, .cancel = run->cancel};
    specks.row_begin = zr_arena_alloc(run->arena, (size_t)marks->height + 1, sizeof *specks.row_begin);
    if (!specks.row_begin) return false;
    zr_team_ranges(run->team, bands_of(marks), 1, count_runs, &specks);
    if (zr_is_cancelled(run->cancel)) return true; /* counts are incomplete */
    specks.runs = zr_arena_alloc(run->arena, add_up(specks.row_begin, marks->height), sizeof *specks.runs);
    if (!specks.runs) return false;
    zr_team_ranges(run->team, bands_of(marks), 1, join_band, &specks);
    if (zr_is_cancelled(run->cancel)) return true;
    for (size_t y = BAND; y < marks->height; y += BAND)
        join_rows(&specks, y);
    zr_team_ranges(run->team, bands_of(marks), 1, clear_specks, &specks);
    return true;
}
