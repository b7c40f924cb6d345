#include "output/matcher.h"

#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

/* Loops are copied for each layout, so that the size of a pixel is a constant in them: 5 times as fast. */
#define INLINE static inline __attribute__((always_inline))

enum {
    PLACE_PIXEL_BITS = 20,
    STRING_MIN = 6 /* bytes; shorter ones cost what they spare */,
    LOOKED_AT = 32,
    MARGIN = 64
};

_Static_assert(ZR_MATCHER_WIDTH_MAX == 1 << PLACE_PIXEL_BITS, "a pixel's number must fit its bits");

/* The first byte lowest on every machine: its hash decides what is found. */
INLINE uint64_t load64(const uint8_t *at)
{
    uint64_t value;
    memcpy(&value, at, sizeof value);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    value = __builtin_bswap64(value);
#endif
    return value;
}

/* ---- memory ---- */

static size_t tokens_a_row(uint32_t width)
{
    return 2 * (size_t)width + 8;
}

bool zr_matcher_init(struct zr_matcher *m, struct zr_arena *arena, enum zr_layout layout, uint32_t width)
{
    size_t row_bytes = (size_t)width * zr_layout_file(layout) + 1;
    *m = (struct zr_matcher){.layout = layout, .width = width};
    m->stride = (size_t)width * zr_layout_memory(layout) + MARGIN + ZR_FILTER_PADDING;
    m->ring_rows = (uint32_t)(ZR_DISTANCE_MAX / row_bytes + 2);
    if (m->ring_rows > ZR_MATCHER_ROWS_MAX) m->ring_rows = ZR_MATCHER_ROWS_MAX;
    m->ring = zr_arena_zero(arena, m->ring_rows, m->stride);
    m->offsets = zr_arena_zero(arena, ZR_MATCHER_ROWS_MAX + 1, sizeof *m->offsets);
    m->places = zr_arena_alloc(arena, (size_t)1 << ZR_MATCHER_HASH_BITS, sizeof *m->places);
    m->starts = zr_arena_alloc(arena, (size_t)width + 1, sizeof *m->starts);
    m->listed = zr_arena_alloc(arena, width, sizeof *m->listed);
    m->strings = zr_arena_alloc(arena, width, sizeof *m->strings);
    m->tokens.room = ZR_MATCHER_BLOCK_MIN + tokens_a_row(width);
    m->tokens.at = zr_arena_alloc(arena, m->tokens.room, sizeof *m->tokens.at);
    zr_lengths_init(&m->tokens.lengths);
    return zr_arena_ok(arena);
}

void zr_matcher_begin(struct zr_matcher *m)
{
    m->row = m->kept = 0;
    m->tokens.count = 0;
    memset(m->places, 0, sizeof *m->places << ZR_MATCHER_HASH_BITS);
}

/* ---- runs, and strings ---- */

/* Where runs begin in the span, and behind them its end. Returns how many. */
INLINE size_t find_runs(enum zr_layout layout, const uint8_t *pixels, struct zr_span span, uint32_t *starts)
{
    size_t count = 0;
    for (uint32_t x = span.begin; x < span.end; x += 64) {
        uint64_t changes = zr_filter_changes(layout, pixels + (size_t)x * zr_layout_memory(layout));
        if (x == span.begin) changes |= 1;
        if (span.end - x < 64) changes &= ((uint64_t)1 << (span.end - x)) - 1;
        for (; changes; changes &= changes - 1)
            starts[count++] = x + (uint32_t)__builtin_ctzll(changes);
    }
    starts[count] = span.end;
    return count;
}

/* How many of LOOKED_AT bytes are equal, from the first on. Without a branch, which would be guessed wrong as often as
 * not: that is what makes this 2 ms a picture faster. */
INLINE unsigned common_bytes(const uint8_t *a, const uint8_t *b)
{
#ifdef __SSE2__
    uint64_t equal = 0;
    for (int i = 0; i < LOOKED_AT; i += 16) {
        __m128i left = _mm_loadu_si128((const __m128i *)(a + i)), right = _mm_loadu_si128((const __m128i *)(b + i));
        equal |= (uint64_t)(unsigned)_mm_movemask_epi8(_mm_cmpeq_epi8(left, right)) << i;
    }
    return (unsigned)__builtin_ctzll(~equal);
#else
    unsigned common = LOOKED_AT;
    for (int i = LOOKED_AT - 8; i >= 0; i -= 8) {
        uint64_t difference = load64(a + i) ^ load64(b + i);
        common = difference ? (unsigned)i + (unsigned)__builtin_ctzll(difference) / 8 : common;
    }
    return common;
#endif
}

INLINE bool is_zero(enum zr_layout layout, const uint8_t *pixel)
{
    uint32_t value = 0;
    memcpy(&value, pixel, zr_layout_memory(layout));
    return value == 0;
}

/* Runs that are not of zeros. Returns how many. Without a branch. */
INLINE size_t list_runs(enum zr_layout layout, const uint8_t *pixels, size_t count, struct zr_matcher *m)
{
    size_t listed = 0;
    for (size_t i = 0; i < count; i++) {
        m->listed[listed] = (uint32_t)i;
        listed += !is_zero(layout, pixels + (size_t)m->starts[i] * zr_layout_memory(layout));
    }
    return listed;
}

/* For each run that is not of zeros: the string that began the same way when it was last seen, up to LOOKED_AT bytes.
 * Everything in registers and no branch: a wrong guess costs as much as all the rest of a step. */
INLINE void find_strings(enum zr_layout layout, struct zr_matcher *m, const uint8_t *pixels, size_t count)
{
    const unsigned memory = zr_layout_memory(layout), file = zr_layout_file(layout);
    const int32_t row_bytes = (int32_t)(m->width * file + 1);
    const uint32_t width = m->width, row = m->row;
    const uint8_t *const ring = m->ring;
    const uint32_t *const offsets = m->offsets, *const starts = m->starts, *const listed = m->listed;
    uint32_t *const places = m->places;
    struct zr_string *const strings = m->strings;
    size_t listed_count = list_runs(layout, pixels, count, m);
    for (size_t k = 0; k < listed_count; k++) {
        uint32_t i = listed[k], x = starts[i];
        const uint8_t *at = pixels + (size_t)x * memory;
        uint64_t key = load64(at);
        if (memory < 4) key <<= 16; /* six bytes, as two pixels of RGB */
        uint32_t *slot = &places[key * 0x9E3779B97F4A7C15u >> (64 - ZR_MATCHER_HASH_BITS)];
        uint32_t place = *slot, place_row = place >> PLACE_PIXEL_BITS, place_x = place & (ZR_MATCHER_WIDTH_MAX - 1);
        *slot = row << PLACE_PIXEL_BITS | x;
        const uint8_t *before = ring + offsets[place_row] + (size_t)place_x * memory;
        /* Rows are at most 2^22 bytes; of many, 2^10 of them, they are shorter than 2^15. */
        int64_t distance = (int64_t)(row - place_row) * row_bytes + ((int64_t)x - place_x) * file;
        uint32_t size = common_bytes(at, before) / memory, most = width - (x > place_x ? x : place_x);
        size = size < most ? size : most;
        unsigned good = (place != 0) & (distance <= ZR_DISTANCE_MAX) & (size * file >= STRING_MIN);
        strings[i] = (struct zr_string){(uint16_t)(distance - 1), (uint16_t)(size * good)};
    }
}

/* The whole of a string that is longer than what was looked at. */
INLINE size_t whole_string(enum zr_layout layout, const struct zr_matcher *m, const uint8_t *pixels, uint32_t x,
                           struct zr_string string)
{
    const unsigned memory = zr_layout_memory(layout), file = zr_layout_file(layout);
    size_t size = string.pixels, row_bytes = (size_t)m->width * file + 1, distance = string.distance + (size_t)1;
    if (size * memory < LOOKED_AT) return size;
    /* Where it is: so many rows up, so many pixels to the left, or to the right. */
    size_t here = (size_t)(m->row - 1) * row_bytes + 1 + (size_t)x * file, there = here - distance;
    uint32_t row = (uint32_t)(there / row_bytes), before_x = (uint32_t)((there % row_bytes - 1) / file);
    const uint8_t *before = m->ring + m->offsets[row + 1] + (size_t)before_x * memory,
                  *at = pixels + (size_t)x * memory;
    size_t most = m->width - (x > before_x ? x : before_x);
    unsigned more = LOOKED_AT;
    while (size < most && more == LOOKED_AT) {
        more = common_bytes(at + size * memory, before + size * memory);
        size += more / memory;
    }
    return size < most ? size : most;
}

/* ---- decisions ---- */

INLINE bool ends_in_zero(enum zr_layout layout, const uint8_t *next)
{
    return layout == ZR_LAYOUT_RGB ? next[-2] == 0 : next[-1] == 0;
}

/* Zeros, spelled out where the byte before them is none: a match needs something to repeat. */
INLINE void push_zeros(struct zr_tokens *tokens, size_t size, bool after_zero)
{
    uint64_t first = after_zero ? ZR_TOKEN_NO_SYMBOL : 0;
    size -= !after_zero;
    if (size > ZR_MATCH_MAX) {
        if (!after_zero) zr_tokens_push(tokens, zr_token_symbols(0, 287, 287, 287));
        zr_tokens_match(tokens, size, 1);
        return;
    }
    uint64_t none = ZR_TOKEN_NO_SYMBOL;
    uint64_t spelled = zr_token_symbols(first, size > 0 ? 0 : none, size > 1 ? 0 : none, none);
    uint64_t matched = first | none << 9 | none << 18 | tokens->lengths.parts[size]; /* distance 1 is symbol 0 */
    zr_tokens_push(tokens, size < ZR_MATCH_MIN ? spelled : matched);
}

/* The symbols of one pixel, from the first on. */
INLINE uint64_t spell(enum zr_layout layout, const uint8_t *pixel)
{
    uint64_t none = ZR_TOKEN_NO_SYMBOL, b[4] = {none, none, none, none};
    for (unsigned i = 0; i < zr_layout_file(layout); i++)
        b[i] = pixel[i];
    return zr_token_symbols(b[0], b[1], b[2], b[3]);
}

/* `size` pixels more of what the last one is, or if `fresh` the first of them spelled out. */
INLINE void push_run(enum zr_layout layout, struct zr_tokens *tokens, const uint8_t *pixel, size_t size, bool fresh)
{
    const unsigned file = zr_layout_file(layout);
    const uint64_t none = ZR_TOKEN_NO_SYMBOL, no_distance = (uint64_t)ZR_TOKEN_NO_DISTANCE << 36;
    if (fresh) size--;
    size_t rest = size * file;
    if (rest < ZR_MATCH_MIN) { /* of two bytes a pixel one more, of one two */
        if (fresh) zr_tokens_push(tokens, spell(layout, pixel));
        for (; size > 0; size--)
            zr_tokens_push(tokens, spell(layout, pixel));
    } else if (rest > ZR_MATCH_MAX || !fresh || layout == ZR_LAYOUT_RGBA) {
        if (fresh) zr_tokens_push(tokens, spell(layout, pixel));
        zr_tokens_match(tokens, rest, file);
    } else {
        uint64_t first = spell(layout, pixel) & ~(none << 27 | no_distance);
        zr_tokens_push(tokens, first | tokens->lengths.parts[rest] | (uint64_t)(file - 1) << 36);
    }
}

INLINE void push_runs(enum zr_layout layout, struct zr_matcher *m, const uint8_t *pixels, size_t count)
{
    const unsigned memory = zr_layout_memory(layout), file = zr_layout_file(layout);
    struct zr_tokens *tokens = &m->tokens;
    const uint32_t *const starts = m->starts;
    const struct zr_string *const strings = m->strings;
    uint32_t x = starts[0], end = starts[count];
    for (size_t i = 0; i < count;) {
        const uint8_t *pixel = pixels + (size_t)x * memory;
        uint32_t size = starts[i + 1] - x;
        bool fresh = x == starts[i];
        bool zero = is_zero(layout, pixel);
        if (fresh && !zero && strings[i].pixels > size) {
            size_t whole = whole_string(layout, m, pixels, x, strings[i]);
            zr_tokens_match(tokens, whole * file, strings[i].distance + 1u);
            x += (uint32_t)whole;
            while (i < count && starts[i + 1] <= x)
                i++;
            continue;
        }
        if (zero)
            push_zeros(tokens, (size_t)size * file, ends_in_zero(layout, pixel));
        else
            push_run(layout, tokens, pixel, size, fresh);
        x = starts[++i];
    }
    if (x < end) x = end;
    if (x < m->width)
        push_zeros(tokens, (size_t)(m->width - x) * file, ends_in_zero(layout, pixels + (size_t)x * memory));
}

/* ---- rows ---- */

/* Room for the differences, with a pixel before the first that ends as the filter byte does. */
static uint8_t *keep_row(struct zr_matcher *m, struct zr_span span)
{
    const unsigned memory = zr_layout_memory(m->layout);
    size_t offset = (m->kept++ % m->ring_rows) * m->stride + MARGIN;
    uint8_t *pixels = m->ring + offset;
    m->offsets[m->row] = (uint32_t)offset;
    memset(pixels - memory, ZR_FILTER_UP, memory);
    memset(pixels, 0, (size_t)span.begin * memory);
    memset(pixels + (size_t)span.end * memory, 0, (size_t)(m->width - span.end) * memory + ZR_FILTER_PADDING);
    return pixels;
}

INLINE void match_row(enum zr_layout layout, struct zr_matcher *m, const uint8_t *pixels, struct zr_span span)
{
    size_t count = find_runs(layout, pixels, span, m->starts);
    find_strings(layout, m, pixels, count);
    push_runs(layout, m, pixels, count);
}

bool zr_matcher_row(struct zr_matcher *m, const uint8_t *row, const uint8_t *above, struct zr_adler *sum)
{
    const size_t file = zr_layout_file(m->layout);
    struct zr_tokens *tokens = &m->tokens;
    if (tokens->room - tokens->count < tokens_a_row(m->width)) return false;
    struct zr_span span = zr_filter_span(m->layout, row, above, m->width);
    m->row++;
    zr_tokens_push(tokens, zr_token_symbols(ZR_FILTER_UP, 287, 287, 287));
    zr_adler_add(sum, 1, ZR_FILTER_UP, ZR_FILTER_UP);
    zr_adler_add(sum, span.begin * file, 0, 0);
    if (span.begin > 0) push_zeros(tokens, span.begin * file, false);
    if (span.begin == span.end) return true;
    uint8_t *pixels = keep_row(m, span);
    zr_filter_row(m->layout, row, above, span, pixels, sum);
    zr_adler_add(sum, (m->width - span.end) * file, 0, 0);
    switch (m->layout) { /* a copy of the loops for each, so that sizes of pixels are constants */
    case ZR_LAYOUT_8:
        match_row(ZR_LAYOUT_8, m, pixels, span);
        break;
    case ZR_LAYOUT_16:
        match_row(ZR_LAYOUT_16, m, pixels, span);
        break;
    case ZR_LAYOUT_RGB:
        match_row(ZR_LAYOUT_RGB, m, pixels, span);
        break;
    default:
        match_row(ZR_LAYOUT_RGBA, m, pixels, span);
    }
    return true;
}
