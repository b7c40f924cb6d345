/* labels.c - writes each line of its input as a picture: text of strokes, black on white, enlarged for programs that read.
 *
 *   zraster-labels HEIGHT SCALE FOLDER <labels.txt
 *
 * Capitals are HEIGHT pixels high, and each pixel becomes SCALE x SCALE, linear in between. Writes FOLDER/001.pgm and so
 * on. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "overlay/type.h"

static int die(const char *what)
{
    perror(what);
    return 1;
}

static double grey(const struct zr_canvas *canvas, int32_t x, int32_t y)
{
    const int32_t column = zr_greater(0, zr_lesser(x, canvas->width - 1));
    const int32_t row = zr_greater(0, zr_lesser(y, canvas->height - 1));
    return canvas->pixels[row * canvas->width + column] & 255;
}

/* Returns the value at (x, y) between the middles of pixels. */
static double linear(const struct zr_canvas *canvas, double x, double y)
{
    const int32_t column = (int32_t)(x + 0.5) - 1, row = (int32_t)(y + 0.5) - 1;
    const double right = x - 0.5 - column, down = y - 0.5 - row;
    const double above = grey(canvas, column, row) * (1 - right) + grey(canvas, column + 1, row) * right;
    const double below = grey(canvas, column, row + 1) * (1 - right) + grey(canvas, column + 1, row + 1) * right;
    return above * (1 - down) + below * down;
}

static int write_picture(const char *name, const struct zr_canvas *canvas, int scale)
{
    FILE *file = fopen(name, "wb");
    if (!file) return die(name);
    fprintf(file, "P5\n%d %d\n255\n", canvas->width * scale, canvas->height * scale);
    for (int y = 0; y < canvas->height * scale; y++)
        for (int x = 0; x < canvas->width * scale; x++)
            fputc((int)(linear(canvas, (x + 0.5) / scale, (y + 0.5) / scale) + 0.5), file);
    return fclose(file) == 0 ? 0 : die(name);
}

static int draw(const char *text, double height, int scale, const char *name)
{
    struct zr_canvas canvas = {NULL, (int32_t)(zr_type_width(text, height) + 2 * height + 2), (int32_t)(2.6 * height)};
    const size_t count = (size_t)canvas.width * (size_t)canvas.height;
    canvas.pixels = malloc(count * sizeof *canvas.pixels);
    if (!canvas.pixels) return die(name);
    memset(canvas.pixels, 255, count * sizeof *canvas.pixels);
    const struct zr_type_place place = {height + 0.5, (int)(1.8 * height) + 0.5, height, 1, 0};
    zr_type_draw(&canvas, text, place, zr_type_pen(height), 0xFF000000);
    const int status = write_picture(name, &canvas, scale);
    free(canvas.pixels);
    return status;
}

int main(int count, char **arguments)
{
    char line[256], name[4096];
    int status = 0;
    if (count != 4) {
        fputs("usage: zraster-labels HEIGHT SCALE FOLDER <labels.txt\n", stderr);
        return 2;
    }
    for (int i = 1; status == 0 && fgets(line, sizeof line, stdin); i++) {
        line[strcspn(line, "\n")] = '\0';
        snprintf(name, sizeof name, "%s/%03d.pgm", arguments[3], i);
        status = draw(line, atof(arguments[1]), atoi(arguments[2]), name);
    }
    return status;
}
