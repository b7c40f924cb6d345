#include "overlay/letters.h"

#include <math.h>
#include <stddef.h>

#include "base/trig.h"

/* ---- rows ---- */

static const struct zr_letter_row *row_of(uint32_t character)
{
    uint32_t low = 0, high = ZR_LETTER_NONE;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (zr_letter_rows[middle].character < character)
            low = middle + 1;
        else
            high = middle;
    }
    return zr_letter_rows[low].character == character ? &zr_letter_rows[low] : &zr_letter_rows[ZR_LETTER_NONE];
}

struct zr_letter zr_letter_find(uint32_t character)
{
    enum { ASCII_END = 0x80 };
    /* These look the same; keyboards and files have one or the other. */
    static const uint32_t same[][2] = {{0x3BC, 0xB5}, {0x2126, 0x3A9}, {0x212B, 0xC5},   {0x2011, '-'},
                                       {0x202F, ' '}, {0x2009, ' '},   {0x2205, 0x2300}, {0x22C5, 0xB7}};
    if (character < ASCII_END) return (struct zr_letter){row_of(character), NULL};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        if (same[i][0] == character) character = same[i][1];
    for (int i = 0; i < ZR_ACCENT_ROWS; i++) {
        const struct zr_accent_row *row = &zr_accent_rows[i];
        if (row->character == character) return (struct zr_letter){row_of(row->base), row_of(row->mark)};
    }
    return (struct zr_letter){row_of(character), NULL};
}

double zr_letter_width(struct zr_letter letter)
{
    return letter.mark && letter.mark->width > letter.base->width ? letter.mark->width : letter.base->width;
}

/* ---- strokes ---- */

/* Appends to `out` what it reads at `at`, moved and scaled. */
struct pen {
    struct zr_letter_path *out;
    const char *at;
    double x, y, scale;
};

static uint32_t points_of(const struct zr_letter_path *path)
{
    return path->count > 0 ? path->ends[path->count - 1] : 0;
}

static void add_point(const struct pen *pen, double x, double y)
{
    struct zr_letter_path *out = pen->out;
    uint32_t *end = &out->ends[out->count - 1];
    if (*end < ZR_LETTER_POINTS)
        out->points[(*end)++] = (struct zr_point){pen->x + pen->scale * x, pen->y + pen->scale * y};
}

/* Begins a polyline, unless the last one is empty. */
static void begin_line(const struct pen *pen)
{
    struct zr_letter_path *out = pen->out;
    const uint32_t end = points_of(out), last = out->count > 1 ? out->ends[out->count - 2] : 0;
    if (out->count == ZR_LETTER_LINES || (out->count > 0 && end == last)) return;
    out->ends[out->count++] = end;
}

/* Reads digits with an optional sign and decimals. */
static double read_number(struct pen *pen)
{
    double sign = 1, value = 0, unit = 1;
    while (*pen->at == ' ')
        pen->at++;
    if (*pen->at == '-') {
        sign = -1;
        pen->at++;
    }
    for (; *pen->at >= '0' && *pen->at <= '9'; pen->at++)
        value = 10 * value + (*pen->at - '0');
    if (*pen->at == '.')
        for (pen->at++; *pen->at >= '0' && *pen->at <= '9'; pen->at++) {
            unit *= 10;
            value = 10 * value + (*pen->at - '0');
        }
    return sign * value / unit;
}

static void add_ellipse(struct pen *pen)
{
    double v[6]; /* centre, radii, angles */
    for (int i = 0; i < 6; i++)
        v[i] = read_number(pen);
    const int steps = (int)ceil(fabs(v[5] - v[4]) / 15);
    for (int i = 0; i <= steps; i++) {
        double sine, cosine;
        zr_sine_cosine(v[4] + (v[5] - v[4]) * i / steps, &sine, &cosine);
        add_point(pen, v[0] + v[2] * cosine, v[1] + v[3] * sine);
    }
}

static void add_dot(struct pen *pen)
{
    const double x = read_number(pen), y = read_number(pen), half = 0.35 / pen->scale;
    add_point(pen, x - half, y - half);
    add_point(pen, x + half, y - half);
    add_point(pen, x + half, y + half);
    add_point(pen, x - half, y + half);
    add_point(pen, x - half, y - half);
}

/* Returns the letter that "=C x y scale" moves and scales, and passes over it. */
static struct pen read_part(struct pen *pen)
{
    const struct zr_letter_row *row = row_of((unsigned char)pen->at[0]);
    pen->at++;
    const double x = read_number(pen), y = read_number(pen), scale = read_number(pen);
    return (struct pen){pen->out, row->strokes, pen->x + pen->scale * x, pen->y + pen->scale * y, pen->scale * scale};
}

/* Adds points and polylines up to the next part, or up to the end. */
static void add_strokes(struct pen *pen)
{
    if (*pen->at && *pen->at != '=') begin_line(pen);
    while (*pen->at && *pen->at != '=') {
        const char c = *pen->at;
        if (c == ' ' || c == '/' || c == 'o' || c == 'd') pen->at++;
        if (c == '/') begin_line(pen);
        if (c == 'o') add_ellipse(pen);
        if (c == 'd') add_dot(pen);
        if (c == '-' || (c >= '0' && c <= '9')) {
            const double x = read_number(pen);
            add_point(pen, x, read_number(pen));
        }
    }
}

static void add_row(const struct zr_letter_row *row, double x, double y, struct zr_letter_path *out)
{
    struct pen pen = {out, row->strokes, x, y, 1};
    for (add_strokes(&pen); *pen.at == '=';) {
        pen.at++;
        struct pen part = read_part(&pen);
        add_strokes(&part);
        while (*pen.at == ' ' || *pen.at == '/')
            pen.at++;
        add_strokes(&pen);
    }
}

/* Base and mark have one middle. */
void zr_letter_trace(struct zr_letter letter, struct zr_letter_path *out)
{
    enum { CEDILLA = 0xB8 };
    const double width = zr_letter_width(letter), above_capital = 3;
    const uint32_t c = letter.base->character;
    out->count = 0;
    add_row(letter.base, (width - letter.base->width) / 2, 0, out);
    if (!letter.mark) return;
    const bool is_raised = c >= 'A' && c <= 'Z' && letter.mark->character != CEDILLA;
    add_row(letter.mark, (width - letter.mark->width) / 2, is_raised ? above_capital : 0, out);
}
