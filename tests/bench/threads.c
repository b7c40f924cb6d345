/* More threads against one, and beside it as many pictures at once, each on one thread. */
#include "bench/growth.h"
#include "bench/http/crowd.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/sides.h"

/* A picture on one thread, on more, and as many at once. */
enum { ONE, MORE, AT_ONCE, SIDES };
enum { THREADS_MAX = 64 };

static const struct bar two_bar = {1.8, 1.95};

static const enum works measured[] = {WORK_FILL_BACK_FIRST, WORK_FILL_FRONT_FIRST, WORK_DENSE, WORK_DENSE_SMALL};

struct task {
    const struct work *work;
    int threads;
    bool wanted[WORK_SHADES][SIDES];
};

struct renderers {
    struct ours ours[2]; /* ONE, MORE */
    struct crowd *crowd; /* AT_ONCE */
};

static struct variant variant_of(const struct work *work, int shade)
{
    return (struct variant){(enum work_shade)shade, work->culling != WORK_NOT_CULLED};
}

static void name_row(const struct task *task, int shade, int side, char *name, size_t size)
{
    const char *what = side == AT_ONCE ? " at once, 1T" : "T against 1T";
    char drawn[80];
    struct variant variant = variant_of(task->work, shade);
    works_variant_name(task->work, &variant, drawn, sizeof drawn);
    snprintf(name, size, "%d%s: %.60s %s", task->threads, what, drawn, machine_isa_name());
}

static bool run_round(void *context, struct series *series)
{
    struct renderers *renderers = context;
    for (int side = ONE; side <= MORE; side++) {
        double begin = now_ms();
        if (!ours_draw(&renderers->ours[side], false)) return false;
        series_add(&series[side], now_ms() - begin);
    }
    double took_ms = crowd_draw(renderers->crowd);
    series_add(&series[AT_ONCE], took_ms);
    return took_ms >= 0;
}

/* The time of one picture on one thread, and of what is measured against it: of pictures at once, that from the first
 * one's begin to the last one's end, divided by their number. */
static struct row make_row(const struct task *task, int shade, int side, const struct series *series)
{
    const int pictures = side == AT_ONCE ? task->threads : 1;
    struct row row = {.ours_ms = series_median(&series[side]) / pictures, .theirs_ms = series_median(&series[ONE])};
    if (side == MORE && task->threads == 2) row.bar = two_bar;
    if (side == AT_ONCE)
        snprintf(row.note, sizeof row.note, "%d pictures, 1T each: their time by their number", pictures);
    name_row(task, shade, side, row.work, sizeof row.work);
    return row;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct task *task = context;
    struct renderers renderers = {.crowd = crowd_open(task->threads)};
    bool ok = ours_open(&renderers.ours[ONE], 1) && ours_open(&renderers.ours[MORE], task->threads) && renderers.crowd;
    for (int shade = 0; ok && shade < WORK_SHADES; shade++) {
        struct variant variant = variant_of(task->work, shade);
        if (!task->wanted[shade][MORE] && !task->wanted[shade][AT_ONCE]) continue;
        for (int side = ONE; side <= MORE; side++)
            ours_take(&renderers.ours[side], task->work, &variant);
        crowd_take(renderers.crowd, task->work, &variant);
        ok = series_run(series, SIDES, bench->rounds, run_round, &renderers);
        for (int side = MORE; ok && side < SIDES; side++) {
            struct row row = make_row(task, shade, side, series);
            if (task->wanted[shade][side]) sink_row(sink, &row);
        }
    }
    return ok;
}

/* Notes which rows are wanted. False where none is. */
static bool choose_rows(const struct bench *bench, struct task *task)
{
    bool any = false;
    for (int shade = 0; shade < WORK_SHADES; shade++) {
        for (int side = MORE; side < SIDES; side++) {
            char name[ROW_NAME_SIZE];
            name_row(task, shade, side, name, sizeof name);
            task->wanted[shade][side] = bench_wants(bench, name);
            any |= task->wanted[shade][side];
        }
    }
    return any;
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
            if (!choose_rows(bench, &task)) continue;
            results_begin_table(&bench->results, "threads: \"theirs\" is ours on 1 thread");
            bench_in_child(bench, measure, &task, NULL);
        }
        works_free(&work);
    }
}
