/* gif.h: reads GIF files that zraster wrote: frames of the whole picture, each with its own colours. */
#ifndef GIF_H
#define GIF_H

#include <stdint.h>
#include <string.h>

#include "support/tests.h"

struct gif {
    const uint8_t *at, *end; /* behind the frames that were read */
    uint32_t width, height;
    bool repeats;
    uint32_t delay; /* of the last frame, hundredths of a second */
};

static inline uint32_t gif_16(const uint8_t *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8;
}

static inline struct gif gif_open(const void *bytes, size_t size)
{
    const uint8_t *at = bytes;
    assert_memory_equal(at, "GIF89a", 6);
    struct gif gif = {.at = at + 13, .end = at + size, .width = gif_16(at + 6), .height = gif_16(at + 8)};
    assert_int_equal(at[10] & 0x80, 0);
    if (gif.at[0] == 0x21 && gif.at[1] == 0xff) {
        assert_memory_equal(gif.at + 2, "\x0bNETSCAPE2.0\3\1\0\0", 17);
        gif.repeats = true;
        gif.at += 19;
    }
    return gif;
}

/* Strings of codes: each is a shorter one and a byte. */
struct gif_strings {
    uint16_t before[4096];
    uint8_t last[4096];
};

static inline uint8_t gif_first(const struct gif_strings *strings, uint32_t code, uint32_t clear)
{
    while (code >= clear)
        code = strings->before[code];
    return (uint8_t)code;
}

static inline uint32_t gif_write_string(const struct gif_strings *strings, uint32_t code, uint32_t clear, uint8_t *out,
                                        uint32_t done, uint32_t most)
{
    uint32_t length = 1;
    for (uint32_t c = code; c >= clear; c = strings->before[c])
        length++;
    assert_in_range(done + length, 0, most);
    for (uint32_t at = done + length; at-- > done; code = strings->before[code])
        out[at] = code < clear ? (uint8_t)code : strings->last[code];
    return done + length;
}

static inline uint32_t gif_code(const uint8_t *bytes, size_t size, size_t bit, int bits)
{
    uint32_t code = 0;
    assert_true(bit + (size_t)bits <= 8 * size);
    for (int i = 0; i < bits; i++)
        code |= (uint32_t)(bytes[(bit + (size_t)i) / 8] >> ((bit + (size_t)i) % 8) & 1) << i;
    return code;
}

/* Unpacks the codes of a frame into `most` indices. */
static inline void gif_unpack(const uint8_t *bytes, size_t size, int least, uint8_t *out, uint32_t most)
{
    static struct gif_strings strings;
    const uint32_t clear = 1u << least, none = UINT32_MAX;
    uint32_t next = clear + 2, last = none, done = 0;
    int bits = least + 1;
    for (size_t bit = 0;;) {
        const uint32_t code = gif_code(bytes, size, bit, bits);
        bit += (size_t)bits;
        if (code == clear + 1) break;
        if (code == clear) {
            next = clear + 2, last = none, bits = least + 1;
            continue;
        }
        assert_in_range(code, 0, last == none ? clear - 1 : next);
        if (last != none && next < 4096) {
            strings.before[next] = (uint16_t)last;
            strings.last[next] = gif_first(&strings, code == next ? last : code, clear);
            if (++next == 1u << bits && bits < 12) bits++;
        }
        done = gif_write_string(&strings, code, clear, out, done, most);
        last = code;
    }
    assert_int_equal(done, most);
}

/* Reads the next frame as RGBA. Returns false behind the last one. */
static inline bool gif_next(struct gif *gif, uint8_t *rgba)
{
    static uint8_t packed[1 << 22], indices[1 << 20];
    if (*gif->at == 0x3b) {
        assert_ptr_equal(gif->at + 1, gif->end);
        return false;
    }
    assert_memory_equal(gif->at, "\x21\xf9\4", 3);
    const int transparent = gif->at[3] & 1 ? gif->at[6] : -1;
    assert_int_equal(gif->at[3] >> 2, transparent >= 0 ? 2 : 1); /* what is transparent needs a cleared picture */
    gif->delay = gif_16(gif->at + 4);
    const uint8_t *image = gif->at + 8, *colors = image + 10;
    assert_memory_equal(image, ",\0\0\0\0", 5);
    assert_true(gif_16(image + 5) == gif->width && gif_16(image + 7) == gif->height && image[9] & 0x80);
    const uint8_t *at = colors + ((size_t)6 << (image[9] & 7));
    const int least = *at++;
    size_t size = 0;
    for (; *at; at += *at + 1) {
        memcpy(packed + size, at + 1, *at);
        size += *at;
    }
    gif->at = at + 1;
    const uint32_t pixels = gif->width * gif->height;
    gif_unpack(packed, size, least, indices, pixels);
    for (uint32_t i = 0; i < pixels; i++) {
        memcpy(rgba + 4 * i, colors + 3 * indices[i], 3);
        rgba[4 * i + 3] = indices[i] == transparent ? 0 : 255;
    }
    return true;
}

#endif
