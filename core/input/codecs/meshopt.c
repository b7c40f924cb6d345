/* Bitstreams of EXT_meshopt_compression and KHR_meshopt_compression. Source: appendices A and B of the extensions. */
#include "input/codecs/meshopt.h"

#include <math.h>
#include <string.h>

/* ---- filters ---- */

static int read16(const unsigned char *at)
{
    return (int16_t)(uint16_t)(at[0] | at[1] << 8);
}

static void write16(unsigned char *at, int value)
{
    at[0] = (unsigned char)(value & 0xFF);
    at[1] = (unsigned char)(value >> 8 & 0xFF);
}

/* Returns v * most as an integer; 0 for a NaN. */
static int to_integer(float v, float most)
{
    const float value = roundf(v * most);
    if (!(value >= -most)) return value < -most ? (int)-most : 0;
    return value > most ? (int)most : (int)value;
}

/* Decodes a unit vector of two coordinates on an octahedron; v[2] stands for 1. */
static void unfold(const int v[3], float most, int out[3])
{
    const float one = (float)v[2];
    float x = (float)v[0] / one, y = (float)v[1] / one;
    const float z = 1.0f - fabsf(x) - fabsf(y), t = z < 0.0f ? z : 0.0f;
    x -= copysignf(t, x);
    y -= copysignf(t, y);
    const float length = sqrtf((x * x + y * y) + z * z);
    out[0] = to_integer(x / length, most);
    out[1] = to_integer(y / length, most);
    out[2] = to_integer(z / length, most);
}

static void filter_octahedral(unsigned char *at, uint32_t stride)
{
    int v[3], out[3];
    for (int k = 0; k < 3; k++)
        v[k] = stride == 4 ? (int8_t)at[k] : read16(at + 2 * k);
    unfold(v, stride == 4 ? 127.0f : 32767.0f, out);
    for (int k = 0; k < 3; k++)
        if (stride == 4)
            at[k] = (unsigned char)(out[k] & 0xFF);
        else
            write16(at + 2 * k, out[k]);
}

/* Decodes three components of a quaternion; the fourth is the largest. */
static void filter_quaternion(unsigned char *at)
{
    const int last = read16(at + 6), largest = last & 3;
    const float one = (float)(last | 3), range = 0.70710678118654752f;
    float v[3], rest = 1.0f;
    for (int k = 0; k < 3; k++) {
        v[k] = (float)read16(at + 2 * k) / one * range;
        rest -= v[k] * v[k];
    }
    for (int k = 0; k < 3; k++)
        write16(at + 2 * ((largest + 1 + k) % 4), to_integer(v[k], 32767.0f));
    write16(at + 2 * largest, to_integer(rest > 0.0f ? sqrtf(rest) : 0.0f, 32767.0f));
}

/* Decodes 24 bits of mantissa and 8 bits of exponent, both signed. */
static void filter_exponential(unsigned char *at)
{
    const uint32_t bits = (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16;
    const int mantissa = (int)(bits ^ 0x800000u) - 0x800000, exponent = (int8_t)at[3];
    const float value = ldexpf((float)mantissa, exponent);
    uint32_t out;
    memcpy(&out, &value, sizeof out);
    for (int k = 0; k < 4; k++)
        at[k] = (unsigned char)(out >> 8 * k & 0xFF);
}

/* Returns v * scale as an integer of 0 to `most`; 0 for a NaN. */
static int to_unsigned(int v, float scale, int most)
{
    const float value = (float)v * scale + 0.5f;
    return !(value > 0.0f) ? 0 : value >= (float)most ? most : (int)value;
}

static int component(const unsigned char *at, int k, uint32_t stride)
{
    return stride == 4 ? at[k] : at[2 * k] | at[2 * k + 1] << 8;
}

/* Decodes YCoCg and alpha. The highest bit of alpha tells the number of bits of all. */
static void filter_color(unsigned char *at, uint32_t stride)
{
    const int most = stride == 4 ? 255 : 65535, half = most / 2 + 1, alpha = component(at, 3, stride);
    const int y = component(at, 0, stride), orange = (component(at, 1, stride) ^ half) - half,
              green = (component(at, 2, stride) ^ half) - half;
    int ones = alpha;
    for (int shift = 1; shift < 16; shift *= 2)
        ones |= ones >> shift;
    const float scale = ones > 0 ? (float)most / (float)ones : 0.0f;
    const int out[4] = {y + orange - green, y + green, y - orange - green, (alpha << 1 & ones) | (alpha & 1)};
    for (int k = 0; k < 4; k++) {
        const int value = to_unsigned(out[k], scale, most);
        if (stride == 4)
            at[k] = (unsigned char)value;
        else
            write16(at + 2 * k, value);
    }
}

void zr_meshopt_filter(const struct zr_meshopt *of, unsigned char *elements, uint32_t count)
{
    unsigned char *const end = elements + (size_t)count * of->stride;
    if (of->filter == ZR_MESHOPT_OCTAHEDRAL)
        for (unsigned char *at = elements; at < end; at += of->stride)
            filter_octahedral(at, of->stride);
    else if (of->filter == ZR_MESHOPT_QUATERNION)
        for (unsigned char *at = elements; at < end; at += of->stride)
            filter_quaternion(at);
    else if (of->filter == ZR_MESHOPT_COLOR)
        for (unsigned char *at = elements; at < end; at += of->stride)
            filter_color(at, of->stride);
    else if (of->filter == ZR_MESHOPT_EXPONENTIAL)
        for (unsigned char *at = elements; at < end; at += 4)
            filter_exponential(at);
}

/* ---- streams ---- */

/* Bytes of a stream that are left to read. */
struct stream {
    const unsigned char *at, *end;
    bool ends_early;
    unsigned version; /* of the attributes: 0 or 1 */
};

/* Returns the next `count` bytes; NULL after the end. */
static const unsigned char *take(struct stream *stream, size_t count)
{
    const unsigned char *at = stream->at;
    if ((size_t)(stream->end - at) < count) {
        stream->ends_early = true;
        return NULL;
    }
    stream->at += count;
    return at;
}

static unsigned take_byte(struct stream *stream)
{
    const unsigned char *at = take(stream, 1);
    return at ? *at : 0;
}

/* Reads a number of 7 bits per byte, the lowest bits first. The last byte has no high bit. */
static uint32_t take_number(struct stream *stream)
{
    uint32_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
        const unsigned byte = take_byte(stream);
        if (shift < 32) value |= (uint32_t)(byte & 0x7F) << shift;
        if (byte < 0x80) break;
    }
    return value;
}

/* Decodes zigzag numbers: 0, -1, 1, -2 and so on. */
static uint32_t unzigzag(uint32_t v)
{
    return v & 1 ? ~(v >> 1) : v >> 1;
}

/* ---- attributes ---- */

enum { BLOCK_BYTES = 8192, BLOCK_MOST = 256, GROUP = 16, STRIDE_MOST = 256, TAIL_LEAST = 32, TAIL_LEAST_1 = 24 };

/* Reads 16 deltas of `bits` bits, from the highest bits of each byte; single bits from the lowest.
 * A delta with all bits set is a byte after them. */
static bool read_packed(struct stream *stream, unsigned bits, unsigned char deltas[GROUP])
{
    const unsigned char *packed = take(stream, GROUP * bits / 8);
    const unsigned most = (1u << bits) - 1;
    if (!packed) return false;
    for (unsigned i = 0; i < GROUP; i++) {
        const unsigned bit = i * bits % 8, value = packed[i * bits / 8] >> (bits == 1 ? bit : 8 - bits - bit) & most;
        deltas[i] = (unsigned char)(value == most ? take_byte(stream) : value);
    }
    return !stream->ends_early;
}

static bool read_group(struct stream *stream, unsigned bits, unsigned char deltas[GROUP])
{
    if (bits == 0) memset(deltas, 0, GROUP);
    if (bits < 8) return bits == 0 || read_packed(stream, bits, deltas);
    const unsigned char *bytes = take(stream, GROUP);
    if (bytes) memcpy(deltas, bytes, GROUP);
    return bytes;
}

/* Reads the deltas of one byte of `count` elements. Groups have one of four widths. */
static bool read_groups(struct stream *stream, uint32_t count, const unsigned char widths[4], unsigned char *deltas)
{
    const uint32_t groups = (count + GROUP - 1) / GROUP;
    const unsigned char *modes = take(stream, (groups + 3) / 4);
    if (!modes) return false;
    for (uint32_t group = 0; group < groups; group++)
        if (!read_group(stream, widths[modes[group / 4] >> 2 * (group % 4) & 3], deltas + group * GROUP)) return false;
    return true;
}

/* Reads the deltas by a control of version 1: 0 and 1: groups; 2: zeros; 3: bytes. */
static bool read_deltas(struct stream *stream, uint32_t count, unsigned control, unsigned char *deltas)
{
    static const unsigned char widths[] = {0, 1, 2, 4, 8}, widths_0[] = {0, 2, 4, 8};
    if (control < 2) return read_groups(stream, count, stream->version == 0 ? widths_0 : widths + control, deltas);
    const unsigned char *bytes = control == 3 ? take(stream, count) : NULL;
    if (bytes)
        memcpy(deltas, bytes, count);
    else
        memset(deltas, 0, count);
    return bytes || control == 2;
}

/* Four bytes of each element of a block. */
struct channel {
    unsigned char deltas[4][BLOCK_MOST];
    unsigned type, turn; /* type: log2 of the bytes of a number; numbers of 4 bytes are turned and added by xor */
};

static uint32_t turn_left(uint32_t v, unsigned by)
{
    return by == 0 ? v : v << by | v >> (32 - by);
}

/* Decodes the channel of `count` elements. `before`: that of the last element before; set to that of the last one. */
static void add_deltas(const struct channel *channel, uint32_t count, uint32_t stride, unsigned char before[4],
                       unsigned char *out)
{
    const unsigned bytes = 1u << channel->type;
    for (unsigned k = 0; k < 4; k += bytes) {
        uint32_t number = 0;
        for (unsigned j = 0; j < bytes; j++)
            number |= (uint32_t)before[k + j] << 8 * j;
        for (uint32_t i = 0; i < count; i++) {
            uint32_t delta = 0;
            for (unsigned j = 0; j < bytes; j++)
                delta |= (uint32_t)channel->deltas[k + j][i] << 8 * j;
            number = bytes == 4 ? number ^ turn_left(delta, channel->turn) : number + unzigzag(delta);
            for (unsigned j = 0; j < bytes; j++)
                out[(size_t)i * stride + k + j] = before[k + j] = (unsigned char)(number >> 8 * j & 0xFF);
        }
    }
}

/* Decodes `count` elements. `before` and `channels`: bytes of the last element before, and a byte per channel. */
static bool read_block(struct stream *stream, uint32_t count, uint32_t stride, unsigned char *before,
                       const unsigned char *channels, unsigned char *out)
{
    const unsigned char *controls = stream->version == 0 ? NULL : take(stream, stride / 4);
    struct channel channel = {.type = 0};
    if (stream->ends_early) return false;
    for (uint32_t k = 0; k < stride; k += 4) {
        const unsigned control = controls ? controls[k / 4] : 0, of = channels ? channels[k / 4] : 0;
        for (unsigned j = 0; j < 4; j++)
            if (!read_deltas(stream, count, control >> 2 * j & 3, channel.deltas[j])) return false;
        channel.type = of & 3;
        channel.turn = (32 - (of >> 4)) & 31;
        if (channel.type == 3) return false;
        add_deltas(&channel, count, stride, before + k, out + k);
    }
    return true;
}

static bool read_attributes(const struct zr_meshopt *of, struct stream *stream, unsigned char *out,
                            const struct zr_cancel *cancel)
{
    const uint32_t stride = of->stride, fitting = BLOCK_BYTES / stride / GROUP * GROUP,
                   most = fitting < BLOCK_MOST ? fitting : BLOCK_MOST;
    const uint32_t least = stream->version == 0 ? TAIL_LEAST : TAIL_LEAST_1,
                   used = stream->version == 0 ? stride : stride + stride / 4, tail = used < least ? least : used;
    unsigned char before[STRIDE_MOST];
    if ((size_t)(stream->end - stream->at) < tail) return false;
    const unsigned char *channels = stream->version == 0 ? NULL : stream->end - stride / 4;
    memcpy(before, stream->end - used, stride);
    stream->end -= tail;
    for (uint32_t first = 0; first < of->count; first += most) {
        const uint32_t left = of->count - first, run = left < most ? left : most;
        unsigned char *block = out + (size_t)first * stride;
        if (zr_is_cancelled(cancel) || !read_block(stream, run, stride, before, channels, block)) return false;
        zr_meshopt_filter(of, block, run);
    }
    return true;
}

/* ---- indices ---- */

/* Indices between checks for cancellation. */
enum { AT_ONCE = 3 << 12, FIFO = 16, CODES_TAIL = 16, INDICES_TAIL = 4 };

/* Writes an index. False if it needs more bytes than the stride has. */
static bool put(const struct zr_meshopt *of, unsigned char *out, uint32_t number, uint32_t index)
{
    unsigned char *at = out + (size_t)number * of->stride;
    for (uint32_t k = 0; k < of->stride; k++)
        at[k] = (unsigned char)(index >> 8 * k & 0xFF);
    return of->stride == 4 || index <= UINT16_MAX;
}

static bool read_indices(const struct zr_meshopt *of, struct stream *stream, unsigned char *out,
                         const struct zr_cancel *cancel)
{
    uint32_t last[2] = {0, 0};
    if ((size_t)(stream->end - stream->at) < INDICES_TAIL) return false;
    stream->end -= INDICES_TAIL;
    for (uint32_t i = 0; i < of->count && !stream->ends_early; i++) {
        const uint32_t value = take_number(stream);
        uint32_t *base = &last[value & 1];
        *base += unzigzag(value >> 1);
        if (!put(of, out, i, *base) || (i % AT_ONCE == 0 && zr_is_cancelled(cancel))) return false;
    }
    return true;
}

/* Recent edges and vertices, in ring buffers. `edge` and `vertex` count all entries so far, modulo 16. */
struct history {
    uint32_t edges[FIFO][2], vertices[FIFO];
    unsigned edge, vertex;
    uint32_t next, last;
};

static void push_edge(struct history *h, uint32_t a, uint32_t b)
{
    h->edges[h->edge][0] = a;
    h->edges[h->edge][1] = b;
    h->edge = (h->edge + 1) % FIFO;
}

static void push_vertex(struct history *h, uint32_t v)
{
    h->vertices[h->vertex] = v;
    h->vertex = (h->vertex + 1) % FIFO;
}

static uint32_t take_index(struct history *h, struct stream *stream)
{
    return h->last += unzigzag(take_number(stream));
}

/* Decodes a triangle of a recent edge and a third vertex. */
static void read_third(struct history *h, struct stream *stream, unsigned code, uint32_t out[3])
{
    const uint32_t *edge = h->edges[(h->edge + FIFO - 1 - (code >> 4)) % FIFO];
    const unsigned of = code & 15;
    const uint32_t a = edge[0], b = edge[1];
    uint32_t c;
    if (of == 0)
        c = h->next++;
    else if (of < 13)
        c = h->vertices[(h->vertex + FIFO - 1 - of) % FIFO];
    else if (of < 15)
        c = h->last += of == 13 ? UINT32_MAX : 1;
    else
        c = take_index(h, stream);
    push_edge(h, c, b);
    push_edge(h, a, c);
    if (of == 0 || of >= 13) push_vertex(h, c);
    out[0] = a;
    out[1] = b;
    out[2] = c;
}

/* Returns the vertex of a code. 0: the next vertex; 15: a number after the codes; others: a recent vertex. */
static uint32_t read_vertex(struct history *h, struct stream *stream, unsigned code)
{
    if (code == 0) return h->next++;
    if (code == 15) return take_index(h, stream);
    return h->vertices[(h->vertex + FIFO - code) % FIFO];
}

/* Decodes a triangle of three vertices. */
static void read_three(struct history *h, struct stream *stream, unsigned code, const unsigned char *table,
                       uint32_t out[3])
{
    const bool is_listed = (code & 15) < 14;
    const unsigned pair = is_listed ? table[code & 15] : take_byte(stream);
    const unsigned first = code == 0xFF ? 15 : 0, codes[3] = {first, pair >> 4, pair & 15};
    if (!is_listed && pair == 0) h->next = 0;
    for (int k = 0; k < 3; k++)
        out[k] = read_vertex(h, stream, codes[k]);
    push_edge(h, out[1], out[0]);
    push_edge(h, out[2], out[1]);
    push_edge(h, out[0], out[2]);
    for (int k = 0; k < 3; k++)
        if (codes[k] == 0 || codes[k] == 15) push_vertex(h, out[k]);
}

static bool read_triangles(const struct zr_meshopt *of, struct stream *stream, unsigned char *out,
                           const struct zr_cancel *cancel)
{
    struct history history = {.edge = 0};
    const unsigned char *codes = take(stream, of->count / 3);
    if (!codes || (size_t)(stream->end - stream->at) < CODES_TAIL) return false;
    stream->end -= CODES_TAIL;
    for (uint32_t i = 0; i < of->count && !stream->ends_early; i += 3) {
        const unsigned code = codes[i / 3];
        uint32_t corners[3];
        if (code < 0xF0)
            read_third(&history, stream, code, corners);
        else
            read_three(&history, stream, code, stream->end, corners);
        for (uint32_t k = 0; k < 3; k++)
            if (!put(of, out, i + k, corners[k])) return false;
        if (i % AT_ONCE == 0 && zr_is_cancelled(cancel)) return false;
    }
    return true;
}

/* ---- all modes ---- */

/* First bytes by mode; attributes of version 1 begin with ATTRIBUTES_1. */
static const unsigned headers[] = {0xA0, 0xE1, 0xD1};
enum { ATTRIBUTES_1 = 0xA1 };

static bool is_version_1(const struct zr_meshopt *of, const unsigned char *bytes, size_t size)
{
    return of->mode == ZR_MESHOPT_ATTRIBUTES && size > 0 && bytes[0] == ATTRIBUTES_1;
}

bool zr_meshopt_check(const struct zr_meshopt *of, const void *bytes, size_t size, struct zr_reason *reason)
{
    const bool has_attributes = of->mode == ZR_MESHOPT_ATTRIBUTES;
    const uint64_t most[] = {is_version_1(of, bytes, size) ? 1024 : 64, 3,
                             1}; /* attribute bytes, or indices, per byte */
    const uint64_t units = has_attributes ? (uint64_t)of->count * of->stride : of->count;
    if (has_attributes ? of->stride % 4 != 0 || of->stride == 0 || of->stride > STRIDE_MOST
                       : of->stride != 2 && of->stride != 4)
        zr_reason_give(reason, "a byteStride of %u does not fit the mode", of->stride);
    else if ((!has_attributes && of->filter != ZR_MESHOPT_NONE) ||
             ((of->filter == ZR_MESHOPT_OCTAHEDRAL || of->filter == ZR_MESHOPT_COLOR) && of->stride > 8) ||
             (of->filter == ZR_MESHOPT_QUATERNION && of->stride != 8))
        zr_reason_give(reason, "the filter does not fit the mode and a byteStride of %u", of->stride);
    else if (of->mode == ZR_MESHOPT_TRIANGLES && of->count % 3 != 0)
        zr_reason_give(reason, "%u indices, no multiple of 3", of->count);
    else if (size == 0 || units / most[of->mode] > size)
        zr_reason_give(reason, "%u elements cannot come from %zu bytes", of->count, size);
    else
        return true;
    return false;
}

bool zr_meshopt_decode(const struct zr_meshopt *of, const void *bytes, size_t size, unsigned char *out,
                       const struct zr_cancel *cancel, struct zr_reason *reason)
{
    static bool (*const read[])(const struct zr_meshopt *, struct stream *, unsigned char *,
                                const struct zr_cancel *) = {read_attributes, read_triangles, read_indices};
    struct stream stream = {bytes, (const unsigned char *)bytes + size, false, is_version_1(of, bytes, size)};
    const unsigned header = take_byte(&stream);
    if (header != headers[of->mode] && stream.version == 0)
        zr_reason_give(reason, "the compressed data begin with %02x, not %02x", header, headers[of->mode]);
    else if (!read[of->mode](of, &stream, out, cancel) || stream.ends_early)
        zr_reason_give(reason, "the compressed data are broken, at byte %zu of %zu",
                       (size_t)(stream.at - (const unsigned char *)bytes), size);
    else if (stream.at != stream.end)
        zr_reason_give(reason, "the compressed data have %zu bytes too many", (size_t)(stream.end - stream.at));
    else
        return true;
    return false;
}
