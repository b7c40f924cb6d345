/* compare_pictures.c - client: `zraster compare a.png b.png`: counts the pixels of two pictures that differ. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/compare.h"
#include "engine/report.h"
#include "files/output.h"
#include "files/pixels.h"
#include "files/say.h"
#include "files/ssim.h"

struct difference {
    size_t pixels;
    unsigned largest, at_x, at_y;
};

static bool read_picture(const char *path, struct pixels *pixels)
{
    struct bytes bytes = {.data = NULL}, faults = {.data = NULL};
    bool ok = bytes_read(&bytes, path);
    if (!ok)
        bytes_explain(&faults);
    else
        ok = pixels_read(pixels, bytes_text(&bytes), bytes.size, &faults);
    if (!ok) report_faults(stderr, path, &faults);
    bytes_free(&bytes);
    bytes_free(&faults);
    return ok;
}

/* Writes a pixel of the picture of differences: pale if the pictures are equal, red if they differ, darker for
 * larger differences. */
static void show(uint8_t rgb[3], const uint16_t *a, unsigned difference, unsigned white)
{
    const unsigned grey = (unsigned)(a[0] + a[1] + a[2]) / 3 * 255 / white;
    const uint8_t pale = (uint8_t)(192 + grey / 4);
    rgb[0] = difference ? 255 : pale;
    rgb[1] = rgb[2] = difference ? (uint8_t)(128 - difference * 128 / white) : pale;
}

/* Counts the pixels that differ by more than `tolerance` steps. */
static struct difference compare(const struct pixels *a, const struct pixels *b, unsigned tolerance, uint8_t *rgb)
{
    struct difference found = {.pixels = 0};
    const unsigned white = a->is_16_bit ? 65535 : 255;
    for (uint32_t y = 0; y < a->height; y++)
        for (uint32_t x = 0; x < a->width; x++) {
            const size_t i = (size_t)y * a->width + x;
            unsigned largest = 0;
            for (size_t k = 4 * i; k < 4 * i + 4; k++) {
                const unsigned d = (unsigned)abs(a->rgba[k] - b->rgba[k]);
                largest = d > largest ? d : largest;
            }
            show(rgb + 3 * i, a->rgba + 4 * i, largest > tolerance ? largest : 0, white);
            found.pixels += largest > tolerance;
            if (largest <= found.largest) continue;
            found.largest = largest;
            found.at_x = x;
            found.at_y = y;
        }
    return found;
}

/* Converts 8 bits to 16: 255 becomes 65535. */
static void widen(struct pixels *pixels)
{
    if (pixels->is_16_bit) return;
    for (size_t i = 0; i < (size_t)pixels->width * pixels->height * 4; i++)
        pixels->rgba[i] = (uint16_t)(pixels->rgba[i] * 257);
    pixels->is_16_bit = true;
}

static int save(const struct options *options, const struct pixels *size, const uint8_t *rgb)
{
    const char *out = options->own[OPTION_OUTPUT];
    struct bytes png = {.data = NULL}, names = {.data = NULL}, faults = {.data = NULL};
    struct target target = output_target(options->files[0], out);
    int status = output_check(&target, false, &faults);
    if (status == 0 && !target.out) target.stem = "difference";
    if (status == 0 && bytes_same_file(options->files[1], out)) {
        bytes_print(&faults, "the output would overwrite its own input; -o names another file");
        status = STATUS_USAGE;
    }
    if (status == 0 && !pixels_write(&png, size->width, size->height, rgb)) status = STATUS_FAILED;
    const struct answer answer = {.file = {png.data, png.size, "image/png"}};
    if (status == 0) status = output_save(&target, &answer, options->own[OPTION_NO_CLOBBER] != NULL, &names, &faults);
    if (status != 0) report_faults(stderr, out, &faults);
    bytes_free(&png);
    bytes_free(&names);
    bytes_free(&faults);
    return status;
}

static void print_json(const struct pixels *size, const struct difference *found, double ssim)
{
    const size_t count = (size_t)size->width * size->height;
    printf("{\"same\":%s,\"width\":%u,\"height\":%u,\"pixels\":%zu,\"differing\":%zu,\"share\":%.9g,\"largest\":%u,"
           "\"of\":%u",
           found->pixels ? "false" : "true", size->width, size->height, count, found->pixels,
           (double)found->pixels / (double)count, found->largest, size->is_16_bit ? 65535u : 255u);
    if (found->largest) printf(",\"at\":[%u,%u]", found->at_x, found->at_y);
    if (ssim >= -1) printf(",\"ssim\":%.9g", ssim);
    puts("}");
}

static void print(const struct options *options, const struct pixels *size, const struct difference *found, double ssim)
{
    const size_t count = (size_t)size->width * size->height;
    const unsigned white = size->is_16_bit ? 65535 : 255;
    if (options->own[OPTION_JSON]) {
        print_json(size, found, ssim);
        return;
    }
    if (found->pixels)
        printf("%zu of %zu pixels differ (%.3g %%); the largest difference is %u of %u, at %u,%u", found->pixels, count,
               100.0 * (double)found->pixels / (double)count, found->largest, white, found->at_x, found->at_y);
    else if (found->largest)
        printf("all %zu pixels are equal to within %u of %u", count, found->largest, white);
    else
        printf("all %zu pixels are equal", count);
    if (found->largest && ssim >= -1) printf("; SSIM %.6g", ssim);
    putchar('\n');
}

static int compare_pixels(const struct options *options, struct pixels *a, struct pixels *b)
{
    const char *const *names = options->files;
    if (a->width != b->width || a->height != b->height) {
        const char *out = options->own[OPTION_OUTPUT];
        struct bytes line = {.data = NULL};
        bytes_print(&line, "%s is %ux%u, %s is %ux%u: compare pictures of one size%s%s%s", names[0], a->width,
                    a->height, names[1], b->width, b->height, out ? "; -o " : "", out ? out : "",
                    out ? " is not written" : "");
        say_text(stdout, bytes_text(&line), line.size);
        putchar('\n');
        bytes_free(&line);
        return STATUS_DIFFERENT;
    }
    if (a->is_16_bit != b->is_16_bit) widen(a), widen(b);
    const size_t count = (size_t)a->width * a->height;
    uint8_t *rgb = malloc(3 * count);
    if (!rgb) return STATUS_FAILED;
    unsigned tolerance = 0;
    if (options->own[OPTION_TOLERANCE]) tolerance = (unsigned)strtoul(options->own[OPTION_TOLERANCE], NULL, 10);
    const struct difference found = compare(a, b, tolerance, rgb);
    print(options, a, &found, ssim_of(a, b));
    const int status = options->own[OPTION_OUTPUT] ? save(options, a, rgb) : 0;
    free(rgb);
    return status ? status : found.pixels ? STATUS_DIFFERENT : STATUS_DONE;
}

/* Checks --tolerance, steps of a colour. Returns 0 or an exit status. */
static int check_tolerance(const struct options *options)
{
    const char *text = options->own[OPTION_TOLERANCE];
    if (!text || (*text && strlen(text) <= 5 && text[strspn(text, "0123456789")] == '\0')) return 0;
    return options_wrong("--tolerance of pictures accepts steps of a colour, from 0 to 65535, not %s", text);
}

int compare_pictures(const struct options *options)
{
    const int wrong = check_tolerance(options);
    if (wrong) return wrong;
    struct pixels a = {.width = 0}, b = {.width = 0};
    const bool ok = read_picture(options->files[0], &a) && read_picture(options->files[1], &b);
    const int status = ok ? compare_pixels(options, &a, &b) : STATUS_FAILED;
    pixels_free(&a);
    pixels_free(&b);
    return status;
}
