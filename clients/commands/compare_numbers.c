/* compare_numbers.c - client: `zraster compare a.npy b.npy`: counts the pixels whose numbers differ. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "commands/compare.h"
#include "engine/report.h"
#include "files/numbers.h"
#include "files/say.h"

struct difference {
    size_t pixels, at, finite;
    double largest, squares; /* largest: HUGE_VAL if one of both is no number */
};

static bool read_numbers(const char *path, struct numbers *numbers)
{
    struct bytes bytes = {.data = NULL}, faults = {.data = NULL};
    bool ok = bytes_read(&bytes, path);
    if (!ok)
        bytes_explain(&faults);
    else
        ok = numbers_read(numbers, bytes_text(&bytes), bytes.size, &faults);
    if (!ok) report_faults(stderr, path, &faults);
    bytes_free(&bytes);
    bytes_free(&faults);
    return ok;
}

/* Returns the difference of two values: equal infinities, and two that are no numbers, differ by 0. */
static double difference_of(double a, double b)
{
    if (a == b || (isnan(a) && isnan(b))) return 0.0;
    return isfinite(a) && isfinite(b) ? fabs(a - b) : HUGE_VAL;
}

static struct difference compare(const struct numbers *a, const struct numbers *b, double tolerance)
{
    struct difference found = {.pixels = 0};
    for (size_t pixel = 0; pixel < a->width * a->height; pixel++) {
        double most = 0.0;
        for (size_t i = pixel * a->channels; i < (pixel + 1) * a->channels; i++) {
            const double own = difference_of(a->values[i], b->values[i]);
            most = own > most ? own : most;
            if (!(own < HUGE_VAL)) continue;
            found.squares += own * own;
            found.finite++;
        }
        found.pixels += most > tolerance;
        if (most <= found.largest) continue;
        found.largest = most;
        found.at = pixel;
    }
    return found;
}

static void print(const struct options *options, const struct numbers *size, const struct difference *found)
{
    const size_t count = size->width * size->height, x = found->at % size->width, y = found->at / size->width;
    const double rms = found->finite > 0 ? sqrt(found->squares / (double)found->finite) : 0.0,
                 share = (double)found->pixels / (double)count;
    if (options->own[OPTION_JSON]) {
        printf("{\"same\":%s,\"width\":%zu,\"height\":%zu,\"channels\":%zu,\"pixels\":%zu,\"differing\":%zu,"
               "\"share\":%.9g,",
               found->pixels ? "false" : "true", size->width, size->height, size->channels, count, found->pixels,
               share);
        if (found->largest < HUGE_VAL)
            printf("\"largest\":%.17g,", found->largest);
        else
            printf("\"largest\":null,");
        if (found->largest > 0.0) printf("\"at\":[%zu,%zu],", x, y);
        printf("\"rms\":%.9g}\n", rms);
    } else if (found->pixels)
        printf("%zu of %zu pixels differ (%.3g %%); the largest difference is %.6g, at %zu,%zu; RMS %.6g\n",
               found->pixels, count, 100.0 * share, found->largest, x, y, rms);
    else if (found->largest > 0.0)
        printf("all %zu pixels are equal to within %.6g; RMS %.6g\n", count, found->largest, rms);
    else
        printf("all %zu pixels are equal\n", count);
}

static int compare_read(const struct options *options, const struct numbers *a, const struct numbers *b,
                        double tolerance)
{
    if (a->width != b->width || a->height != b->height || a->channels != b->channels) {
        printf("the first array is %zux%zux%zu, the second %zux%zux%zu: compare arrays of one shape\n", a->width,
               a->height, a->channels, b->width, b->height, b->channels);
        return STATUS_DIFFERENT;
    }
    const struct difference found = compare(a, b, tolerance);
    print(options, a, &found);
    return found.pixels ? STATUS_DIFFERENT : STATUS_DONE;
}

int compare_numbers(const struct options *options)
{
    const char *text = options->own[OPTION_TOLERANCE];
    char *end = NULL;
    const double tolerance = text ? strtod(text, &end) : 0.0;
    if (text && (end == text || *end || !(tolerance >= 0.0)))
        return options_wrong("--tolerance of arrays accepts a number of at least 0, not %s", text);
    if (options->own[OPTION_OUTPUT]) return options_wrong("-o: differences of arrays are numbers alone");
    struct numbers a = {.values = NULL}, b = {.values = NULL};
    const bool ok = read_numbers(options->files[0], &a) && read_numbers(options->files[1], &b);
    const int status = ok ? compare_read(options, &a, &b, tolerance) : STATUS_FAILED;
    numbers_free(&a);
    numbers_free(&b);
    return status;
}
