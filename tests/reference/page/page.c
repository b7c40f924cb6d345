#include "reference/page/page.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reference/page/report.h"
#include "support/pictures/png.h"

/* Pictures are averaged down by a whole number until they are no wider than this. */
enum { THUMBNAIL_WIDTH = 240, CAPTION_SIZE = 160 };

struct page {
    char *path, *title, *renderer;
    enum compare_bar bar;
    bool plain;
    char *rows, *refused, *gallery; /* of the streams below */
    size_t rows_size, refused_size, gallery_size;
    FILE *rows_stream, *refused_stream, *gallery_stream;
    int refused_count, row_count;
    char caption[CAPTION_SIZE]; /* of the figure that is open, "" where none is */
};

struct page *page_open(const struct page_options *options)
{
    struct page *page = calloc(1, sizeof *page);
    if (!page) exit(VERDICT_UNPROVED);
    page->bar = options->bar;
    page->plain = options->plain;
    page->path = strdup(options->path);
    page->title = strdup(options->title);
    page->renderer = strdup(options->renderer);
    page->rows_stream = open_memstream(&page->rows, &page->rows_size);
    page->refused_stream = open_memstream(&page->refused, &page->refused_size);
    page->gallery_stream = open_memstream(&page->gallery, &page->gallery_size);
    if (page->path && page->title && page->renderer && page->rows_stream && page->refused_stream &&
        page->gallery_stream)
        return page;
    fprintf(stderr, "out of memory\n");
    exit(VERDICT_UNPROVED);
}

/* ---- text ---- */

static void put_text(FILE *out, const char *text)
{
    for (; *text; text++)
        if (strchr("<>&\"", *text))
            fprintf(out, "&#%d;", *text);
        else
            fputc(*text, out);
}

/* In groups of three digits. */
static void put_number(FILE *out, uint64_t number)
{
    char digits[24];
    int length = snprintf(digits, sizeof digits, "%" PRIu64, number);
    for (int i = 0; i < length; i++)
        fprintf(out, "%s%c", i && (length - i) % 3 == 0 ? "&#8239;" : "", digits[i]);
}

static void put_cell(FILE *out, uint64_t number, bool is_difference)
{
    fprintf(out, "<td class=\"%s\">", !is_difference ? "n" : number ? "n some" : "n zero");
    put_number(out, number);
    fputs("</td>", out);
}

static const char *mark_class(enum verdict verdict)
{
    return verdict == VERDICT_EQUAL ? "good" : "bad";
}

static const char *mark_word(enum compare_bar bar, enum verdict verdict)
{
    if (verdict == VERDICT_EQUAL) return bar == COMPARE_EXACT ? "equal" : "explained";
    return verdict == VERDICT_DIFFERENT ? "different" : "unproved";
}

/* ---- rows ---- */

static void put_columns(FILE *out, enum compare_bar bar)
{
    fputs("<tr><th></th><th></th><th>triangles</th><th>pixels</th><th>covered</th><th>clipped</th><th>coverage</th>",
          out);
    if (bar != COMPARE_EXACT) fputs("<th>at an edge</th>", out);
    if (bar == COMPARE_SECOND_OPINION) fputs("<th>at a tie</th>", out);
    if (bar != COMPARE_EXACT) fputs("<th>farthest, px</th>", out);
    fputs("<th>depth</th><th>max ulp</th>", out);
    if (bar == COMPARE_TRANSFORM) fputs("<th>px of slope</th><th>astray</th>", out);
    fputs("<th>colour</th><th>max LSB</th></tr>\n", out);
}

static void put_row(FILE *out, enum compare_bar bar, const char *name, enum verdict verdict, const struct tally *tally)
{
    const struct comparison *c = &tally->comparison;
    bool exact = bar == COMPARE_EXACT;
    fprintf(out, "<tr><td><span class=\"%s\">%s</span></td><th>", mark_class(verdict), mark_word(bar, verdict));
    put_text(out, name);
    fputs("</th>", out);
    put_cell(out, tally->triangles, false);
    put_cell(out, c->pixels, false);
    put_cell(out, c->visible, false);
    put_cell(out, tally->clipped, false);
    put_cell(out, c->coverage, exact);
    if (!exact) put_cell(out, c->at_edge, false);
    if (bar == COMPARE_SECOND_OPINION) put_cell(out, c->at_tie, false);
    if (!exact) fprintf(out, "<td class=\"n\">%.5f</td>", c->edge_max_px);
    put_cell(out, c->depth, exact);
    put_cell(out, c->depth_max_ulp, exact);
    if (bar == COMPARE_TRANSFORM) {
        fprintf(out, "<td class=\"n\">%.4f</td>", c->depth_max_px);
        put_cell(out, c->depth_astray, true);
    }
    put_cell(out, c->color, exact);
    put_cell(out, c->color_max_lsb, exact);
    fputs("</tr>\n", out);
}

void page_row(struct page *page, const char *name, enum verdict verdict, const struct tally *tally)
{
    page->row_count++;
    put_row(page->rows_stream, page->bar, name, verdict, tally);
}

void page_refused(struct page *page, const char *name, const char *reason)
{
    page->refused_count++;
    fputs("<li><b>", page->refused_stream);
    put_text(page->refused_stream, name);
    fputs("</b>: ", page->refused_stream);
    put_text(page->refused_stream, reason);
    fputs("</li>\n", page->refused_stream);
}

/* ---- pictures ---- */

static void put_base64(FILE *out, const uint8_t *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        uint32_t group = (uint32_t)bytes[i] << 16 | (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0u) |
                         (left > 2 ? (uint32_t)bytes[i + 2] : 0u);
        fputc(digits[group >> 18], out);
        fputc(digits[group >> 12 & 63], out);
        fputc(left > 1 ? digits[group >> 6 & 63] : '=', out);
        fputc(left > 2 ? digits[group & 63] : '=', out);
    }
}

/* What a block of factor x factor pixels becomes. */
enum shrinking {
    MEAN,
    BRIGHTEST /* of a picture of differences: one pixel in a thousand must not vanish */
};

static void shrink_block(const uint8_t *block, uint32_t width, uint32_t factor, enum shrinking shrinking,
                         uint8_t out[4])
{
    uint32_t sums[4] = {0, 0, 0, 0}, most = 0, count = factor * factor;
    for (size_t k = 0; k < count; k++) {
        const uint8_t *pixel = block + (k / factor * width + k % factor) * 4;
        uint32_t brightness = (uint32_t)pixel[0] + pixel[1] + pixel[2];
        for (int channel = 0; channel < 4; channel++)
            sums[channel] += pixel[channel];
        if (shrinking == BRIGHTEST && brightness >= most) memcpy(out, pixel, 4);
        most = brightness > most ? brightness : most;
    }
    for (int channel = 0; shrinking == MEAN && channel < 4; channel++)
        out[channel] = (uint8_t)((sums[channel] + count / 2) / count);
}

static void put_picture(FILE *out, const char *label, const uint8_t *rgba, uint32_t width, uint32_t height,
                        enum shrinking shrinking)
{
    uint32_t factor = (width + THUMBNAIL_WIDTH - 1) / THUMBNAIL_WIDTH;
    if (height < factor) factor = 1;
    uint32_t small_width = width / factor, small_height = height / factor;
    size_t size = 0;
    uint8_t *small = malloc((size_t)small_width * small_height * 4);
    for (size_t i = 0; small && rgba && i < (size_t)small_width * small_height; i++)
        shrink_block(rgba + (i / small_width * width + i % small_width) * factor * 4, width, factor, shrinking,
                     small + 4 * i);
    uint8_t *png = small && rgba ? png_memory_write(small, small_width, small_height, &size) : NULL;
    if (png) {
        fprintf(out, "<img alt=\"%s\" title=\"%s\" src=\"data:image/png;base64,", label, label);
        put_base64(out, png, size);
        fputs("\">", out);
    }
    free(png);
    free(small);
}

static void end_figure(struct page *page)
{
    if (!page->caption[0]) return;
    fputs("<figcaption>", page->gallery_stream);
    put_text(page->gallery_stream, page->caption);
    fputs("</figcaption></figure>\n", page->gallery_stream);
    page->caption[0] = 0;
}

void page_picture(struct page *page, const char *caption, enum verdict verdict, const struct harness_pictures *pictures)
{
    if (!pictures->frame || (page->plain && verdict == VERDICT_EQUAL)) return;
    FILE *out = page->gallery_stream;
    uint32_t width = pictures->frame->width, height = pictures->frame->height;
    if (strncmp(page->caption, caption, CAPTION_SIZE - 1) != 0) {
        end_figure(page);
        snprintf(page->caption, sizeof page->caption, "%s", caption);
        fputs("<figure>", out);
    }
    put_picture(out, "ours", pictures->got.rgba, width, height, MEAN);
    if (verdict == VERDICT_EQUAL) return;
    uint8_t *difference = report_difference_picture(pictures);
    put_picture(out, "the reference", pictures->want.rgba, width, height, MEAN);
    put_picture(out, "the difference", difference, width, height, BRIGHTEST);
    fputs("<p class=\"soft\">ours, the reference, the difference: red another face, yellow depth, cyan colour</p>",
          out);
    free(difference);
}

/* ---- closing ---- */

static void put_section(FILE *out, const struct page *page, enum verdict verdict, const struct tally *total)
{
    static const char *const bars[] = {
        [COMPARE_EXACT] = "Every pixel must be the same: its owner, its depth to the last bit, its colour to the last "
                          "bit.",
        [COMPARE_SECOND_OPINION] =
            "An independent rasterizer. Where it gives a pixel to another face, an edge of one of the two must be "
            "within 1/256 px of the pixel's centre, or both faces must lie at one depth as far as float can tell.",
        [COMPARE_TRANSFORM] = "The reference gets positions that were transformed apart, in double, one matrix after "
                              "the other. At most one pixel in a million may change its owner, each within 1/256 px of "
                              "an edge or where both faces lie at one depth; depth stays within 1 ulp + 0.1 px of "
                              "the face's slope."};
    fputs("<section><h2>", out);
    put_text(out, page->title);
    fprintf(out,
            " <span class=\"%s\">%s</span></h2>\n<p>%s</p>\n<p class=\"with\">Compared with: ", mark_class(verdict),
            mark_word(page->bar, verdict), bars[page->bar]);
    put_text(out, page->renderer);
    fputs("</p>\n", out);
    if (page->gallery_size) fprintf(out, "<div class=\"gallery\">%s</div>\n", page->gallery);
    fputs("<div class=\"wide\"><table>\n", out);
    put_columns(out, page->bar);
    fputs(page->rows, out);
    if (page->row_count > 1) {
        fputs("<tbody class=\"sum\">", out);
        put_row(out, page->bar, "in all", verdict, total);
        fputs("</tbody>", out);
    }
    fputs("</table></div>\n", out);
    if (page->refused_count)
        fprintf(out, "<details><summary>%d left out, and why</summary><ul>\n%s</ul></details>\n", page->refused_count,
                page->refused);
    fputs("</section>\n", out);
}

static void put_summary(FILE *out, const struct page *page, enum verdict verdict, const struct tally *total)
{
    const struct comparison *c = &total->comparison;
    fprintf(out, "<tr><td><span class=\"%s\">%s</span></td><th>", mark_class(verdict), mark_word(page->bar, verdict));
    put_text(out, page->title);
    fputs("</th>", out);
    put_cell(out, total->pictures, false);
    put_cell(out, total->triangles, false);
    put_cell(out, c->visible, false);
    put_cell(out, c->coverage, page->bar == COMPARE_EXACT);
    put_cell(out, c->depth, page->bar == COMPARE_EXACT);
    put_cell(out, c->color, page->bar == COMPARE_EXACT);
    fputs("<td>", out);
    put_text(out, page->renderer);
    fputs("</td></tr>\n", out);
}

static bool write_file(const struct page *page, const char *suffix,
                       void (*put)(FILE *, const struct page *, enum verdict, const struct tally *),
                       enum verdict verdict, const struct tally *total)
{
    char path[600];
    snprintf(path, sizeof path, "%s%s", page->path, suffix);
    FILE *file = fopen(path, "w");
    if (file) put(file, page, verdict, total);
    if (file && fclose(file) == 0) return true;
    fprintf(stderr, "%s: %s\n", path, strerror(errno));
    return false;
}

bool page_close(struct page *page, enum verdict verdict, const struct tally *total)
{
    if (!page) return true;
    end_figure(page);
    fclose(page->rows_stream);
    fclose(page->refused_stream);
    fclose(page->gallery_stream);
    bool ok =
        write_file(page, "", put_section, verdict, total) && write_file(page, ".row", put_summary, verdict, total);
    free(page->rows);
    free(page->refused);
    free(page->gallery);
    free(page->path);
    free(page->title);
    free(page->renderer);
    free(page);
    return ok;
}
