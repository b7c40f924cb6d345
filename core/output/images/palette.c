#include "output/images/palette.h"

#include <stdlib.h>
#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "output/images/filter.h"

enum { SLOT_BITS = 11, SLOTS = 1 << SLOT_BITS, SAMPLES = 4096 };

/* Hash set of colours in memory order; open addressing, at most an eighth full. */
struct set {
    uint32_t colors[SLOTS];
    uint16_t numbers[SLOTS]; /* from 1; 0: free */
    uint16_t count;
    uint32_t kept; /* mask of a pixel's significant bits */
    uint32_t made; /* bits that are always set */
};

static inline uint32_t color_at(const struct set *set, const uint8_t *pixel)
{
    uint32_t color;
    memcpy(&color, pixel, sizeof color);
    return (color & set->kept) | set->made;
}

static inline uint32_t slot_of(const struct set *set, uint32_t color)
{
    uint32_t slot = color * 2654435761u >> (32 - SLOT_BITS);
    while (set->numbers[slot] && set->colors[slot] != color)
        slot = (slot + 1) % SLOTS;
    return slot;
}

/* Returns false if the set is full. */
static inline bool add(struct set *set, uint32_t color)
{
    uint32_t slot = slot_of(set, color);
    if (set->numbers[slot]) return true;
    if (set->count == ZR_PALETTE_MAX) return false;
    set->colors[slot] = color;
    set->numbers[slot] = ++set->count;
    return true;
}

static void set_init(struct set *set, bool opaque)
{
    static const uint8_t alpha[4] = {0, 0, 0, 255};
    memset(set, 0, sizeof *set);
    memcpy(&set->made, alpha, sizeof alpha);
    set->kept = opaque ? ~set->made : UINT32_MAX;
    set->made = opaque ? set->made : 0;
}

static inline uint8_t index_of(const struct set *set, uint32_t color)
{
    return (uint8_t)(set->numbers[slot_of(set, color)] - 1);
}

/* Adds evenly spaced pixels: this detects most pictures with too many colours, in 0.05 ms. */
static bool sample(struct set *set, const uint8_t *pixels, size_t count)
{
    size_t step = count / SAMPLES | 1;
    for (size_t i = 0; i < count; i += step)
        if (!add(set, color_at(set, pixels + 4 * i))) return false;
    return true;
}

static int by_light(const void *left, const void *right)
{
    const uint8_t *a = left, *b = right;
    int light = 2 * a[0] + 5 * a[1] + a[2] - (2 * b[0] + 5 * b[1] + b[2]);
    return light ? light : memcmp(a, b, 4);
}

/* Renumbers the colours found so far by brightness. */
static void put_in_order(struct set *set)
{
    uint8_t colors[ZR_PALETTE_MAX][4];
    size_t count = 0;
    for (size_t i = 0; i < SLOTS; i++)
        if (set->numbers[i]) memcpy(colors[count++], &set->colors[i], 4);
    qsort(colors, count, sizeof colors[0], by_light);
    for (size_t i = 0; i < count; i++) {
        uint32_t color;
        memcpy(&color, colors[i], 4);
        set->numbers[slot_of(set, color)] = (uint16_t)(i + 1);
    }
}

/* ---- indices ---- */

enum { GROUP = 16 }; /* pixels compared with their neighbours at once */

#ifdef __SSE2__
/* Returns bit i if pixel i differs from the one before it. */
static inline unsigned changes(const uint8_t *pixels)
{
    __m128i equal[4];
    for (int i = 0; i < 4; i++)
        equal[i] = _mm_cmpeq_epi32(_mm_loadu_si128((const __m128i *)(pixels + 16 * i)),
                                   _mm_loadu_si128((const __m128i *)(pixels + 16 * i - 4)));
    __m128i bytes = _mm_packs_epi16(_mm_packs_epi32(equal[0], equal[1]), _mm_packs_epi32(equal[2], equal[3]));
    return (unsigned)_mm_movemask_epi8(bytes) ^ 0xffffu;
}
#else
static inline unsigned changes(const uint8_t *pixels)
{
    unsigned bits = 0;
    for (int i = 0; i < GROUP; i++)
        bits |= (unsigned)(memcmp(pixels + 4 * i, pixels + 4 * i - 4, 4) != 0) << i;
    return bits;
}
#endif

/* Maps pixels begin .. end - 1, at least one. The index of a run is looked up at its start and written to the rest of
 * the group; later runs overwrite it. Writes up to GROUP bytes after the end. */
static bool map_span(struct set *set, const uint8_t *row, uint32_t begin, uint32_t end, uint8_t *out)
{
    uint32_t color = color_at(set, row + 4 * (size_t)begin);
    if (!add(set, color)) return false;
    uint8_t index = index_of(set, color);
    uint32_t x = begin + 1;
    out[begin] = index;
    for (; x + GROUP <= end; x += GROUP) {
        memset(out + x, index, GROUP);
        for (unsigned bits = changes(row + 4 * (size_t)x); bits; bits &= bits - 1) {
            uint32_t at = x + (uint32_t)__builtin_ctz(bits);
            color = color_at(set, row + 4 * (size_t)at);
            if (!add(set, color)) return false;
            index = index_of(set, color);
            memset(out + at, index, GROUP);
        }
    }
    for (; x < end; x++) {
        color = color_at(set, row + 4 * (size_t)x);
        if (!add(set, color)) return false;
        out[x] = index_of(set, color);
    }
    return true;
}

static bool map(struct set *set, const uint8_t *pixels, uint32_t width, uint32_t height,
                const struct zr_column_span *spans, uint8_t *indices)
{
    const size_t stride = (size_t)width * 4;
    for (uint32_t y = 0; y < height; y++) {
        const uint8_t *row = pixels + y * stride;
        uint8_t *out = indices + (size_t)y * width;
        struct zr_column_span span = zr_column_span_of_rows(spans, y, width);
        if (y > 0) span = zr_filter_span(ZR_LAYOUT_RGBA, row, row - stride, span);
        if (span.begin < span.end && !map_span(set, row, span.begin, span.end, out)) return false;
        if (y == 0) continue;
        memcpy(out, out - width, span.begin);
        memcpy(out + span.end, out + span.end - width, width - span.end);
    }
    return true;
}

bool zr_palette_make(struct zr_palette *palette, struct zr_arena *arena, const uint8_t *pixels, uint32_t width,
                     uint32_t height, const struct zr_column_span *spans, bool opaque)
{
    struct set set;
    set_init(&set, opaque);
    if (!sample(&set, pixels, (size_t)width * height)) return false;
    put_in_order(&set);
    size_t count = (size_t)width * height;
    palette->indices = zr_arena_alloc(arena, count + GROUP, 1);
    if (!palette->indices || !map(&set, pixels, width, height, spans, palette->indices)) return false;
    palette->count = set.count;
    palette->transparent = 0;
    for (size_t i = 0; i < SLOTS; i++) {
        if (!set.numbers[i]) continue;
        uint8_t *color = palette->colors[set.numbers[i] - 1];
        memcpy(color, &set.colors[i], 4);
        if (color[3] < 255 && set.numbers[i] > palette->transparent) palette->transparent = set.numbers[i];
    }
    return true;
}

uint32_t zr_palette_count(const uint8_t *pixels, size_t count, bool opaque)
{
    struct set set;
    set_init(&set, opaque);
    if (!sample(&set, pixels, count)) return ZR_PALETTE_MAX + 1;
    uint32_t last = 0; /* skips the lookup within a run of one colour */
    for (size_t i = 0; i < count; i++) {
        const uint32_t color = color_at(&set, pixels + 4 * i);
        if (i > 0 && color == last) continue;
        if (!add(&set, color)) return ZR_PALETTE_MAX + 1;
        last = color;
    }
    return set.count;
}
