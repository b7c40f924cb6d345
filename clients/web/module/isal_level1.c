/* isal_level1.c - the match search of ISA-L's level 1, in C: the same streams as those of its x86 assembler code.
 *
 * The C code of ISA-L selects other matches than its x86 code: PNG files would differ from those of the command. The
 * module is built with this file in place of the C code.
 *
 * Source: ISA-L 2.30 and 2.31, igzip_icf_body_h1_gr_bt.asm and igzip_icf_finish.asm, whose order of reads and writes of
 *         the hash table it repeats. Copyright 2011-2016 Intel Corporation, BSD 3-clause licence.
 * Other:  a stream's third byte has its own hash (core/output/images/idat.h tells of the fault).
 * Check:  `make wasm-test` compares PNG files of the module and of the command.
 *
 * Redistribution and use in source and binary forms, with or without modification, are permitted provided that the
 * following conditions are met:
 * - Redistributions of source code must retain the above copyright notice, this list of conditions and the following
 *   disclaimer.
 * - Redistributions in binary form must reproduce the above copyright notice, this list of conditions and the following
 *   disclaimer in the documentation and/or other materials provided with the distribution.
 * - Neither the name of Intel Corporation nor the names of its contributors may be used to endorse or promote products
 *   derived from this software without specific prior written permission.
 * THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS AND CONTRIBUTORS "AS IS" AND ANY EXPRESS OR IMPLIED WARRANTIES,
 * INCLUDING, BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE ARE
 * DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT OWNER OR CONTRIBUTORS BE LIABLE FOR ANY DIRECT, INDIRECT, INCIDENTAL,
 * SPECIAL, EXEMPLARY, OR CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR
 * SERVICES; LOSS OF USE, DATA, OR PROFITS; OR BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY,
 * WHETHER IN CONTRACT, STRICT LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY WAY OUT OF THE USE
 * OF THIS SOFTWARE, EVEN IF ADVISED OF THE POSSIBILITY OF SUCH DAMAGE. */
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include <encode_df.h>
#include <huffman.h>
#include <igzip_level_buf_structs.h>
#include <igzip_lib.h>

void isal_deflate_icf_body_hash_hist_base(struct isal_zstream *stream);
void isal_deflate_icf_finish_hash_hist_base(struct isal_zstream *stream);
void isal_deflate_icf_finish_hash_map_base(struct isal_zstream *stream);

enum {
    PADDING = 16,          /* bytes at the end of the input that the search leaves to the last step */
    LAST = 3,              /* bytes at the very end, which no match begins with */
    FULL = 8,              /* bytes of the buffer of tokens that stay free */
    LONGEST = 258,         /* bytes of one match */
    REPEATED = 264,        /* from this length on, a match is several tokens */
    SEARCHED = 258 * 16,   /* bytes of a repeated match */
    NO_DISTANCE = 0x1e,    /* of a literal */
    SECOND_LITERAL = 0x1f, /* of the first literal of two */
    DISTANCE_SHIFT = 10,
    EXTRA_SHIFT = 19,
    LENGTH_OFFSET = 254,
    /* Search skips bytes after this many without a match, ever more of them. */
    SKIP_AFTER = 2048,
    SKIP_BASE = 32,
    SKIP_START = 512,
    SKIP_RATE = 2,
    SKIP_LEVEL_MAX = (128 - SKIP_BASE) / SKIP_RATE + SKIP_START
};

/* ---- hash: CRC-32C of 4 bytes, its lower 16 bits ---- */

static uint16_t of_byte[4][256];

__attribute__((constructor)) static void make_table(void)
{
    for (uint32_t byte = 0; byte < 256; byte++) {
        uint32_t crc = byte;
        for (int place = 3; place >= 0; place--) {
            for (int bit = 0; bit < 8; bit++)
                crc = crc & 1 ? crc >> 1 ^ 0x82f63b78u : crc >> 1;
            of_byte[place][byte] = (uint16_t)crc;
        }
    }
}

static inline uint32_t hash_of(uint64_t bytes)
{
    return of_byte[0][bytes & 255] ^ of_byte[1][bytes >> 8 & 255] ^ of_byte[2][bytes >> 16 & 255] ^
           of_byte[3][bytes >> 24 & 255];
}

/* ---- tokens ---- */

struct search {
    struct level_buf *buffers;
    uint16_t *table;
    const uint8_t *bytes; /* of the whole stream */
    int64_t at, end;      /* indices of `bytes`; the search stops before `end` */
    int64_t padding;      /* readable bytes behind it */
    uint32_t *out, *full; /* tokens; there is no room if out > full */
    uint32_t hash, hash2; /* of the bytes at `at`, and of those behind */
    uint32_t hash_mask, distance_mask;
    int64_t skip_at, skip_level;
};

static inline uint64_t load(const uint8_t *at)
{
    uint64_t value;
    memcpy(&value, at, sizeof value);
    return value;
}

static inline void put_literal(struct search *s, uint32_t value)
{
    s->buffers->hist.ll_hist[value]++;
    *s->out++ = value | NO_DISTANCE << DISTANCE_SHIFT;
}

static inline void put_two_literals(struct search *s, uint32_t first, uint32_t second)
{
    s->buffers->hist.ll_hist[first]++;
    s->buffers->hist.ll_hist[second]++;
    *s->out++ = first + ((second + SECOND_LITERAL) << DISTANCE_SHIFT);
}

static inline void put_match(struct search *s, uint32_t distance, uint32_t length)
{
    uint32_t code, extra;
    get_dist_icf_code(distance, &code, &extra);
    s->buffers->hist.ll_hist[length + LENGTH_OFFSET]++;
    s->buffers->hist.d_hist[code]++;
    *s->out++ = (length + LENGTH_OFFSET) | code << DISTANCE_SHIFT | extra << EXTRA_SHIFT;
}

/* The length of a match of at least 8 bytes, at most `most`. */
static inline uint32_t equal_bytes(const uint8_t *a, const uint8_t *b, int64_t most)
{
    int64_t length = 8;
    for (; length + 8 <= most; length += 8) {
        const uint64_t differences = load(a + length) ^ load(b + length);
        if (differences) return (uint32_t)(length + __builtin_ctzll(differences) / 8);
    }
    while (length < most && a[length] == b[length])
        length++;
    return (uint32_t)length;
}

static inline int64_t least(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static inline void enter(struct search *s, uint32_t hash, int64_t at)
{
    s->table[hash] = (uint16_t)at;
}

static inline void hash_next(struct search *s)
{
    const uint64_t bytes = load(s->bytes + s->at);
    s->hash = hash_of(bytes) & s->hash_mask;
    s->hash2 = hash_of(bytes >> 8) & s->hash_mask;
}

static inline bool no_room(const struct search *s)
{
    return s->out > s->full;
}

/* ---- the main loop ---- */

enum step { GO_ON, INPUT_ENDS, OUTPUT_ENDS };

/* A match of several tokens. `at` is its first byte; the table gets `entered` and the index behind it. */
static enum step put_repeated(struct search *s, uint32_t distance, uint32_t length, int64_t entered)
{
    enter(s, s->hash, entered);
    enter(s, s->hash2, entered + 1);
    do {
        length -= LONGEST;
        s->at += LONGEST;
        put_match(s, distance, LONGEST);
        if (no_room(s)) return OUTPUT_ENDS;
    } while (length >= REPEATED);
    if (length > LONGEST) length = LONGEST;
    s->at += length;
    put_match(s, distance, length);
    if (s->end <= s->at) return INPUT_ENDS;
    for (int64_t i = s->at - 4; i < s->at; i++)
        enter(s, hash_of(load(s->bytes + i)) & s->hash_mask, i);
    hash_next(s);
    return GO_ON;
}

/* Literals without a search, after many bytes without a match. The hashes stay those of the bytes before. */
static enum step skip(struct search *s)
{
    s->skip_level = s->skip_level + 1 < 0 ? 0 : least(s->skip_level + 1, SKIP_LEVEL_MAX);
    s->skip_at = s->skip_level > 63 ? 0 : (int64_t)SKIP_AFTER >> s->skip_level;
    const int64_t more = s->skip_level > SKIP_START ? s->skip_level - SKIP_START : 0;
    int64_t count = (SKIP_RATE * more + SKIP_BASE) & -SKIP_BASE;
    const int64_t room = ((const char *)s->full + 4 - (const char *)s->out) >> 1;
    if (room >= count && s->padding + s->end - s->at >= count) {
        for (; count > 0; count -= 8)
            for (int i = 0; i < 4; i++, s->at += 2)
                put_two_literals(s, s->bytes[s->at], s->bytes[s->at + 1]);
        if (s->end <= s->at) return INPUT_ENDS;
        s->skip_at += s->at;
        return GO_ON;
    }
    for (;;) {
        put_two_literals(s, s->bytes[s->at], s->bytes[s->at + 1]);
        s->at += 2;
        if (no_room(s)) return OUTPUT_ENDS;
        if (s->end <= s->at) return INPUT_ENDS;
    }
}

/* A match begins at the first byte. */
static inline enum step first_matches(struct search *s, uint32_t distance, uint64_t differences)
{
    const uint8_t *here = s->bytes + s->at;
    uint32_t length = (uint32_t)__builtin_ctzll(differences | 1ull << 63) / 8;
    if (differences == 0) {
        length = equal_bytes(here, here - distance, least(s->end - s->at + s->padding, SEARCHED));
        if (length >= REPEATED) return put_repeated(s, distance, length, s->at + 2);
        if (length > LONGEST) length = LONGEST;
    }
    const int64_t from = s->at;
    put_match(s, distance, length);
    enter(s, s->hash, from + 2);
    enter(s, s->hash2, from + 3);
    s->at = from + length;
    if (s->at > s->end) return INPUT_ENDS;
    s->skip_at = s->at + SKIP_AFTER;
    s->skip_level -= length;
    hash_next(s);
    return GO_ON;
}

/* A literal, and a match that begins at the second byte. */
static inline enum step second_matches(struct search *s, uint32_t distance, uint64_t differences)
{
    const uint8_t *here = s->bytes + s->at + 1;
    const uint32_t hash3 = hash_of(load(here) >> 24) & s->hash_mask;
    uint32_t length = (uint32_t)__builtin_ctzll(differences | 1ull << 63) / 8;
    if (differences == 0) {
        length = equal_bytes(here, here - distance, least(s->end - s->at - 1 + s->padding, SEARCHED));
        if (length >= REPEATED) {
            put_literal(s, s->bytes[s->at++]);
            return put_repeated(s, distance, length, s->at + 2);
        }
        if (length > LONGEST) length = LONGEST;
    }
    put_literal(s, s->bytes[s->at]);
    const int64_t from = s->at + 1;
    put_match(s, distance, length);
    enter(s, s->hash, from + 1);
    enter(s, s->hash2, from + 2);
    s->at = from + length;
    if (s->at > s->end) return INPUT_ENDS;
    enter(s, hash3, from + 3);
    s->skip_at = s->at + SKIP_AFTER;
    s->skip_level -= length;
    hash_next(s);
    return GO_ON;
}

/* Two bytes are looked up at once. */
static inline enum step step(struct search *s)
{
    const uint8_t *here = s->bytes + s->at;
    const uint64_t bytes = load(here);
    const uint32_t distance = ((uint16_t)(s->at - 1 - s->table[s->hash]) & s->distance_mask) + 1;
    enter(s, s->hash, s->at);
    const uint32_t distance2 = ((uint16_t)(s->at - s->table[s->hash2]) & s->distance_mask) + 1;
    enter(s, s->hash2, s->at + 1);
    s->hash = hash_of(bytes >> 16) & s->hash_mask;
    s->hash2 = hash_of(bytes >> 24) & s->hash_mask;
    const uint64_t differences = bytes ^ load(here - distance);
    if (differences == 0) return first_matches(s, distance, differences);
    const uint64_t differences2 = load(here + 1) ^ load(here + 1 - distance2);
    if (differences2 == 0) return second_matches(s, distance2, differences2);
    if ((uint32_t)differences == 0) return first_matches(s, distance, differences);
    if ((uint32_t)differences2 == 0) return second_matches(s, distance2, differences2);
    put_two_literals(s, here[0], here[1]);
    s->at += 2;
    if (s->at > s->end) return INPUT_ENDS;
    return s->at <= s->skip_at ? GO_ON : skip(s);
}

static enum step search(struct search *s, struct isal_zstate *state)
{
    if (s->end <= s->at) return INPUT_ENDS;
    hash_next(s);
    if (state->has_hist == IGZIP_NO_HIST) {
        if (no_room(s)) return OUTPUT_ENDS;
        state->has_hist = IGZIP_HIST;
        enter(s, s->hash, s->at);
        put_literal(s, s->bytes[s->at++]);
        hash_next(s);
        if (s->at >= s->end) return INPUT_ENDS;
    }
    enum step then = GO_ON;
    while (then == GO_ON)
        then = no_room(s) ? OUTPUT_ENDS : step(s);
    return then;
}

/* ---- the stream ---- */

static struct search begin(struct isal_zstream *stream, int64_t padding, uint32_t full)
{
    struct level_buf *buffers = (struct level_buf *)stream->level_buf;
    struct search s = {.buffers = buffers,
                       .table = buffers->lvl1.hash_table,
                       .bytes = stream->next_in - stream->total_in,
                       .at = stream->total_in,
                       .padding = padding,
                       .hash_mask = stream->internal_state.hash_mask,
                       .distance_mask = stream->internal_state.dist_mask};
    s.end = s.at + stream->avail_in - padding;
    s.skip_at = s.at + SKIP_AFTER;
    s.out = (uint32_t *)buffers->icf_buf_next;
    s.full = (uint32_t *)((char *)s.out + buffers->icf_buf_avail_out - full);
    return s;
}

static void end(struct isal_zstream *stream, const struct search *s)
{
    struct level_buf *buffers = s->buffers;
    const int64_t all = s->end + s->padding;
    stream->total_in = stream->internal_state.block_end = (uint32_t)s->at;
    stream->next_in = (uint8_t *)(uintptr_t)(s->bytes + s->at);
    stream->avail_in = (uint32_t)(all - s->at);
    buffers->icf_buf_avail_out -= (uint64_t)((char *)s->out - (char *)buffers->icf_buf_next);
    buffers->icf_buf_next = (struct deflate_icf *)s->out;
}

static bool is_last(const struct isal_zstream *stream)
{
    return stream->end_of_stream || stream->flush != NO_FLUSH;
}

void isal_deflate_icf_body_hash_hist_base(struct isal_zstream *stream)
{
    struct isal_zstate *state = &stream->internal_state;
    if (stream->avail_in == 0) {
        if (is_last(stream)) state->state = ZSTATE_CREATE_HDR;
        return;
    }
    state->has_eob = 0;
    struct search s = begin(stream, is_last(stream) ? PADDING : ISAL_LOOK_AHEAD, FULL);
    const enum step then = search(&s, state);
    state->state = then == OUTPUT_ENDS ? ZSTATE_CREATE_HDR : is_last(stream) ? ZSTATE_FLUSH_READ_BUFFER : ZSTATE_BODY;
    end(stream, &s);
}

/* The last bytes, one at a time. */
static bool finish(struct search *s, struct isal_zstate *state)
{
    while (s->at < s->end) {
        if (no_room(s)) return false;
        const uint8_t *here = s->bytes + s->at;
        uint32_t bytes;
        memcpy(&bytes, here, sizeof bytes);
        const uint32_t hash = hash_of(bytes) & s->hash_mask;
        const uint32_t distance = (uint16_t)(s->at - s->table[hash]);
        enter(s, hash, s->at);
        int64_t length = 0;
        if (state->has_hist == IGZIP_NO_HIST) {
            state->has_hist = IGZIP_HIST;
        } else if (distance - 1 < s->distance_mask) {
            const int64_t most = least(s->end - s->at + LAST, LONGEST);
            while (length < most && here[length] == here[length - (int64_t)distance])
                length++;
        }
        if (length < SHORTEST_MATCH) {
            put_literal(s, *here);
            s->at++;
            continue;
        }
        const int64_t from = s->at;
        s->at += length;
        if (s->at < s->end)
            for (int64_t i = from + 1; i <= from + 2; i++) {
                memcpy(&bytes, s->bytes + i, sizeof bytes);
                enter(s, hash_of(bytes) & s->hash_mask, i);
            }
        put_match(s, distance, (uint32_t)length);
    }
    for (; s->at < s->end + LAST; s->at++) {
        if (no_room(s)) return false;
        put_literal(s, s->bytes[s->at]);
    }
    return true;
}

void isal_deflate_icf_finish_hash_hist_base(struct isal_zstream *stream)
{
    struct search s = begin(stream, LAST, 4);
    const bool done = finish(&s, &stream->internal_state);
    if (!done || is_last(stream)) stream->internal_state.state = ZSTATE_CREATE_HDR;
    end(stream, &s);
}

/* Of level 3, which nothing here uses. */
void isal_deflate_icf_finish_hash_map_base(struct isal_zstream *stream)
{
    (void)stream;
}
