#include "input/json/json_writer.h"

#include <stdio.h>
#include <string.h>

#include "input/text/text.h"

size_t zr_json_shared(const char *a, const char *b)
{
    size_t length = 0;
    for (size_t i = 0; a[i] && a[i] == b[i]; i++)
        if (a[i] == '/') length = i + 1;
    return length;
}

void zr_json_put(struct zr_json_writer *json, const char *text)
{
    const size_t length = strlen(text);
    memcpy(json->text + json->used, text, length + 1);
    json->used += length;
}

void zr_json_put_string(struct zr_json_writer *json, const char *text)
{
    zr_json_put_part(json, text, strlen(text));
}

void zr_json_put_part(struct zr_json_writer *json, const char *text, size_t size)
{
    const char *end = text + size;
    zr_json_put(json, "\"");
    while (text < end) {
        const size_t length = zr_utf8_length(text, end);
        char character[8] = "?";
        if (*text == '"' || *text == '\\')
            snprintf(character, sizeof character, "\\%c", *text);
        else if (length > 0 && (unsigned char)*text >= ' ' && *text != 0x7F)
            snprintf(character, sizeof character, "%.*s", (int)length, text);
        zr_json_put(json, character);
        text += length > 0 ? length : 1;
    }
    zr_json_put(json, "\"");
}

void zr_json_go_to(struct zr_json_writer *json, const char *pointer)
{
    const size_t same = zr_json_shared(json->pointer, pointer);
    for (size_t i = strlen(json->pointer); i-- > same;)
        if (json->pointer[i] == '/') zr_json_put(json, zr_json_is_index(json->pointer + i + 1) ? "]" : "}");
    if (same > 0) zr_json_put(json, ",");
    for (const char *at = pointer + same; *at;) {
        if (*at == '/') {
            zr_json_put(json, zr_json_is_index(++at) ? "[" : "{");
            continue;
        }
        const size_t length = strcspn(at, "/");
        if (!zr_json_is_index(at)) {
            char key[64];
            snprintf(key, sizeof key, "\"%.*s\":", (int)length, at);
            zr_json_put(json, key);
        }
        at += length;
    }
    json->pointer = pointer;
}

void zr_json_put_number(struct zr_json_writer *json, double value)
{
    char text[40];
    snprintf(text, sizeof text, "%.17g", value);
    zr_json_put(json, text);
}
