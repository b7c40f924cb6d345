#include "input/formats.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

/* ---- what bytes look like ---- */

static bool begins_with(const char *bytes, size_t size, const char *begin, size_t length)
{
    return size >= length && memcmp(bytes, begin, length) == 0;
}

static const struct {
    const char *begin;
    size_t length;
    const char *words;
} strangers[] = {
    {"\x1F\x8B", 2, "gzip (Content-Encoding: gzip is missing)"},
    {"\x89PNG", 4, "a PNG picture"},
    {"\xFF\xD8\xFF", 3, "a JPEG picture"},
    {"PK\x03\x04", 4, "a ZIP archive, as 3MF files are"},
    {"glTF", 4, "binary glTF"},
    {"ply\n", 4, "PLY"},
    {"ply\r", 4, "PLY"},
    {"\x93NUMPY", 6, "an NPY array"},
    {"%PDF", 4, "a PDF document"},
    {"GIF8", 4, "a GIF picture"},
    {"RIFF", 4, "a RIFF file, as WebP pictures are"},
    {"II*\0", 4, "a TIFF picture"},
    {"MM\0*", 4, "a TIFF picture"},
    {"BM", 2, "a BMP picture"},
    {"\xABKTX ", 5, "a KTX texture"},
    {"DDS ", 4, "a DDS texture"},
    {"#?RADIANCE", 10, "a Radiance picture"},
    {"<", 1, "XML or HTML"},
};

/* ---- the table ---- */

size_t zr_byte_order_mark(const char *bytes, size_t size)
{
    static const char mark[] = "\xEF\xBB\xBF";
    return begins_with(bytes, size, mark, sizeof mark - 1) ? sizeof mark - 1 : 0;
}

#define FORMAT_ROW(ID, suffix, media_types, has_view) {#ID, suffix, media_types, has_view, &zr_reader_##ID},
const struct zr_format_row zr_format_rows[ZR_FORMAT_COUNT] = {ZR_FORMAT_ROWS(FORMAT_ROW)};

/* ---- types ---- */

static size_t type_length(const char *media_type)
{
    return strcspn(media_type, "; \t");
}

/* `words` are apart by blanks. */
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

/* curl sends the last one where nothing is said. */
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

/* ---- bytes ---- */

enum zr_format zr_format_of_bytes(const char *bytes, size_t size)
{
    const size_t mark = zr_byte_order_mark(bytes, size);
    for (int i = 0; i < ZR_FORMAT_COUNT; i++)
        if (zr_format_rows[i].reader->looks_so(bytes + mark, size - mark)) return (enum zr_format)i;
    return ZR_FORMAT_UNKNOWN;
}

const char *zr_bytes_in_words(const char *bytes, size_t size)
{
    const enum zr_format format = zr_format_of_bytes(bytes, size);
    if (format != ZR_FORMAT_UNKNOWN) return zr_format_rows[format].name;
    for (size_t i = 0; i < sizeof strangers / sizeof *strangers; i++)
        if (begins_with(bytes, size, strangers[i].begin, strangers[i].length)) return strangers[i].words;
    return NULL;
}
