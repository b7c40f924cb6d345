#include "output/json/json_print.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put(struct zr_print *print, const char *text)
{
    zr_buffer_add(print->out, text, strlen(text));
}

/* Prints the comma and the key in front of a value. */
static void begin_value(struct zr_print *print, const char *key)
{
    if (print->needs_comma) put(print, ",");
    print->needs_comma = true;
    if (!key) return;
    put(print, "\"");
    put(print, key);
    put(print, "\":");
}

void zr_print_begin(struct zr_print *print, const char *key, char bracket)
{
    begin_value(print, key);
    zr_buffer_add(print->out, &bracket, 1);
    print->needs_comma = false;
}

void zr_print_end(struct zr_print *print, char bracket)
{
    zr_buffer_add(print->out, &bracket, 1);
    print->needs_comma = true;
}

/* Prints a character that JSON strings cannot hold as it is. */
static void put_escaped(struct zr_print *print, unsigned char character)
{
    static const char short_ones[] = "\"\"\\\\\bb\ff\nn\rr\tt"; /* pairs: a character, and the letter of its escape */
    char text[8];
    for (size_t i = 0; i + 1 < sizeof short_ones; i += 2)
        if ((unsigned char)short_ones[i] == character) {
            snprintf(text, sizeof text, "\\%c", short_ones[i + 1]);
            put(print, text);
            return;
        }
    snprintf(text, sizeof text, "\\u%04x", character);
    put(print, text);
}

/* Puts JSON without the blanks between its tokens. */
static void put_json(struct zr_print *print, const char *json, const char *end)
{
    bool is_text = false;
    for (const char *from = json, *at = json; at <= end; at++) {
        if (at < end && is_text && *at == '\\') {
            at++;
        } else if (at == end || (!is_text && strchr(" \n\t\r", *at))) {
            zr_buffer_add(print->out, from, (size_t)(at - from));
            from = at + 1;
        } else if (*at == '"') {
            is_text = !is_text;
        }
    }
}

void zr_print_json(struct zr_print *print, const char *key, const char *json)
{
    begin_value(print, key);
    put_json(print, json, json + strlen(json));
}

void zr_print_members(struct zr_print *print, const char *object)
{
    const size_t length = strlen(object);
    if (length <= 2) return;
    begin_value(print, NULL);
    put_json(print, object + 1, object + length - 1);
}

void zr_print_string(struct zr_print *print, const char *key, const char *text)
{
    begin_value(print, key);
    put(print, "\"");
    for (const char *begin = text;; begin = ++text) {
        while (*text && *text != '"' && *text != '\\' && (unsigned char)*text >= ' ')
            text++;
        zr_buffer_add(print->out, begin, (size_t)(text - begin));
        if (!*text) break;
        put_escaped(print, (unsigned char)*text);
    }
    put(print, "\"");
}

void zr_print_bool(struct zr_print *print, const char *key, bool value)
{
    begin_value(print, key);
    put(print, value ? "true" : "false");
}

void zr_print_null(struct zr_print *print, const char *key)
{
    begin_value(print, key);
    put(print, "null");
}

void zr_print_count(struct zr_print *print, const char *key, uint64_t count)
{
    char text[24];
    begin_value(print, key);
    snprintf(text, sizeof text, "%" PRIu64, count);
    put(print, text);
}

void zr_print_integer(struct zr_print *print, const char *key, int64_t value)
{
    char text[24];
    begin_value(print, key);
    snprintf(text, sizeof text, "%" PRId64, value);
    put(print, text);
}

/* Replaces the decimal separator of the locale, one or more bytes, by a point. */
static void put_point(char *text)
{
    const size_t whole = strspn(text, "-0123456789"), rest = strcspn(text + whole, "0123456789e");
    if (rest == 0) return;
    text[whole] = '.';
    memmove(text + whole + 1, text + whole + rest, strlen(text + whole + rest) + 1);
}

void zr_print_float(struct zr_print *print, const char *key, float value)
{
    char text[40];
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) break; /* reads the separator that it printed */
    }
    put_point(text);
    begin_value(print, key);
    put(print, text);
}

void zr_print_floats(struct zr_print *print, const char *key, const float *values, int count)
{
    zr_print_begin(print, key, '[');
    for (int i = 0; i < count; i++)
        zr_print_float(print, NULL, values[i]);
    zr_print_end(print, ']');
}

void zr_print_double(struct zr_print *print, const char *key, double value)
{
    char text[40];
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break; /* reads the separator that it printed */
    }
    put_point(text);
    begin_value(print, key);
    put(print, text);
}

void zr_print_doubles(struct zr_print *print, const char *key, const double *values, int count)
{
    zr_print_begin(print, key, '[');
    for (int i = 0; i < count; i++)
        zr_print_double(print, NULL, values[i]);
    zr_print_end(print, ']');
}

void zr_print_vec3(struct zr_print *print, const char *key, zr_vec3 v)
{
    zr_print_floats(print, key, (float[3]){v.x, v.y, v.z}, 3);
}

void zr_print_place(struct zr_print *print, const char *key, zr_vec3 v, const double *moved)
{
    if (!moved)
        zr_print_vec3(print, key, v);
    else
        zr_print_doubles(print, key,
                         (double[3]){(double)v.x + moved[0], (double)v.y + moved[1], (double)v.z + moved[2]}, 3);
}
