/* Symbols of the Draco bitstream, coded by range asymmetric numeral systems (Duda, arXiv:1311.2540). */
#include "input/codecs/draco_stream.h"

enum { TAGGED, RAW };
enum { BITS_LEAST = 12, BITS_MOST = 20, LENGTH_MOST = 18, SYMBOLS_MOST = 1 << LENGTH_MOST, ZEROS_PER_BYTE = 64 };

/* Symbol i has the values starts[i] .. starts[i + 1] - 1 of a state's lowest `bits` bits. */
struct code {
    const unsigned char *bytes;
    size_t left;
    uint32_t state, bits, count;
    uint32_t *starts, *lookup; /* lookup: the symbol of each value; NULL: it is searched */
    bool is_broken;
};

/* Reads the probability of a symbol, or a run of symbols with the probability 0. Returns their number. */
static uint32_t read_probability(struct zr_draco_stream *stream, uint32_t *probability)
{
    const uint32_t first = zr_draco_u8(stream), extra = first & 3;
    *probability = 0;
    if (extra == 3) return (first >> 2) + 1;
    *probability = first >> 2;
    for (uint32_t k = 0; k < extra; k++)
        *probability |= zr_draco_u8(stream) << (8 * k + 6);
    return 1;
}

static bool read_starts(struct zr_draco_stream *stream, const struct zr_cancel *cancel, struct code *code)
{
    uint32_t sum = 0, i = 0;
    while (i < code->count) {
        uint32_t probability;
        const uint32_t run = read_probability(stream, &probability);
        if (stream->is_broken || run > code->count - i || probability > (1u << code->bits) - sum) return false;
        for (uint32_t k = 0; k < run; k++)
            code->starts[i++] = sum;
        sum += probability;
        if (i % ZR_DRACO_AT_ONCE == 0 && zr_is_cancelled(cancel)) return false;
    }
    code->starts[code->count] = sum;
    return sum == 1u << code->bits;
}

static bool make_lookup(const struct zr_cancel *cancel, struct code *code)
{
    for (uint32_t i = 0; i < code->count; i++) {
        for (uint32_t k = code->starts[i]; k < code->starts[i + 1]; k++)
            code->lookup[k] = i;
        if (i % ZR_DRACO_AT_ONCE == 0 && zr_is_cancelled(cancel)) return false;
    }
    return true;
}

/* Opens a code of symbols of `length` bits, of which `wanted` will be read. */
static bool open_code(struct zr_draco_stream *stream, struct zr_arena *scratch, const struct zr_cancel *cancel,
                      uint32_t length, uint32_t wanted, struct code *code)
{
    const uint32_t bits = 3 * length / 2;
    *code = (struct code){.bits = bits < BITS_LEAST ? BITS_LEAST : bits > BITS_MOST ? BITS_MOST : bits};
    code->count = zr_draco_count(stream);
    if (code->count == 0 || code->count > SYMBOLS_MOST ||
        code->count / ZEROS_PER_BYTE > (size_t)(stream->end - stream->at))
        return false;
    code->starts = zr_arena_alloc(scratch, code->count + 1, sizeof *code->starts);
    if (!code->starts || !read_starts(stream, cancel, code)) return false;
    const uint64_t size = zr_draco_varint(stream);
    code->bytes = zr_draco_take(stream, size);
    if (!code->bytes || !zr_draco_state_open(code->bytes, (size_t)size, 4u << code->bits, &code->state, &code->left))
        return false;
    if (wanted < 1u << code->bits >> 3) return true;
    code->lookup = zr_arena_alloc(scratch, (size_t)1 << code->bits, sizeof *code->lookup);
    return code->lookup && make_lookup(cancel, code);
}

static void close_code(struct zr_arena *scratch, struct code *code)
{
    if (code->lookup) zr_arena_trim(scratch, code->lookup, (size_t)1 << code->bits, 0, sizeof *code->lookup);
    if (code->starts) zr_arena_trim(scratch, code->starts, code->count + 1, 0, sizeof *code->starts);
}

/* Returns the last symbol that starts at or before the value; symbols after it of probability 0 start later. */
static uint32_t search(const struct code *code, uint32_t value)
{
    uint32_t low = 0, high = code->count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (code->starts[middle] <= value)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static inline uint32_t next_symbol(struct code *code)
{
    while (code->state < 4u << code->bits) {
        if (code->left == 0) {
            code->is_broken = true;
            return 0;
        }
        code->state = code->state << 8 | code->bytes[--code->left];
    }
    const uint32_t rest = code->state & ((1u << code->bits) - 1);
    const uint32_t symbol = code->lookup ? code->lookup[rest] : search(code, rest), start = code->starts[symbol];
    code->state = (code->state >> code->bits) * (code->starts[symbol + 1] - start) + rest - start;
    return symbol;
}

static bool read_raw(const struct zr_cancel *cancel, struct code *code, uint32_t count, uint32_t *out)
{
    for (uint32_t i = 0; i < count && !code->is_broken; i++) {
        if (i % ZR_DRACO_AT_ONCE == 0 && zr_is_cancelled(cancel)) return false;
        out[i] = next_symbol(code);
    }
    return !code->is_broken;
}

/* Reads groups of `width` numbers; the symbol of a group is the number of bits of each. */
static bool read_tagged(struct zr_draco_stream *stream, const struct zr_cancel *cancel, struct code *code,
                        uint32_t count, uint32_t width, uint32_t *out)
{
    struct zr_draco_bits bits = {stream->at, 0, 8 * (uint64_t)(stream->end - stream->at), false};
    for (uint32_t i = 0, length = 0; i < count && !code->is_broken && !bits.is_broken; i++) {
        if (i % ZR_DRACO_AT_ONCE == 0 && zr_is_cancelled(cancel)) return false;
        if (i % width == 0) length = next_symbol(code);
        if (length > 32) return false;
        out[i] = zr_draco_bits_read(&bits, length);
    }
    zr_draco_take(stream, (bits.at + 7) / 8);
    return !code->is_broken && !bits.is_broken;
}

bool zr_draco_read_symbols(struct zr_draco_stream *stream, struct zr_arena *scratch, const struct zr_cancel *cancel,
                           uint32_t count, uint32_t width, uint32_t *out)
{
    struct code code = {.count = 0};
    if (count == 0) return true;
    const uint32_t scheme = zr_draco_u8(stream), length = scheme == RAW ? zr_draco_u8(stream) : 5;
    if (scheme > RAW || length == 0 || length > LENGTH_MOST) return false;
    const uint32_t wanted = scheme == RAW ? count : count / width;
    const bool good =
        open_code(stream, scratch, cancel, length, wanted, &code) &&
        (scheme == RAW ? read_raw(cancel, &code, count, out) : read_tagged(stream, cancel, &code, count, width, out));
    close_code(scratch, &code);
    return good;
}
