/* 16 samples per pixel against llvmpipe's picture of 4x4 the size, read back and averaged: the same bytes. */
#include <stdlib.h>
#include <string.h>

#include "bench/looks.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/sides.h"

enum { OURS, THEIRS, SIDES, THREADS_MAX = 2, SIDE = 4, ROWS_PER_RANGE = 16 };

/* Of two: culled and smooth, two-sided and flat. */
static const struct {
    struct variant variant;
    struct bar bar;
} rows[] = {{{WORK_GOURAUD, true}, {4, 8}}, {{WORK_FLAT, false}, {5.5, 8}}};
enum { ROWS = sizeof rows / sizeof *rows };

struct task {
    const struct work *work;
    int row, threads;
    bool wrong[BENCH_CHECKS_MAX];
};

static void name_row(const struct task *task, char *name, size_t size)
{
    char what[80];
    works_variant_name(task->work, &rows[task->row].variant, what, sizeof what);
    snprintf(name, size, "16 samples against llvmpipe: %.40s %dT %s", what, task->threads, machine_isa_name());
}

/* ---- both sides ---- */

struct sampling {
    struct ours ours;
    struct theirs theirs;
    uint32_t width, height;
    uint8_t *large, *small; /* theirs, RGBA */
    uint16_t *sums;         /* of each row of small: of each byte of a row of large */
};

static bool open_sides(struct sampling *s, const struct work *work, bool exact, int threads)
{
    *s = (struct sampling){.width = work->drawing.width, .height = work->drawing.height};
    s->small = malloc((size_t)s->width * s->height * 4);
    s->large = malloc((size_t)s->width * s->height * 4 * SIDE * SIDE);
    s->sums = malloc((size_t)s->width * s->height * 4 * SIDE * sizeof *s->sums);
    return s->small && s->large && s->sums && ours_open(&s->ours, threads) &&
           theirs_open(&s->theirs, exact, exact ? 1 : threads);
}

static void close_sides(struct sampling *s)
{
    ours_close(&s->ours);
    free(s->small);
    free(s->large);
    free(s->sums);
}

static bool take(struct sampling *s, const struct work *work, const struct variant *variant)
{
    struct reference_error error = {""};
    ours_take(&s->ours, work, variant);
    s->ours.subject.picture.side = SIDE;
    if (!theirs_take(&s->theirs, work, variant)) return false;
    return reference_resize(s->theirs.reference, s->width * SIDE, s->height * SIDE, false, &error) ||
           bench_complain("llvmpipe: %s", error.text);
}

static const struct zr_frame *draw_ours(struct sampling *s)
{
    static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
    return ours_render(&s->ours, &color, 1);
}

/* Half up. Two simple loops, which compilers make vectors of; rows are shared by all threads. */
static void average_rows(void *context, size_t begin, size_t end)
{
    const struct sampling *s = context;
    const size_t bytes = (size_t)s->width * SIDE * 4;
    for (size_t y = begin; y < end; y++) {
        const uint8_t *from = s->large + y * SIDE * bytes;
        uint16_t *sums = s->sums + y * bytes;
        uint8_t *to = s->small + y * s->width * 4;
        for (size_t i = 0; i < bytes; i++)
            sums[i] = (uint16_t)(from[i] + from[bytes + i] + from[2 * bytes + i] + from[3 * bytes + i]);
        for (size_t x = 0; x < s->width; x++, sums += SIDE * 4)
            for (size_t c = 0; c < 4; c++)
                to[4 * x + c] = (uint8_t)((sums[c] + sums[4 + c] + sums[8 + c] + sums[12 + c] + 8) >> 4);
    }
}
_Static_assert(SIDE == 4, "rows are added one by one, and 16 is a shift");

static bool draw_theirs(struct sampling *s)
{
    struct reference_error error = {""};
    if (!theirs_draw(&s->theirs) || !reference_read(s->theirs.reference, s->large, NULL, &error)) return false;
    zr_team_ranges(s->ours.team, s->height, ROWS_PER_RANGE, average_rows, s);
    return true;
}

/* ---- is it the same picture? ---- */

static size_t count_differing(const struct zr_frame *frame, const uint8_t *rgba)
{
    size_t differing = 0;
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++)
        differing += memcmp(rgba + 4 * i, frame->color + 4 * i, 4) != 0;
    return differing;
}

static bool compare(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    const struct task *task = context;
    struct sampling s;
    bool ok = open_sides(&s, task->work, true, THREADS_MAX);
    for (int i = 0; ok && i < ROWS; i++) {
        struct row row = {.work = ""};
        const struct zr_frame *frame = NULL;
        works_variant_name(task->work, &rows[i].variant, row.work, sizeof row.work);
        ok = take(&s, task->work, &rows[i].variant) && draw_theirs(&s) && (frame = draw_ours(&s));
        if (!ok) break;
        const size_t differing = count_differing(frame, s.small);
        row.wrong = differing > 0 || frame->covered_samples == 0;
        snprintf(row.note, sizeof row.note, "16 samples: %zu pixels differ from Mesa's, %llu samples covered",
                 differing, (unsigned long long)frame->covered_samples);
        sink_row(sink, &row);
    }
    close_sides(&s);
    return ok;
}

/* ---- is it fast? ---- */

static bool run_round(void *context, struct series *series)
{
    struct sampling *s = context;
    double begin = now_ms();
    if (!draw_ours(s)) return false;
    series_add(&series[OURS], now_ms() - begin);
    begin = now_ms();
    if (!draw_theirs(s)) return false;
    series_add(&series[THEIRS], now_ms() - begin);
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct task *task = context;
    struct sampling s;
    const bool ok = open_sides(&s, task->work, false, task->threads) &&
                    take(&s, task->work, &rows[task->row].variant) &&
                    series_run(series, SIDES, bench->rounds, run_round, &s);
    struct row row = {.ours_ms = series_median(&series[OURS]),
                      .theirs_ms = series_median(&series[THEIRS]),
                      .wrong = task->wrong[task->row]};
    if (machine_has_bars())
        row.bar = (struct bar){rows[task->row].bar.must / machine_bar_divisor(),
                               rows[task->row].bar.goal / machine_bar_divisor()};
    name_row(task, row.work, sizeof row.work);
    close_sides(&s);
    if (ok) sink_row(sink, &row);
    return ok;
}

void looks_against_llvmpipe(struct bench *bench)
{
    struct work work;
    struct task task = {.work = &work};
    bool checked = false;
    if (!works_make(WORK_BUNNY_SMALL, bench->models, &work)) bench->results.failed = true;
    for (task.threads = 1; work.corners && task.threads <= THREADS_MAX; task.threads++)
        for (task.row = 0; task.row < ROWS; task.row++) {
            char name[ROW_NAME_SIZE];
            name_row(&task, name, sizeof name);
            if (!bench_wants(bench, name)) continue;
            if (!checked) bench_check_in_child(bench, compare, &task, task.wrong);
            checked = true;
            if (bench->check_only) continue;
            results_begin_table(&bench->results, "16 samples a pixel against llvmpipe at 4x4 the size, averaged");
            bench_in_child(bench, measure, &task, NULL);
        }
    works_free(&work);
}
