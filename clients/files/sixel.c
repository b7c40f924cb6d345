#include "sixel.h"

#include <stdlib.h>
#include <string.h>

/* Levels of red, green and blue: the eye distinguishes greens best. */
enum { REDS = 6, GREENS = 8, BLUES = 5, COLORS = REDS * GREENS * BLUES, BAND = 6 };

/* Quantizes a channel over black. Rounds up if the remainder exceeds the threshold of the pixel, in 32nds: areas keep
 * their mean. */
static int level(const struct pixels *pixels, const uint16_t *at, int k, int levels, int threshold)
{
    const long white = pixels->is_16_bit ? 65535 : 255;
    const long value = (long)at[k] * at[3] / white;
    return (int)((value * (levels - 1) * 32 + threshold * white) / (32 * white));
}

static int color_at(const struct pixels *pixels, uint32_t x, uint32_t y)
{
    static const int thresholds[4][4] = {{1, 17, 5, 21}, {25, 9, 29, 13}, {7, 23, 3, 19}, {31, 15, 27, 11}};
    const uint16_t *at = pixels->rgba + ((size_t)y * pixels->width + x) * 4;
    const int t = thresholds[y % 4][x % 4];
    return (level(pixels, at, 0, REDS, t) * GREENS + level(pixels, at, 1, GREENS, t)) * BLUES +
           level(pixels, at, 2, BLUES, t);
}

static void write_palette(struct bytes *out)
{
    for (int i = 0; i < COLORS; i++)
        bytes_print(out, "#%d;2;%d;%d;%d", i, i / BLUES / GREENS * 100 / (REDS - 1),
                    i / BLUES % GREENS * 100 / (GREENS - 1), i % BLUES * 100 / (BLUES - 1));
}

/* Returns the rows of a column that have the colour, as bits. */
static int rows_of(const unsigned char *column, uint32_t width, uint32_t rows, int color)
{
    int bits = 0;
    for (uint32_t y = 0; y < rows; y++)
        bits |= (column[y * width] == color) << y;
    return bits;
}

/* Writes the columns of one colour in a band of six rows, run-length encoded. */
static void write_color(struct bytes *out, const unsigned char *colors, uint32_t width, uint32_t rows, int color)
{
    bytes_print(out, "#%d", color);
    for (uint32_t x = 0, run = 0; x < width; x += run) {
        const int bits = rows_of(colors + x, width, rows, color);
        for (run = 1; x + run < width && rows_of(colors + x + run, width, rows, color) == bits;)
            run++;
        if (run > 3)
            bytes_print(out, "!%u%c", run, 63 + bits);
        else
            bytes_add(out, (char[]){(char)(63 + bits), (char)(63 + bits), (char)(63 + bits)}, run);
    }
    bytes_print(out, "$");
}

void sixel_write(struct bytes *out, const struct pixels *pixels)
{
    unsigned char *colors = malloc((size_t)pixels->width * BAND);
    if (!colors) return;
    bytes_print(out, "\033Pq\"1;1;%u;%u", pixels->width, pixels->height);
    write_palette(out);
    for (uint32_t top = 0; top < pixels->height; top += BAND) {
        bool is_used[COLORS] = {false};
        const uint32_t rows = pixels->height - top < BAND ? pixels->height - top : BAND;
        for (uint32_t y = 0; y < rows; y++)
            for (uint32_t x = 0; x < pixels->width; x++) {
                const int color = color_at(pixels, x, top + y);
                colors[y * pixels->width + x] = (unsigned char)color;
                is_used[color] = true;
            }
        for (int color = 0; color < COLORS; color++)
            if (is_used[color]) write_color(out, colors, pixels->width, rows, color);
        bytes_print(out, "-");
    }
    bytes_print(out, "\033\\");
    free(colors);
}
