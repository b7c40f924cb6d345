#include "text.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"

enum { ROOM_MIN = 4096 };

/* Makes room for `more` bytes and a zero. */
static bool make_room(struct mcp_text *text, size_t more)
{
    if (text->failed || more >= SIZE_MAX / 4 - text->size) {
        text->failed = true;
        return false;
    }
    if (text->room > text->size + more) return true;
    const size_t wanted = text->size + more + 1, room = wanted + wanted / 2 + ROOM_MIN;
    char *data = realloc(text->data, room);
    if (!data) {
        text->failed = true;
        return false;
    }
    text->data = data;
    text->room = room;
    return true;
}

void mcp_text_add(struct mcp_text *text, const void *bytes, size_t size)
{
    if (!make_room(text, size)) return;
    if (size) memcpy(text->data + text->size, bytes, size);
    text->size += size;
    text->data[text->size] = '\0';
}

void mcp_text_put(struct mcp_text *text, const char *words)
{
    mcp_text_add(text, words, strlen(words));
}

void mcp_text_print(struct mcp_text *text, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length < 0)
        text->failed = true;
    else if (make_room(text, (size_t)length)) {
        vsnprintf(text->data + text->size, (size_t)length + 1, format, again);
        text->size += (size_t)length;
    }
    va_end(again);
}

void mcp_text_line(struct mcp_text *text, const char *string, size_t most)
{
    const size_t size = strnlen(string, most), before = text->size;
    mcp_text_add(text, string, size);
    for (size_t i = before; i < text->size; i++)
        if ((unsigned char)text->data[i] < ' ' || text->data[i] == 0x7f) text->data[i] = ' ';
}

void mcp_text_json(struct mcp_text *text, const char *string)
{
    const char *const end = string + strlen(string);
    mcp_text_put(text, "\"");
    while (string < end) {
        const size_t length = zr_utf8_length(string, end);
        if (length == 0)
            mcp_text_put(text, "?");
        else if (*string == '"' || *string == '\\')
            mcp_text_print(text, "\\%c", *string);
        else if ((unsigned char)*string < ' ')
            mcp_text_print(text, "\\u%04x", (unsigned)*string);
        else
            mcp_text_add(text, string, length);
        string += length ? length : 1;
    }
    mcp_text_put(text, "\"");
}

void mcp_text_base64(struct mcp_text *text, const void *data, size_t size)
{
    static const char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const unsigned char *bytes = data;
    if (!make_room(text, (size + 2) / 3 * 4)) return;
    char *out = text->data + text->size;
    for (; size >= 3; bytes += 3, size -= 3, out += 4) {
        const uint32_t bits = (uint32_t)bytes[0] << 16 | (uint32_t)bytes[1] << 8 | bytes[2];
        out[0] = alphabet[bits >> 18];
        out[1] = alphabet[bits >> 12 & 63];
        out[2] = alphabet[bits >> 6 & 63];
        out[3] = alphabet[bits & 63];
    }
    if (size > 0) {
        const uint32_t bits = (uint32_t)bytes[0] << 16 | (size == 2 ? (uint32_t)bytes[1] << 8 : 0);
        out[0] = alphabet[bits >> 18];
        out[1] = alphabet[bits >> 12 & 63];
        out[2] = size == 2 ? alphabet[bits >> 6 & 63] : '=';
        out[3] = '=';
        out += 4;
    }
    *out = '\0';
    text->size = (size_t)(out - text->data);
}

void mcp_text_free(struct mcp_text *text)
{
    free(text->data);
    *text = (struct mcp_text){0};
}
