#include "input/query/query_text.h"

#include <string.h>

#include "input/query/parameter_values.h"
#include "input/text/nearest.h"
#include "input/text/text.h"
#include "render_request.h"

/* ", channel, encoding, ...", for a message. */
static const char all_names[] =
#define PARAMETER(name, ...) ", " #name
    ZR_PARAMETER_ROWS(PARAMETER);
#undef PARAMETER
enum { MESSAGE_ROOM = 160 }; /* for what a message says before the names */
_Static_assert(sizeof all_names + MESSAGE_ROOM <= ZR_DETAIL_SIZE, "a detail has room for the names of all parameters");

bool zr_percent_decode(char *out, const char *source, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        char c = source[i] == '+' ? ' ' : source[i];
        if (c == '%') {
            if (length - i < 3) return false;
            int high = zr_hex_digit(source[i + 1]), low = zr_hex_digit(source[i + 2]);
            if (high < 0 || low < 0 || (high == 0 && low == 0)) return false;
            c = (char)(high * 16 + low);
            i += 2;
        }
        *out++ = c;
    }
    *out = '\0';
    return true;
}

/* A decoded text is never longer; the '=' and '&' leave room for the final zeros. */
size_t zr_query_room(const char *query)
{
    return 2 * strlen(query) + 2;
}

static enum zr_status set(struct zr_request *request, const char *name, const char *value, struct zr_error *error)
{
    const char **field = NULL;
    struct zr_nearest nearest = {.word = name};
    for (int i = 0; i < zr_parameter_count; i++) {
        const struct zr_parameter_row *row = &zr_parameter_list[i];
        if (strcmp(row->name, name) == 0) field = (const char **)(void *)((char *)request + row->offset);
        zr_nearest_offer(&nearest, row->name);
    }
    if (!field || *field)
        return zr_error_add(error, ZR_BAD_REQUEST, NULL, "%s parameter '%.60s'%s; known: %s",
                            field ? "duplicate" : "unknown", name, field ? "" : zr_nearest_text(&nearest).text,
                            all_names + strlen(", "));
    *field = value;
    return ZR_OK;
}

enum zr_status zr_query_split(const char *query, char *room, struct zr_request *request, struct zr_error *error)
{
    for (const char *pair = query; *pair; pair += *pair == '&') {
        const size_t length = strcspn(pair, "&"), name_length = strcspn(pair, "=&");
        const size_t value_length = name_length < length ? length - name_length - 1 : 0;
        const char *text = pair;
        pair += length;
        if (length == 0) continue;
        char *name = room, *value = name + name_length + 1;
        room = value + value_length + 1;
        if (!zr_percent_decode(name, text, name_length) ||
            !zr_percent_decode(value, text + length - value_length, value_length))
            return zr_error_add(error, ZR_BAD_REQUEST, NULL, "a %%-escape is broken");
        const enum zr_status status = set(request, name, value, error);
        if (status != ZR_OK) return status;
    }
    return ZR_OK;
}
