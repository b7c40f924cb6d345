#include <inttypes.h>
#include <string.h>

#include "base/cancel.h"
#include "input/images/environment_image.h"

/* ---- the header ---- */

enum { LINE_MAX = 256, LINES_MAX = 256 };

bool zr_radiance_looks_so(const void *bytes, size_t size)
{
    return size >= 6 && memcmp(bytes, "#?", 2) == 0;
}

/* Copies the line at *at, without its end, and steps behind it. False: it has no end, or is too long. */
static bool next_line(const struct zr_encoded_image *file, size_t *at, char line[LINE_MAX])
{
    const char *from = (const char *)file->bytes + *at, *end = memchr(from, '\n', file->size - *at);
    if (!end || end - from >= LINE_MAX) return false;
    const size_t length = (size_t)(end - from);
    memcpy(line, from, length);
    line[length > 0 && line[length - 1] == '\r' ? length - 1 : length] = '\0';
    *at += length + 1;
    return true;
}

/* Reads a whole number of up to 9 digits at the text, and steps behind it. 0: there is none. */
static uint32_t number_at(const char **text)
{
    uint32_t number = 0;
    int digits = 0;
    for (; **text >= '0' && **text <= '9' && digits < 9; (*text)++, digits++)
        number = 10 * number + (uint32_t)(**text - '0');
    return number;
}

/* Reads "-Y height +X width". */
static bool read_size(const char *line, uint32_t *width, uint32_t *height)
{
    if (strncmp(line, "-Y ", 3) != 0) return false;
    line += 3;
    *height = number_at(&line);
    if (strncmp(line, " +X ", 4) != 0) return false;
    line += 4;
    *width = number_at(&line);
    return *line == '\0' && *width > 0 && *height > 0;
}

static bool refuse_line(struct zr_reason *reason, const char *what, const char *line)
{
    zr_reason_give(reason, "a Radiance file with the %s %s", what, zr_quote(line, strlen(line)).text);
    return false;
}

bool zr_radiance_head_read(const struct zr_encoded_image *file, uint32_t *width, uint32_t *height, size_t *rows,
                           struct zr_reason *reason)
{
    static const char format[] = "FORMAT=";
    char line[LINE_MAX] = "";
    size_t at = 0;
    int lines = 0;
    do {
        if (!next_line(file, &at, line) || ++lines > LINES_MAX) {
            zr_reason_give(reason, "a broken Radiance file: its header has no end");
            return false;
        }
        if (strncmp(line, format, sizeof format - 1) == 0 && strcmp(line, "FORMAT=32-bit_rle_rgbe") != 0)
            return refuse_line(reason, "unknown line; FORMAT=32-bit_rle_rgbe is needed, not", line);
    } while (line[0] != '\0');
    if (!next_line(file, &at, line)) line[0] = '\0';
    *rows = at;
    return read_size(line, width, height) || refuse_line(reason, "size of the form -Y HEIGHT +X WIDTH, not", line);
}

/* ---- rows ---- */

/* Bytes that are left. */
struct source {
    const uint8_t *at, *end;
};

static size_t left(const struct source *from)
{
    return (size_t)(from->end - from->at);
}

/* Reads one byte of each texel of a row, in runs. */
static bool read_bytes(struct source *from, uint32_t width, uint8_t *to)
{
    for (uint32_t x = 0; x < width;) {
        if (left(from) < 2) return false;
        const uint32_t code = *from->at++, count = code > 128 ? code - 128 : code;
        if (count == 0 || count > width - x) return false;
        if (code <= 128 && left(from) < count) return false;
        for (uint32_t i = 0; i < count; i++)
            to[4 * (size_t)(x + i)] = code > 128 ? *from->at : from->at[i];
        from->at += code > 128 ? 1 : count;
        x += count;
    }
    return true;
}

/* Reads a row of texels. One with the mantissas 1, 1, 1 repeats the texel before as often as its exponent says; several
 * of them are digits of one count, the lowest first. */
static bool read_texels(struct source *from, uint32_t width, uint8_t *to)
{
    for (uint32_t x = 0, shift = 0; x < width;) {
        if (left(from) < 4) return false;
        const uint8_t *texel = from->at;
        from->at += 4;
        if (texel[0] != 1 || texel[1] != 1 || texel[2] != 1) {
            memcpy(to + 4 * (size_t)x++, texel, 4);
            shift = 0;
            continue;
        }
        const uint64_t count = shift <= 24 ? (uint64_t)texel[3] << shift : UINT64_MAX;
        if (x == 0 || count > width - x) return false;
        for (uint64_t i = 0; i < count; i++, x++)
            memcpy(to + 4 * (size_t)x, to + 4 * (size_t)(x - 1), 4);
        shift += 8;
    }
    return true;
}

static bool read_row(struct source *from, uint32_t width, uint8_t *to)
{
    const uint8_t *head = from->at;
    const bool has_runs = width >= 8 && width < 32768 && left(from) >= 4 && head[0] == 2 && head[1] == 2 &&
                          (uint32_t)head[2] << 8 == (width & 0x7f00) && head[3] == (width & 0xff);
    if (!has_runs) return read_texels(from, width, to);
    from->at += 4;
    for (int k = 0; k < 4; k++)
        if (!read_bytes(from, width, to + k)) return false;
    return true;
}

enum zr_status zr_radiance_read(const struct zr_encoded_image *file, size_t rows, const struct zr_image *image,
                                uint8_t *rgbe, const struct zr_cancel *cancel, struct zr_reason *reason)
{
    const uint8_t *bytes = file->bytes;
    struct source from = {bytes + rows, bytes + file->size};
    for (uint32_t y = 0; y < image->height; y++) {
        if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
        if (read_row(&from, image->width, rgbe + 4 * (size_t)image->width * y)) continue;
        zr_reason_give(reason, "a broken Radiance file: row %" PRIu32 " of %" PRIu32 " is cut off or does not fit", y,
                       image->height);
        return ZR_BAD_SCENE;
    }
    return ZR_OK;
}

float zr_radiance_unit(uint8_t exponent)
{
    const uint32_t bits = exponent < 2 ? 0 : ((uint32_t)exponent - 1) << 23; /* 2^(exponent - 128) */
    float unit;
    memcpy(&unit, &bits, sizeof unit);
    return unit * (1.0f / 256.0f);
}
