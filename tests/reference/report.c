#include "reference/report.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "support/png.h"

enum { PIXELS_SHOWN = 5, PATH_SIZE = 600 };

static void print_tally(const char *name, const struct tally *tally)
{
    const struct comparison *c = &tally->comparison;
    printf("%-22s triangles %8" PRIu64 "  visible %10" PRIu64 "  clipped %7" PRIu64 "  coverage %" PRIu64
           "  depth %" PRIu64 " (max %" PRIu32 " ulp)  colour %" PRIu64 " (max %" PRIu32 " LSB)\n",
           name, tally->triangles, c->visible, tally->clipped, c->coverage, c->depth, c->depth_max_ulp, c->color,
           c->color_max_lsb);
}

void report_line(struct report *report, const char *name, enum verdict verdict, const struct tally *tally)
{
    report->count++;
    if (report->style == REPORT_QUIET) return;
    if (report->style == REPORT_TAP)
        printf("%s %d - equals the reference: ", verdict == VERDICT_EQUAL ? "ok" : "not ok", report->count);
    print_tally(name, tally);
    if (verdict == VERDICT_UNPROVED) printf("# %s: nothing was proved\n", name);
    fflush(stdout);
}

void report_total(struct report *report, enum verdict verdict, const struct tally *tally)
{
    static const char *const words[] = {[VERDICT_EQUAL] = "total, equal",
                                        [VERDICT_DIFFERENT] = "total, DIFFERENT",
                                        [VERDICT_UNPROVED] = "total, UNPROVED"};
    if (report->style == REPORT_TAP) printf("1..%d\n# ", report->count);
    print_tally(words[verdict], tally);
    fflush(stdout);
}

/* ---- failures ---- */

static bool make_directories(const char *path)
{
    char part[PATH_SIZE];
    for (size_t i = 1; i < sizeof part; i++) {
        if (path[i - 1] == 0) return true;
        if (path[i] != '/' && path[i] != 0) continue;
        memcpy(part, path, i);
        part[i] = 0;
        if (mkdir(part, 0777) && errno != EEXIST) {
            fprintf(stderr, "%s: %s\n", part, strerror(errno));
            return false;
        }
    }
    return true;
}

static void print_pixels(const struct report_failure *failure)
{
    uint32_t width = failure->drawing->width;
    size_t pixels = (size_t)width * failure->drawing->height, shown = 0;
    const struct picture *sides[2] = {failure->want, failure->got};
    for (size_t i = 0; i < pixels && shown < PIXELS_SHOWN; i++) {
        if (compare_pixel_equal(sides[0], sides[1], i)) continue;
        shown++;
        printf("# %s-%" PRIu64 ": pixel (%zu, %zu) of %" PRIu32 "x%" PRIu32 " from the top left\n", failure->label,
               failure->number, i % width, i / width, width, failure->drawing->height);
        for (int side = 0; side < 2; side++) {
            const uint8_t *c = sides[side]->rgba + i * 4;
            printf("#   %s face %6" PRIu32 "  depth %.9g (%a)  colour %d %d %d %d\n", side ? "got " : "want",
                   sides[side]->owner[i], (double)sides[side]->depth[i], (double)sides[side]->depth[i], c[0], c[1],
                   c[2], c[3]);
        }
    }
}

/* The wanted picture, dark, with red where another face owns the pixel, yellow
 * where the depth differs and cyan where only the colour does. */
static uint8_t *difference_picture(const struct report_failure *failure)
{
    static const uint8_t coverage[4] = {255, 40, 40, 255}, depth[4] = {255, 255, 0, 255}, color[4] = {0, 255, 255, 255};
    const struct picture *want = failure->want, *got = failure->got;
    size_t pixels = (size_t)failure->drawing->width * failure->drawing->height;
    uint8_t *out = malloc(pixels * 4);
    for (size_t i = 0; out && i < pixels; i++) {
        const uint8_t *bright = want->owner[i] != got->owner[i]                   ? coverage
                                : compare_ulp(want->depth[i], got->depth[i]) != 0 ? depth
                                                                                  : color;
        if (!compare_pixel_equal(want, got, i)) {
            memcpy(out + i * 4, bright, 4);
            continue;
        }
        for (size_t k = 0; k < 3; k++)
            out[i * 4 + k] = (uint8_t)(want->rgba[i * 4 + k] / 6 + 10);
        out[i * 4 + 3] = 255;
    }
    return out;
}

static void write_picture(const struct report_failure *failure, const char *what, const uint8_t *rgba)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s-%" PRIu64 "-%s.png", failure->directory, failure->label, failure->number, what);
    if (rgba) png_file_write(path, rgba, failure->drawing->width, failure->drawing->height);
}

static void write_matrix(FILE *file, const char *name, const zr_mat4 *matrix)
{
    fprintf(file, "%s, column by column\n", name);
    for (int i = 0; i < 16; i++)
        fprintf(file, "%a%c", (double)matrix->m[i], i % 4 == 3 ? '\n' : ' ');
}

static void write_numbers(const struct report_failure *failure)
{
    const struct drawing *d = failure->drawing;
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s-%" PRIu64 ".txt", failure->directory, failure->label, failure->number);
    FILE *file = fopen(path, "w");
    if (!file) {
        fprintf(stderr, "%s: %s\n", path, strerror(errno));
        return;
    }
    fprintf(file, "window %" PRIu32 " %" PRIu32 ", %s colours\n", d->width, d->height, d->smooth ? "vertex" : "face");
    fprintf(file, "faces that differ when drawn alone:");
    for (uint32_t i = 0; i < failure->alone_count; i++)
        fprintf(file, " %" PRIu32, failure->alone[i]);
    fprintf(file, "%s\n", failure->alone_count ? "" : " none");
    write_matrix(file, "modelview", &d->modelview);
    write_matrix(file, "projection", &d->projection);
    for (uint32_t face = 0; face < d->face_count; face++) {
        fprintf(file, "face %" PRIu32 "\n", face + 1);
        for (uint32_t c = d->face_offsets[face]; c < d->face_offsets[face + 1]; c++) {
            const zr_vec4 *p = &d->positions[d->indices[c]], *k = &d->colors[d->indices[c]];
            fprintf(file, "  position %a %a %a %a  colour %a %a %a\n", (double)p->x, (double)p->y, (double)p->z,
                    (double)p->w, (double)k->x, (double)k->y, (double)k->z);
        }
    }
    fclose(file);
}

void report_difference(const struct report_failure *failure)
{
    print_pixels(failure);
    if (!make_directories(failure->directory)) return;
    uint8_t *difference = difference_picture(failure);
    write_picture(failure, "want", failure->want->rgba);
    write_picture(failure, "got", failure->got->rgba);
    write_picture(failure, "diff", difference);
    write_numbers(failure);
    free(difference);
    printf("# pictures: %s/%s-%" PRIu64 "-*.png\n", failure->directory, failure->label, failure->number);
    fflush(stdout);
}
