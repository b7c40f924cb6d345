#include "output/images/gif.h"

#include <math.h>
#include <string.h>

enum {
    HEAD = 13,    /* signature and logical screen, without colours */
    REPEAT = 19,  /* application extension */
    CONTROL = 8,  /* graphic control extension */
    DELAY_AT = 4, /* in it */
    DELAY_MOST = 65535,
    TRAILER = 0x3b
};

/* Frames stay until the next one; transparent ones are cleared before. */
enum { STAYS = 1, IS_CLEARED = 2 };

static unsigned char *put16(unsigned char *at, uint32_t value)
{
    at[0] = (unsigned char)value;
    at[1] = (unsigned char)(value >> 8);
    return at + 2;
}

/* ---- LZW ---- */

enum { CODES = 4096, SLOTS = 8192 /* a power of two */, BLOCK = 255 };

/* Codes of the strings so far, by the code of their beginning and their last byte; open addressing. */
struct packing {
    struct zr_buffer *out;
    uint32_t keys[SLOTS]; /* beginning << 8 | byte, plus 1; 0: free */
    uint16_t codes[SLOTS];
    uint32_t next, clear; /* next free code; the code that forgets all strings */
    int bits;             /* of a code */
    uint64_t held;        /* bits that are not in the block yet */
    int held_bits;
    unsigned char block[1 + BLOCK]; /* its length first */
};

static void end_block(struct packing *p)
{
    if (p->block[0] > 0) zr_buffer_add(p->out, p->block, 1u + p->block[0]);
    p->block[0] = 0;
}

static void put_byte(struct packing *p)
{
    p->block[++p->block[0]] = (unsigned char)p->held;
    p->held >>= 8;
    p->held_bits -= 8;
    if (p->block[0] == BLOCK) end_block(p);
}

static void put_code(struct packing *p, uint32_t code)
{
    p->held |= (uint64_t)code << p->held_bits;
    p->held_bits += p->bits;
    while (p->held_bits >= 8)
        put_byte(p);
}

static void forget(struct packing *p, int color_bits)
{
    memset(p->keys, 0, sizeof p->keys);
    p->next = p->clear + 2;
    p->bits = color_bits + 1;
}

/* Returns the slot of a string, or the free one where it belongs. */
static uint32_t slot_of(const struct packing *p, uint32_t key)
{
    uint32_t slot = key * 2654435761u >> 19;
    while (p->keys[slot] && p->keys[slot] != key)
        slot = (slot + 1) % SLOTS;
    return slot;
}

/* Adds a string behind the code that was written for its beginning. */
static void add_string(struct packing *p, uint32_t slot, uint32_t key, int color_bits)
{
    if (p->next == CODES) {
        put_code(p, p->clear);
        forget(p, color_bits);
        return;
    }
    p->keys[slot] = key;
    p->codes[slot] = (uint16_t)p->next;
    if (p->next++ == 1u << p->bits) p->bits++;
}

static void pack_row(struct packing *p, const uint8_t *indices, uint32_t count, int color_bits, uint32_t *string)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t key = (*string << 8 | indices[i]) + 1, slot = slot_of(p, key);
        if (p->keys[slot]) {
            *string = p->codes[slot];
            continue;
        }
        put_code(p, *string);
        add_string(p, slot, key, color_bits);
        *string = indices[i];
    }
}

static enum zr_status pack(const struct zr_gif *gif, const struct zr_gif_colors *colors, int color_bits,
                           const struct zr_cancel *cancel, struct zr_buffer *out)
{
    struct packing p = {.out = out, .clear = 1u << color_bits, .bits = color_bits + 1};
    const unsigned char least = (unsigned char)color_bits;
    zr_buffer_add(out, &least, 1);
    forget(&p, color_bits);
    put_code(&p, p.clear);
    uint32_t string = colors->indices[0];
    for (uint32_t y = 0; y < gif->height; y++) {
        if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
        const uint32_t from = y == 0;
        pack_row(&p, colors->indices + (size_t)y * gif->width + from, gif->width - from, color_bits, &string);
    }
    put_code(&p, string);
    /* The reader has added one string more than has been written. */
    if (p.next == 1u << p.bits && p.bits < 12) p.bits++;
    put_code(&p, p.clear + 1);
    if (p.held_bits > 0) put_byte(&p);
    end_block(&p);
    const unsigned char none = 0;
    return zr_buffer_add(out, &none, 1) ? ZR_OK : ZR_NO_MEMORY;
}

/* ---- file ---- */

static int bits_of(uint32_t colors)
{
    int bits = 2; /* the least of LZW */
    while (1u << bits < colors)
        bits++;
    return bits;
}

/* Adds the file's beginning, and the heads of a frame that is shown for no time. */
static void add_heads(const struct zr_gif *gif, const struct zr_gif_colors *colors, int bits, struct zr_buffer *out)
{
    unsigned char head[HEAD + CONTROL + 10] = "GIF89a", *at = put16(put16(head + 6, gif->width), gif->height);
    memcpy(at, "\x70\0\0\x21\xf9\4", 6); /* colours of 8 bits, none for all frames; control */
    at[6] = (unsigned char)(colors->transparent >= 0 ? IS_CLEARED << 2 | 1 : STAYS << 2);
    at[9] = (unsigned char)(colors->transparent >= 0 ? colors->transparent : 0);
    at += 11;
    *at = ','; /* image, at 0, 0 */
    at = put16(put16(at + 5, gif->width), gif->height);
    *at = (unsigned char)(0x80 | (bits - 1));
    zr_buffer_add(out, head, sizeof head);
}

enum zr_status zr_gif_write(const struct zr_gif *gif, const struct zr_cancel *cancel, struct zr_buffer *out)
{
    struct zr_gif_colors colors;
    const enum zr_status status = zr_gif_colors_make(gif, out->arena, cancel, &colors);
    if (status != ZR_OK) return status;
    const int bits = bits_of(colors.count);
    add_heads(gif, &colors, bits, out);
    zr_buffer_add(out, colors.colors, (size_t)3 << bits);
    const enum zr_status packed = pack(gif, &colors, bits, cancel, out);
    const unsigned char trailer = TRAILER;
    if (packed != ZR_OK) return packed;
    return zr_buffer_add(out, &trailer, 1) ? ZR_OK : ZR_NO_MEMORY;
}

/* ---- frames ---- */

static bool begin(struct zr_buffer *out, const unsigned char *gif)
{
    static const unsigned char repeat[REPEAT + 1] = "\x21\xff\x0bNETSCAPE2.0\3\1\0\0"; /* for ever */
    return zr_buffer_add(out, gif, HEAD) && zr_buffer_add(out, repeat, REPEAT);
}

/* Returns the hundredths of a second of the next frame. */
static uint32_t delay_of(const struct zr_gif_frames *frames)
{
    const double delay = 100.0 * frames->seconds, from = floor(frames->done * delay + 0.5);
    return (uint32_t)fmin(floor((frames->done + 1) * delay + 0.5) - from, DELAY_MOST);
}

enum zr_status zr_gif_frames_add(struct zr_gif_frames *frames, const unsigned char *gif, size_t size)
{
    struct zr_buffer *out = frames->out;
    if (frames->done == 0 && !begin(out, gif)) return ZR_NO_MEMORY;
    const size_t at = out->size;
    const bool is_last = frames->done + 1 == frames->frames;
    if (!zr_buffer_add(out, gif + HEAD, size - HEAD - !is_last)) return ZR_NO_MEMORY;
    put16(out->bytes + at + DELAY_AT, delay_of(frames));
    frames->done++;
    return ZR_OK;
}
