#include "input/json/json_text.h"

#include <string.h>

enum { ESCAPED_WORD_MAX = 64 };

/* The value of the four hexadecimal digits of a \u escape, or -1. */
static int read_hex(const char *at, const char *end)
{
    if (end - at < 4) return -1;
    int value = 0;
    for (int i = 0; i < 4; i++) {
        char c = at[i];
        int digit = c >= '0' && c <= '9'   ? c - '0'
                    : c >= 'a' && c <= 'f' ? c - 'a' + 10
                    : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                           : -1;
        if (digit < 0) return -1;
        value = value * 16 + digit;
    }
    return value;
}

int32_t zr_json_text_unit(const char *at, const char *end, size_t *length)
{
    const int unit = read_hex(at + 2, end);
    *length = unit < 0 ? 0 : 6;
    if (unit < 0xD800 || unit > 0xDFFF) return unit;
    const int low = unit < 0xDC00 && end - at >= 8 && at[6] == '\\' && at[7] == 'u' ? read_hex(at + 8, end) : -1;
    *length = 12;
    return low < 0xDC00 || low > 0xDFFF ? -1 : 0x10000 + ((unit - 0xD800) << 10) + (low - 0xDC00);
}

static size_t write_utf8(int32_t character, char *out)
{
    const uint32_t c = (uint32_t)character;
    if (c < 0x80) {
        out[0] = (char)c;
        return 1;
    }
    const size_t more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    static const unsigned char leads[] = {0, 0xC0, 0xE0, 0xF0};
    out[0] = (char)(leads[more] | c >> (6 * more));
    for (size_t i = 1; i <= more; i++)
        out[i] = (char)(0x80 | (c >> (6 * (more - i)) & 0x3F));
    return more + 1;
}

/* An escape is never shorter than its UTF-8 form, so `out` needs no more bytes than `text`. */
size_t zr_json_text_resolve(const struct zr_json_text *text, char *out)
{
    const char *at = text->at, *end = text->end;
    if (!text->has_escapes) {
        memcpy(out, at, (size_t)(end - at));
        return (size_t)(end - at);
    }
    static const char letters[] = "bfnrt", meant[] = "\b\f\n\r\t";
    size_t used = 0, length;
    while (at < end) {
        const char *letter;
        if (*at != '\\') {
            out[used++] = *at++;
        } else if (at[1] == 'u') {
            used += write_utf8(zr_json_text_unit(at, end, &length), out + used);
            at += length;
        } else {
            letter = strchr(letters, at[1]);
            out[used++] = letter ? meant[letter - letters] : at[1];
            at += 2;
        }
    }
    return used;
}

bool zr_json_is(const struct zr_json_text *text, const char *word)
{
    size_t size = (size_t)(text->end - text->at);
    const char *at = text->at;
    char plain[6 * ESCAPED_WORD_MAX];
    if (text->has_escapes) {
        if (size > sizeof plain) return false;
        size = zr_json_text_resolve(text, plain);
        at = plain;
    }
    return strncmp(at, word, size) == 0 && strlen(word) == size;
}
