#include "input/text/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

size_t zr_byte_order_mark(const char *bytes, size_t size)
{
    static const char mark[] = "\xEF\xBB\xBF";
    return size >= sizeof mark - 1 && memcmp(bytes, mark, sizeof mark - 1) == 0 ? sizeof mark - 1 : 0;
}

size_t zr_count_blanks(const char *bytes, size_t size)
{
    size_t count = 0;
    while (count < size && count < ZR_BLANKS_MAX && bytes[count] && strchr(" \t\r\n", bytes[count]))
        count++;
    return count;
}

bool zr_is_not_finite(const char *word, size_t size)
{
    const size_t sign = size > 0 && (*word == '-' || *word == '+');
    word += sign;
    size -= sign;
    return size >= 3 &&
           (strncasecmp(word, "nan", 3) == 0 || strncasecmp(word, "inf", 3) == 0 || memchr(word + 1, '#', size - 1));
}

struct zr_quote zr_quote(const char *bytes, size_t size)
{
    static const char cut[] = "...";
    struct zr_quote quote;
    size_t used = 0, room = sizeof quote.text - sizeof cut - 2;
    const char *at = bytes, *end = size > 0 ? bytes + size : bytes; /* bytes may be NULL */
    quote.text[used++] = '\'';
    while (at < end) {
        size_t length = zr_utf8_length(at, end);
        if (used + length > room) break;
        if (length == 0 || (unsigned char)*at < 0x20 || *at == 0x7F) {
            quote.text[used++] = '?';
            at++;
        } else {
            memcpy(quote.text + used, at, length);
            used += length;
            at += length;
        }
        if (used >= room) break;
    }
    quote.text[used++] = '\'';
    if (at < end) {
        memcpy(quote.text + used, cut, sizeof cut - 1);
        used += sizeof cut - 1;
    }
    quote.text[used] = '\0';
    return quote;
}

void zr_reason_give(struct zr_reason *reason, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason->text, sizeof reason->text, format, arguments);
    va_end(arguments);
}

struct zr_place zr_place_of(const char *bytes, size_t offset)
{
    struct zr_place place = {1, 1};
    for (size_t i = 0; i < offset; i++) {
        if (bytes[i] == '\n') {
            place.line++;
            place.column = 1;
        } else if (!zr_utf8_in(bytes[i], 0x80, 0xBF)) {
            place.column++;
        }
    }
    return place;
}
