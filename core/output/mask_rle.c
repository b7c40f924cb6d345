#include "output/mask_rle.h"

enum { COLUMNS = 64 };

/* Runs written so far. An edge is a pixel that differs from the one before it, in the order of columns. */
struct runs {
    struct zr_buffer *out;
    uint64_t edge;   /* the last one, not yet written */
    bool has_edge;   /* else there is none */
    uint64_t begin;  /* of the run that ends at the edge */
    int64_t last[2]; /* the last two runs, the later one first */
    uint32_t count;
};

static void put_number(struct zr_buffer *out, int64_t value)
{
    bool has_more = true;
    while (has_more) {
        uint8_t group = value & 31;
        value = (value - group) / 32;
        has_more = group & 16 ? value != -1 : value != 0;
        group = (uint8_t)(48 + (has_more ? group | 32 : group));
        zr_buffer_add(out, &group, 1);
    }
}

static void put_run(struct runs *runs, uint64_t length)
{
    put_number(runs->out, (int64_t)length - (runs->count > 2 ? runs->last[1] : 0));
    runs->last[1] = runs->last[0];
    runs->last[0] = (int64_t)length;
    runs->count++;
}

static void flush_edge(struct runs *runs)
{
    if (!runs->has_edge) return;
    put_run(runs, runs->edge - runs->begin);
    runs->begin = runs->edge;
    runs->has_edge = false;
}

/* Two edges at one place are none: the end of a column meets the beginning of the next. */
static void add_edge(struct runs *runs, uint64_t at)
{
    if (runs->has_edge && runs->edge == at) {
        runs->has_edge = false;
        return;
    }
    flush_edge(runs);
    runs->edge = at;
    runs->has_edge = true;
}

/* Lists the rows of the edges of each column of a word. */
static void find_edges(const struct zr_bit_mask *mask, uint32_t word, size_t room, uint32_t *edges,
                       uint32_t counts[COLUMNS])
{
    uint64_t above = 0;
    for (uint32_t y = mask->top; y <= mask->bottom; y++) {
        const uint64_t bits = y < mask->bottom ? zr_bit_mask_row(mask, y)[word] : 0;
        for (uint64_t changed = bits ^ above; changed != 0; changed &= changed - 1) {
            const uint32_t column = (uint32_t)__builtin_ctzll(changed);
            edges[column * room + counts[column]++] = y;
        }
        above = bits;
    }
}

bool zr_mask_rle_write(const struct zr_bit_mask *mask, uint32_t *edges, struct zr_buffer *out)
{
    const size_t room = (size_t)(mask->bottom - mask->top) + 1;
    const uint64_t pixels = (uint64_t)mask->width * mask->height;
    struct runs runs = {.out = out};
    for (uint32_t word = 0; word < mask->words; word++) {
        uint32_t counts[COLUMNS] = {0};
        find_edges(mask, word, room, edges, counts);
        for (uint32_t column = 0; column < COLUMNS; column++)
            for (uint32_t i = 0; i < counts[column]; i++)
                add_edge(&runs, (uint64_t)(mask->left + 64 * word + column) * mask->height + edges[column * room + i]);
    }
    if (runs.has_edge && runs.edge == pixels) runs.has_edge = false;
    flush_edge(&runs);
    put_run(&runs, pixels - runs.begin);
    return zr_arena_ok(out->arena);
}
