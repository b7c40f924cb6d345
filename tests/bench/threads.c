/* More threads against one. */
#include "bench/growth.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/sides.h"

enum { ONE, MORE, SIDES };
enum { THREADS_MAX = 64 };

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

static bool run_round(void *context, struct series *series)
{
    struct ours *ours = context;
    for (int side = ONE; side < SIDES; side++) {
        double begin = now_ms();
        if (!ours_draw(&ours[side], false)) return false;
        series_add(&series[side], now_ms() - begin);
    }
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct task *task = context;
    struct ours ours[SIDES];
    bool ok = ours_open(&ours[ONE], 1) && ours_open(&ours[MORE], task->threads);
    for (int shade = 0; ok && shade < WORK_SHADES; shade++) {
        struct variant variant = variant_of(task->work, shade);
        if (!task->wanted[shade]) continue;
        for (int side = ONE; side < SIDES; side++)
            ours_take(&ours[side], task->work, &variant);
        ok = series_run(series, SIDES, bench->rounds, run_round, ours);
        struct row row = {.ours_ms = series_median(&series[MORE]), .theirs_ms = series_median(&series[ONE])};
        if (task->threads == 2) row.bar = two_bar;
        name_row(task, shade, row.work, sizeof row.work);
        if (ok) sink_row(sink, &row);
    }
    return ok;
}

void growth_of_threads(struct bench *bench)
{
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
            if (!any) continue;
            results_begin_table(&bench->results, "threads: \"theirs\" is ours on 1 thread");
            bench_in_child(bench, measure, &task, NULL);
        }
        works_free(&work);
    }
}
