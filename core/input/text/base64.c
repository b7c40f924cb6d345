#include "input/text/base64.h"

#include <stdint.h>
#include <string.h>
#include <strings.h>

enum { NONE = 0x80 };

static void make_table(uint8_t table[256])
{
    static const char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    memset(table, NONE, 256);
    for (uint8_t i = 0; i < 64; i++)
        table[(unsigned char)alphabet[i]] = i;
}

/* Returns the index of the first character from `from` on that is not in the alphabet, or `size`. */
static size_t count_good(const uint8_t table[256], const char *text, size_t from, size_t size)
{
    while (from < size && table[(unsigned char)text[from]] != NONE)
        from++;
    return from;
}

/* Decodes the last four characters, of which one or two may be '='. Returns the bytes written; 0 if they are
 * invalid. */
static size_t decode_last(const uint8_t table[256], const char *text, unsigned char *out)
{
    size_t padding = text[3] != '=' ? 0 : text[2] != '=' ? 1 : 2;
    uint32_t bits = 0, bad = 0;
    for (size_t i = 0; i < 4; i++) {
        uint8_t six = i < 4 - padding ? table[(unsigned char)text[i]] : 0;
        bad |= six;
        bits = bits << 6 | six;
    }
    if ((bad & NONE) || (bits & ((1u << 8 * padding) - 1)) != 0) return 0;
    for (size_t i = 0; i < 3 - padding; i++)
        out[i] = (unsigned char)(bits >> (16 - 8 * i));
    return 3 - padding;
}

bool zr_base64_decode(const char *text, size_t size, unsigned char *out, size_t *used)
{
    uint8_t table[256];
    make_table(table);
    *used = 0;
    if (size == 0) return true;
    size_t at = 0;
    for (; at + 4 < size; at += 4) {
        const unsigned char *c = (const unsigned char *)text + at;
        uint32_t a = table[c[0]], b = table[c[1]], d = table[c[2]], e = table[c[3]];
        if ((a | b | d | e) & NONE) break;
        uint32_t bits = a << 18 | b << 12 | d << 6 | e;
        *out++ = (unsigned char)(bits >> 16);
        *out++ = (unsigned char)(bits >> 8);
        *out++ = (unsigned char)bits;
    }
    size_t last = at + 4 == size ? decode_last(table, text + at, out) : 0;
    *used = last ? at / 4 * 3 + last : count_good(table, text, at, size);
    return last > 0;
}

/* Limits the search for a comma: media types are shorter. */
enum { HEAD_MAX = 256 };

static const char SCHEME[] = "data:", BASE64[] = ";base64";

static bool ends_with(const char *text, size_t size, const char *end, size_t end_size)
{
    return size >= end_size && strncasecmp(text + size - end_size, end, end_size) == 0;
}

/* Returns the start of the base64 text; NULL with the reason. */
static const char *find_payload(const char *text, size_t size, struct zr_reason *reason)
{
    if (size < sizeof SCHEME - 1 || strncasecmp(text, SCHEME, sizeof SCHEME - 1) != 0) {
        zr_reason_give(reason, "%s is not a data: URI; nothing is fetched from elsewhere",
                       zr_quote(text, size < HEAD_MAX ? size : HEAD_MAX).text);
        return NULL;
    }
    const char *head = text + sizeof SCHEME - 1;
    const size_t left = size - (sizeof SCHEME - 1), length = left < HEAD_MAX ? left : HEAD_MAX;
    const char *comma = memchr(head, ',', length);
    if (!comma || !ends_with(head, (size_t)(comma - head), BASE64, sizeof BASE64 - 1)) {
        zr_reason_give(reason, "a data: URI without ;base64, in front of its bytes");
        return NULL;
    }
    return comma + 1;
}

enum zr_status zr_data_uri_read(struct zr_arena *arena, const char *text, size_t length, const void **bytes,
                                size_t *size, struct zr_reason *reason)
{
    const char *payload = find_payload(text, length, reason);
    if (!payload) return ZR_BAD_SCENE;
    length -= (size_t)(payload - text);
    unsigned char *out = zr_arena_alloc(arena, zr_base64_room(length), 1);
    if (!out) return ZR_NO_MEMORY;
    *bytes = out;
    if (zr_base64_decode(payload, length, out, size)) return ZR_OK;
    if (*size < length)
        zr_reason_give(reason, "not base64 at character %zu: %s", *size, zr_quote(payload + *size, 1).text);
    else
        zr_reason_give(reason, "base64 that is cut short: %zu characters are no multiple of 4", length);
    return ZR_BAD_SCENE;
}
