#include "bench/versus/versus_llvmpipe.h"

#include <stdlib.h>
#include <string.h>

#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/likeness.h"
#include "bench/versus/sides.h"
#include "reference/compare.h"

enum { THREADS_MAX = 2 };

/* What a child works on. */
struct task {
    const struct work *work;
    int threads;
    bool wanted[WORK_VARIANTS_MAX][2]; /* without ids, and with them */
    bool wrong[BENCH_CHECKS_MAX];
};

/* ---- is it the same picture? ---- */

static size_t count_differing(const struct zr_frame *frame, const uint8_t *rgba, const float *depth, size_t *covered)
{
    size_t differing = 0;
    for (size_t i = 0; i < (size_t)frame->width * frame->height; i++) {
        bool equal = memcmp(rgba + 4 * i, frame->color + 4 * i, 4) == 0 && depth[i] == frame->window_depth[i];
        *covered += depth[i] < 1.0f;
        if (!equal && differing++ < 3)
            printf("# pixel %zu, %zu: want %02x%02x%02x depth %.9g, got %02x%02x%02x depth %.9g\n", i % frame->width,
                   i / frame->width, rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], (double)depth[i],
                   frame->color[4 * i], frame->color[4 * i + 1], frame->color[4 * i + 2],
                   (double)frame->window_depth[i]);
    }
    return differing;
}

/* One row a variant, whose note tells what was found. */
static bool compare_variants(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    const struct task *task = context;
    const struct drawing *drawing = &task->work->drawing;
    size_t pixels = (size_t)drawing->width * drawing->height;
    uint8_t *rgba = malloc(pixels * 4);
    float *depth = malloc(pixels * sizeof *depth);
    struct ours ours;
    struct theirs theirs;
    bool ok = rgba && depth && ours_open(&ours, THREADS_MAX) && theirs_open(&theirs, true, 1);
    struct variant variants[WORK_VARIANTS_MAX];
    int count = works_variants(task->work, variants);
    for (int i = 0; ok && i < count; i++) {
        struct row row = {.work = ""};
        struct reference_error error = {""};
        size_t covered = 0;
        works_variant_name(task->work, &variants[i], row.work, sizeof row.work);
        ours_take(&ours, task->work, &variants[i]);
        const struct zr_frame *frame = ours_draw(&ours, false);
        ok = frame && theirs_take(&theirs, task->work, &variants[i]) && theirs_draw(&theirs) &&
             reference_read(theirs.reference, rgba, depth, &error);
        if (!ok) break;
        size_t differing = count_differing(frame, rgba, depth, &covered);
        row.wrong = differing > 0 || covered == 0;
        snprintf(row.note, sizeof row.note, "%zu of %zu pixels differ from Mesa's, %zu covered", differing, pixels,
                 covered);
        sink_row(sink, &row);
    }
    free(rgba);
    free(depth);
    return ok;
}

/* ---- is it fast? ---- */

/* The result is a side's first frame of a turn, after the other side's frames have evicted its data from the caches.
 * The note has the next frame, too: the time in a stream of frames, in a process that does nothing else. */
enum { WITHOUT_IDS, WITH_IDS, THEIRS, OURS_NEXT, THEIRS_NEXT, SIDES };

struct sides {
    struct ours ours;
    struct theirs theirs;
    const bool *wanted; /* WITHOUT_IDS, WITH_IDS */
};

static bool draw_theirs(struct sides *sides, struct series *series)
{
    const double begin = now_ms();
    if (!theirs_draw(&sides->theirs)) return false;
    series_add(series, now_ms() - begin);
    return true;
}

static bool draw_ours(struct sides *sides, bool ids, struct series *series)
{
    const double begin = now_ms();
    if (!ours_draw(&sides->ours, ids)) return false;
    series_add(series, now_ms() - begin);
    return true;
}

static bool run_round(void *context, struct series *series)
{
    struct sides *sides = context;
    if (!draw_theirs(sides, &series[THEIRS]) || !draw_theirs(sides, &series[THEIRS_NEXT])) return false;
    for (int ids = WITHOUT_IDS; ids <= WITH_IDS; ids++)
        if (sides->wanted[ids] && !draw_ours(sides, ids == WITH_IDS, &series[ids])) return false;
    return draw_ours(sides, !sides->wanted[WITHOUT_IDS], &series[OURS_NEXT]);
}

/* What was timed is not what was compared to the last bit: fused multiply-adds, and of flat triangles another corner
 * that depth begins at, move it a little. All but a hundredth of what is seen must have the same colour, to 2 steps. */
static bool is_alike(const struct zr_frame *frame, struct theirs *theirs)
{
    struct likeness likeness;
    return theirs_draw(theirs) && likeness_find(frame, theirs->reference, 2, &likeness) && likeness.seen > 0 &&
           likeness.off <= likeness.seen / 100;
}

static void name_row(const struct task *task, const struct variant *variant, bool ids, struct row *row)
{
    char name[80];
    works_variant_name(task->work, variant, name, sizeof name);
    snprintf(row->work, sizeof row->work, "%s%s %dT %s", name, ids ? " ids" : "", task->threads, machine_isa_name());
}

static bool time_variants(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct task *task = context;
    struct sides sides;
    struct variant variants[WORK_VARIANTS_MAX];
    int count = works_variants(task->work, variants);
    if (!ours_open(&sides.ours, task->threads) || !theirs_open(&sides.theirs, false, task->threads)) return false;
    for (int i = 0; i < count; i++) {
        sides.wanted = task->wanted[i];
        if (!sides.wanted[WITHOUT_IDS] && !sides.wanted[WITH_IDS]) continue;
        ours_take(&sides.ours, task->work, &variants[i]);
        if (!theirs_take(&sides.theirs, task->work, &variants[i]) ||
            !series_run(series, SIDES, bench->rounds, run_round, &sides))
            return false;
        const struct zr_frame *frame = ours_draw(&sides.ours, false);
        bool alike = frame && is_alike(frame, &sides.theirs);
        for (int ids = WITHOUT_IDS; ids <= WITH_IDS; ids++) {
            if (!sides.wanted[ids]) continue;
            struct row row = {.ours_ms = series_median(&series[ids]),
                              .theirs_ms = series_median(&series[THEIRS]),
                              .wrong = task->wrong[i] || !alike};
            struct bar bar = works_bar(task->work, &variants[i]);
            if (ids == WITHOUT_IDS && machine_has_bars())
                row.bar = (struct bar){bar.must / machine_bar_divisor(), bar.goal / machine_bar_divisor()};
            const double next = series_median(&series[OURS_NEXT]), their_next = series_median(&series[THEIRS_NEXT]);
            if (ids == WITHOUT_IDS || !sides.wanted[WITHOUT_IDS])
                snprintf(row.note, sizeof row.note, "frame after it: %.3g, theirs %.3g ms, %.2fx", next, their_next,
                         their_next / next);
            name_row(task, &variants[i], ids == WITH_IDS, &row);
            sink_row(sink, &row);
        }
    }
    return true;
}

/* Fills task->wanted; false where nothing is. */
static bool choose(const struct bench *bench, struct task *task)
{
    struct variant variants[WORK_VARIANTS_MAX];
    int count = works_variants(task->work, variants);
    bool any = false;
    for (int i = 0; i < count; i++)
        for (int ids = 0; ids < 2; ids++) {
            struct row row;
            name_row(task, &variants[i], ids, &row);
            task->wanted[i][ids] = bench_wants(bench, row.work);
            any |= task->wanted[i][ids];
        }
    return any;
}

static void run_work(struct bench *bench, struct task *task)
{
    bool checked = false;
    for (task->threads = 1; task->threads <= THREADS_MAX; task->threads++) {
        if (!choose(bench, task)) continue;
        if (!bench->check_only)
            results_begin_table(&bench->results, "zr_render against llvmpipe: colour and float depth");
        if (!checked) bench_check_in_child(bench, compare_variants, task, task->wrong);
        checked = true;
        if (bench->check_only) return;
        bench_in_child(bench, time_variants, task, NULL);
    }
}

void versus_llvmpipe(struct bench *bench)
{
    for (int i = 0; i < WORKS; i++) {
        struct work work;
        if (!works_make((enum works)i, bench->models, &work)) {
            bench->results.failed = true;
        } else {
            struct task task = {.work = &work};
            run_work(bench, &task);
        }
        works_free(&work);
    }
}
