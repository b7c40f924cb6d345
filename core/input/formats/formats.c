#include "input/formats/formats.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "input/text/text.h"

#define FORMAT_ROW(ID, suffix, media_types, ...)                                                                       \
    {#ID, suffix, media_types, __VA_ARGS__, zr_looks_so_##ID, zr_read_##ID},
const struct zr_format_row zr_format_rows[ZR_FORMAT_COUNT] = {ZR_FORMAT_ROWS(FORMAT_ROW)};

enum zr_format zr_format_of_bytes(const char *bytes, size_t size)
{
    const size_t mark = zr_byte_order_mark(bytes, size);
    for (int i = 0; i < ZR_FORMAT_COUNT; i++)
        if (zr_format_rows[i].looks_so(bytes + mark, size - mark)) return (enum zr_format)i;
    return ZR_FORMAT_UNKNOWN;
}

static size_t type_length(const char *media_type)
{
    return strcspn(media_type, "; \t");
}

/* `words` are separated by blanks. */
static bool is_among(const char *words, const char *word, size_t length)
{
    for (const char *at = words; *at; at += strspn(at, " ")) {
        const size_t here = strcspn(at, " ");
        if (here == length && strncasecmp(at, word, length) == 0) return true;
        at += here;
    }
    return false;
}

enum zr_format zr_format_of_type(const char *media_type)
{
    if (!media_type) return ZR_FORMAT_UNKNOWN;
    const size_t length = type_length(media_type);
    for (int i = 0; i < ZR_FORMAT_COUNT; i++)
        if (is_among(zr_format_rows[i].media_types, media_type, length)) return (enum zr_format)i;
    return ZR_FORMAT_UNKNOWN;
}

/* The last type is curl's default. */
bool zr_media_type_is_generic(const char *media_type)
{
    static const char generic[] = "application/octet-stream binary/octet-stream text/plain "
                                  "application/x-www-form-urlencoded";
    const size_t length = media_type ? type_length(media_type) : 0;
    return length == 0 || is_among(generic, media_type, length);
}

struct zr_format_types zr_format_types_join(void)
{
    struct zr_format_types joined = {""};
    size_t used = 0;
    for (int i = 0; i < ZR_FORMAT_COUNT && used < sizeof joined.text; i++) {
        const char *types = zr_format_rows[i].media_types;
        used += (size_t)snprintf(joined.text + used, sizeof joined.text - used, "%s%.*s", i ? ", " : "",
                                 (int)strcspn(types, " "), types);
    }
    return joined;
}
