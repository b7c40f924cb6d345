#include "accept.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include <strings.h>

static bool is_name(const char *text, size_t length, const char *name)
{
    return length == strlen(name) && strncasecmp(text, name, length) == 0;
}

/* Reads a weight such as 0.25 as 250; 0 if it is malformed. */
static int read_weight(const char *text, size_t length)
{
    int weight = 0;
    if (length == 0 || length > 5 || (text[0] != '0' && text[0] != '1') || (length > 1 && text[1] != '.')) return 0;
    for (size_t i = 0, unit = 1000; i < length; i++) {
        if (i == 1) continue;
        if (text[i] < '0' || text[i] > '9') return 0;
        weight += (text[i] - '0') * (int)unit;
        unit /= 10;
    }
    return weight <= 1000 ? weight : 0;
}

static const char *skip_blanks(const char *text, const char *end)
{
    while (text < end && (*text == ' ' || *text == '\t'))
        text++;
    return text;
}

static const char *find_semicolon(const char *text, const char *end)
{
    while (text < end && *text != ';')
        text++;
    return text;
}

/* Returns the length of a token without the blanks after it. */
static size_t token_length(const char *text, const char *end)
{
    while (end > text && (end[-1] == ' ' || end[-1] == '\t'))
        end--;
    return (size_t)(end - text);
}

static const char *const NAMES[ACCEPT_TYPES] = {
    ACCEPT_MIXED_TYPE, ACCEPT_FORM_TYPE, "application/zip", ACCEPT_OPEN_TYPE, "text/plain", "image/tiff", "image/png"};

/* Reads "type/subtype;q=0.5"; other parameters do not matter. */
static void read_range(struct accept *accept, const char *text, const char *end)
{
    const char *next = find_semicolon(text, end), *name = skip_blanks(text, next);
    const size_t length = token_length(name, next);
    int weight = 1000;
    while (next < end) {
        const char *parameter = skip_blanks(next + 1, end);
        next = find_semicolon(parameter, end);
        const size_t size = token_length(parameter, next);
        if (size >= 2 && strncasecmp(parameter, "q=", 2) == 0) weight = read_weight(parameter + 2, size - 2);
    }
    for (int i = 0; i < ACCEPT_TYPES; i++)
        if (is_name(name, length, NAMES[i])) accept->weights[i] = weight;
}

void accept_read(struct accept *accept, const char *value)
{
    while (*value) {
        const char *end = value + strcspn(value, ",");
        read_range(accept, value, end);
        value = *end ? end + 1 : end;
    }
}

enum accept_parts accept_parts(const struct accept *accept)
{
    const int mixed = accept->weights[ACCEPT_TYPE_MIXED], form = accept->weights[ACCEPT_TYPE_FORM];
    const int most = mixed > form ? mixed : form;
    if (most == 0 || most < accept->weights[ACCEPT_TYPE_ZIP]) return ACCEPT_NO_PARTS;
    return mixed == most ? ACCEPT_MIXED : ACCEPT_FORM;
}

bool accept_prefers(const struct accept *accept, enum accept_type type, enum accept_type other)
{
    return accept->weights[type] > 0 && accept->weights[type] >= accept->weights[other];
}
