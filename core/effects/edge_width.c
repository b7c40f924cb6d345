/* Marks are widened by a disc, word by word. A row grows sideways in steps, from the disc's top to its middle. At each
 * height of the disc, the row is added to the rows at that distance above and below. Then samples are counted per
 * pixel, for all pixels of a word at once. */
#include "base/run.h"
#include "effects/edge_marks.h"

enum { CHUNK = 64 }; /* least rows of samples per task */

enum { SILHOUETTES, CREASES, PLANES };

/* Scratch of one thread. */
struct room {
    uint64_t *covered[PLANES]; /* rows of a chunk */
    uint64_t *grown[2];        /* one row, with a word before and after it */
};

struct width {
    const struct zr_edge_marks *marks;
    const struct zr_cancel *cancel;
    uint32_t radius;      /* of the disc, in samples, rounded down */
    uint32_t *half_width; /* of the disc at 0 .. radius rows from its middle */
    uint32_t pixel_rows;  /* per chunk */
    struct room *rooms;   /* one per worker */
    float *opacity;
};

/* ---- the disc ---- */

static bool make_disc(struct width *width, struct zr_arena *arena)
{
    const struct zr_edge_marks *marks = width->marks;
    /* Marks are two samples wide already; each extends half a sample beyond a sample centre. */
    const float wanted = 0.5f * marks->line_width * (float)marks->side - 0.5f;
    const float radius = wanted > 0.0f ? wanted : 0.0f, square = radius * radius;
    const uint32_t most = marks->rows > marks->columns ? marks->rows : marks->columns;
    width->radius = radius < (float)most ? (uint32_t)radius : most;
    width->half_width = zr_arena_alloc(arena, (size_t)width->radius + 1, sizeof *width->half_width);
    if (!width->half_width) return false;
    uint32_t half = 0;
    for (uint32_t y = width->radius + 1; y-- > 0; width->half_width[y] = half)
        while (half < width->radius && (float)(half + 1) * (float)(half + 1) + (float)y * (float)y <= square)
            half++;
    return true;
}

/* ---- widening ---- */

/* Extends every mark by `gap` < 64 to both sides. Reads words begin - 1 to end. */
static void grow_step(const uint64_t *in, uint32_t begin, uint32_t end, uint32_t gap, uint64_t *out)
{
    for (ptrdiff_t i = (ptrdiff_t)begin; i < (ptrdiff_t)end; i++)
        out[i] = in[i] | in[i] << gap | in[i - 1] >> (64 - gap) | in[i] >> gap | in[i + 1] << (64 - gap);
}

/* A row while it grows. */
struct growth {
    uint32_t begin, end; /* words that the grown marks can touch */
    uint32_t half;       /* current growth to either side, samples */
    uint64_t *row, *spare;
};

/* Returns false if the row has no marks. */
static bool begin_growth(const struct width *width, const struct room *room, const uint64_t *marks,
                         struct growth *growth)
{
    const uint32_t words = width->marks->words, margin = width->radius / 64 + 1;
    uint32_t begin = 0, end = words;
    while (begin < end && !marks[begin])
        begin++;
    if (begin == end) return false;
    while (!marks[end - 1])
        end--;
    begin = begin > margin ? begin - margin : 0;
    end = words - end > margin ? end + margin : words;
    *growth = (struct growth){begin, end, 0, room->grown[0] + 1, room->grown[1] + 1};
    memcpy(growth->row + begin, marks + begin, (end - begin) * sizeof *marks);
    growth->row[(ptrdiff_t)begin - 1] = growth->spare[(ptrdiff_t)begin - 1] = 0;
    growth->row[end] = growth->spare[end] = 0;
    return true;
}

/* Grows by steps of at most the current width of a mark, so that no gaps remain. */
static void grow_to(struct growth *growth, uint32_t half)
{
    while (growth->half < half) {
        uint32_t gap = half - growth->half;
        if (gap > 2 * growth->half + 1) gap = 2 * growth->half + 1;
        if (gap > 63) gap = 63;
        grow_step(growth->row, growth->begin, growth->end, gap, growth->spare);
        uint64_t *const grown = growth->spare;
        growth->spare = growth->row;
        growth->row = grown;
        growth->half += gap;
    }
}

static void add_row(const struct growth *growth, uint64_t *covered)
{
    for (uint32_t i = growth->begin; i < growth->end; i++)
        covered[i] |= growth->row[i];
}

/* Adds the discs around the marks of row y to rows begin .. end - 1; `covered` points to the first of these. */
static void widen_row(const struct width *width, const struct room *room, const uint64_t *marks, uint32_t y,
                      uint32_t begin, uint32_t end, uint64_t *covered)
{
    const uint32_t words = width->marks->words, nearest = y < begin ? begin - y : y >= end ? y - (end - 1) : 0;
    struct growth growth;
    if (!begin_growth(width, room, marks + (size_t)y * words, &growth)) return;
    for (uint32_t away = width->radius + 1; away-- > nearest;) {
        grow_to(&growth, width->half_width[away]);
        if (y + away >= begin && y + away < end) add_row(&growth, covered + (size_t)(y + away - begin) * words);
        if (away > 0 && y >= begin + away && y - away < end)
            add_row(&growth, covered + (size_t)(y - away - begin) * words);
    }
}

static void widen(const struct width *width, const struct room *room, const uint64_t *marks, uint32_t begin,
                  uint32_t end, uint64_t *covered)
{
    const uint32_t rows = width->marks->rows, radius = width->radius;
    memset(covered, 0, (size_t)(end - begin) * width->marks->words * sizeof *covered);
    const uint32_t first = begin > radius ? begin - radius : 0, last = rows - end > radius ? end + radius : rows;
    for (uint32_t y = first; y < last; y++)
        widen_row(width, room, marks, y, begin, end, covered);
}

/* ---- counting ---- */

#define EACH_BYTE UINT64_C(0x0101010101010101)

/* Replaces each group of `side` bits by the number of its set bits. */
static uint64_t count_bits(uint64_t bits, uint32_t side)
{
    if (side >= 2) bits -= bits >> 1 & 0x55 * EACH_BYTE;
    if (side >= 4) bits = (bits & 0x33 * EACH_BYTE) + (bits >> 2 & 0x33 * EACH_BYTE);
    if (side >= 8) bits = (bits + (bits >> 4)) & 0x0f * EACH_BYTE;
    return bits;
}

/* Counts of a word's pixels: pixel i has byte i / per_byte of counts[i % per_byte]. */
struct counts {
    uint64_t counts[8];
};

static void add_counts(uint64_t bits, uint32_t side, struct counts *sum)
{
    const uint64_t counted = count_bits(bits, side), mask = ((1u << side) - 1) * EACH_BYTE;
    for (uint32_t k = 0; k < 8 / side; k++)
        sum->counts[k] += counted >> k * side & mask;
}

static uint32_t count_of(const struct counts *sum, uint32_t pixel, uint32_t per_byte)
{
    return (uint32_t)(sum->counts[pixel % per_byte] >> pixel / per_byte * 8 & 0xff);
}

/* Writes the opacity of a word's pixels. The arguments point to their lowest row of samples. */
static void cover_word(const struct zr_edge_marks *marks, const uint64_t *silhouettes, const uint64_t *creases,
                       uint32_t pixels, float *opacity)
{
    const uint32_t words = marks->words, side = marks->side;
    struct counts dark = {{0}}, light = {{0}};
    uint64_t any = 0;
    for (size_t y = 0; y < side; y++)
        any |= silhouettes[y * words] | creases[y * words];
    if (!any) {
        memset(opacity, 0, pixels * sizeof *opacity);
        return;
    }
    for (size_t y = 0; y < side; y++) {
        add_counts(silhouettes[y * words], side, &dark);
        add_counts(creases[y * words] & ~silhouettes[y * words], side, &light);
    }
    const float share = 1.0f / (float)(side * side);
    for (uint32_t i = 0; i < pixels; i++)
        opacity[i] = (marks->silhouette_opacity * (float)count_of(&dark, i, 8 / side) +
                      marks->crease_opacity * (float)count_of(&light, i, 8 / side)) *
                     share;
}

static void cover_chunk(void *context, int worker, size_t begin, size_t end)
{
    const struct width *width = context;
    const struct zr_edge_marks *marks = width->marks;
    const struct room *room = &width->rooms[worker];
    const uint32_t side = marks->side, pixels = 64 / side;
    if (zr_is_cancelled(width->cancel)) return;
    const uint32_t low = (uint32_t)begin * side, high = (uint32_t)end * side;
    widen(width, room, marks->silhouettes, low, high, room->covered[SILHOUETTES]);
    widen(width, room, marks->creases, low, high, room->covered[CREASES]);
    for (size_t y = begin; y < end; y++)
        for (uint32_t i = 0; i < marks->words; i++) {
            const size_t at = (y - begin) * side * marks->words + i;
            const uint32_t x = i * pixels, left = marks->width - x;
            cover_word(marks, room->covered[SILHOUETTES] + at, room->covered[CREASES] + at,
                       left < pixels ? left : pixels, width->opacity + y * marks->width + x);
        }
}

static bool make_rooms(struct width *width, struct zr_arena *arena, size_t workers)
{
    const struct zr_edge_marks *marks = width->marks;
    width->rooms = zr_arena_alloc(arena, workers, sizeof *width->rooms);
    if (!width->rooms) return false;
    for (size_t i = 0; i < workers; i++)
        for (int k = 0; k < 2; k++) {
            struct room *room = &width->rooms[i];
            room->covered[k] = zr_arena_alloc(arena, (size_t)width->pixel_rows * marks->side * marks->words, 8);
            room->grown[k] = zr_arena_alloc(arena, (size_t)marks->words + 2, 8);
        }
    return zr_arena_ok(arena);
}

bool zr_edge_width_cover(const struct zr_run *run, const struct zr_edge_marks *marks, float *opacity)
{
    struct width width = {.marks = marks, .cancel = run->cancel, .opacity = opacity};
    if (!make_disc(&width, run->arena)) return false;
    /* Rows beside a chunk are widened again for it; this chunk size keeps them fewer than its own. */
    const uint32_t rows = 2 * width.radius > CHUNK ? 2 * width.radius : CHUNK;
    width.pixel_rows = rows / marks->side < marks->height ? rows / marks->side : marks->height;
    const size_t chunks = (marks->height + width.pixel_rows - 1) / width.pixel_rows;
    const size_t threads = (size_t)zr_team_size(run->team);
    if (!make_rooms(&width, run->arena, threads < chunks ? threads : chunks)) return false;
    zr_team_shares(run->team, marks->height, width.pixel_rows, cover_chunk, &width);
    return true;
}
