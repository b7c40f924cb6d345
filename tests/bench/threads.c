/* More threads against one. */
#include <string.h>

#include "bench/growth.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/sides.h"

enum { WARM_UP = 2, THREADS_MAX = 64 };

static const struct bar two_bar = {1.8, 1.95};

static const enum works measured[] = {WORK_FILL_BACK_FIRST, WORK_FILL_FRONT_FIRST, WORK_DENSE, WORK_DENSE_SMALL};

struct task {
    const struct work *work;
    int threads;
    bool wanted[WORK_SHADES];
};

static struct variant variant_of(const struct work *work, int shade)
{
    return (struct variant){(enum work_shade)shade, work->culling != WORK_NOT_CULLED};
}

static void name_row(const struct task *task, int shade, char *name, size_t size)
{
    char drawn[80];
    struct variant variant = variant_of(task->work, shade);
    works_variant_name(task->work, &variant, drawn, sizeof drawn);
    snprintf(name, size, "%dT against 1T: %.70s %s", task->threads, drawn, machine_isa());
}

static bool run_round(struct ours *one, struct ours *more, struct series *one_ms, struct series *more_ms)
{
    double begin = now_ms();
    if (!ours_draw(one, false)) return false;
    double middle = now_ms();
    if (!ours_draw(more, false)) return false;
    series_add(one_ms, middle - begin);
    series_add(more_ms, now_ms() - middle);
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series one_ms, more_ms;
    const struct task *task = context;
    struct ours one, more;
    bool ok = ours_open(&one, 1) && ours_open(&more, task->threads);
    for (int shade = 0; ok && shade < WORK_SHADES; shade++) {
        struct variant variant = variant_of(task->work, shade);
        double round_ms = 0;
        if (!task->wanted[shade]) continue;
        ours_take(&one, task->work, &variant);
        ours_take(&more, task->work, &variant);
        for (int i = 0; ok && i < WARM_UP; i++) {
            double begin = now_ms();
            ok = run_round(&one, &more, &one_ms, &more_ms);
            round_ms = now_ms() - begin;
        }
        one_ms.count = more_ms.count = 0;
        int rounds = series_rounds(bench->rounds, round_ms);
        for (int i = 0; ok && i < rounds; i++)
            ok = run_round(&one, &more, &one_ms, &more_ms);
        struct row row = {.ours_ms = series_median(&more_ms), .theirs_ms = series_median(&one_ms)};
        if (task->threads == 2) row.bar = two_bar;
        name_row(task, shade, row.work, sizeof row.work);
        if (ok) sink_row(sink, &row);
    }
    return ok;
}

void growth_of_threads(struct bench *bench)
{
    bool heading = false;
    int cores = machine_cores() < THREADS_MAX ? machine_cores() : THREADS_MAX;
    if (bench->check_only) return;
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++) {
        struct work work;
        struct task task = {.work = &work};
        if (!works_make(measured[i], bench->models, &work)) bench->results.failed = true;
        for (task.threads = 2; work.corners && task.threads <= cores; task.threads *= 2) {
            bool any = false;
            for (int shade = 0; shade < WORK_SHADES; shade++) {
                char name[ROW_NAME_SIZE];
                name_row(&task, shade, name, sizeof name);
                task.wanted[shade] = bench_wants(bench, name);
                any |= task.wanted[shade];
            }
            if (any && !heading) results_print_heading("threads: \"theirs\" is ours on 1 thread");
            heading |= any;
            if (any) bench_in_child(bench, measure, &task, NULL);
        }
        works_free(&work);
    }
}
