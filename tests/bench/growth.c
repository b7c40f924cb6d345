#include "bench/growth.h"

#include "bench/input/meshes.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/sides.h"

/* At most 1.1 times what is in proportion. */
static const struct bar growth_bar = {1 / 1.1, 0};

static const struct variant drawn = {WORK_GOURAUD, true};

/* 4 * rings * (rings - 1) triangles each. */
static const struct {
    const char *name;
    uint32_t rings;
} counts[] = {{"1 k", 16}, {"10 k", 51}, {"100 k", 159}, {"1 M", 501}, {"10 M", 1582}};
enum { COUNTS = sizeof counts / sizeof *counts };

static const uint32_t sides[] = {256, 512, 1024, 2048, 4096, 8192};
enum { SIDES = sizeof sides / sizeof *sides };

static int steps_of(bool of_pixels)
{
    return of_pixels ? SIDES : COUNTS;
}

struct step {
    bool of_pixels;
    int number;
};

static void name_row(const struct bench *bench, const struct step *step, char *name, size_t size)
{
    int i = step->number;
    if (step->of_pixels)
        snprintf(name, size, "growth: %ux%u pixels, %s Gouraud 1T %s", sides[i], sides[i], works_animal(bench->models),
                 machine_isa_name());
    else
        snprintf(name, size, "growth: %s triangles, 1080p Gouraud 1T %s", counts[i].name, machine_isa_name());
}

/* ---- one size ---- */

static bool run_round(void *context, struct series *series)
{
    double begin = now_ms();
    bool ok = ours_draw(context, false);
    series_add(series, now_ms() - begin);
    return ok;
}

static double time_of(const struct work *work, int asked)
{
    static struct series series;
    struct ours ours;
    if (!ours_open(&ours, 1)) return 0.0;
    ours_take(&ours, work, &drawn);
    bool ok = series_run(&series, 1, asked, run_round, &ours);
    ours_close(&ours);
    return ok ? series_median(&series) : 0.0;
}

/* How much of it there is, and how long it takes; 0 on failure. */
static double measure_size(const struct bench *bench, const struct step *step, double *units)
{
    struct work work = {.name = ""};
    double ms = 0;
    bool ok = true;
    if (step->of_pixels) {
        ok = works_make(WORK_BUNNY, bench->models, &work);
        works_look(&work, sides[step->number], sides[step->number]);
        *units = (double)sides[step->number] * sides[step->number];
    } else {
        meshes_ball(&work.drawing, counts[step->number].rings);
        works_look(&work, 1920, 1080);
        *units = work.drawing.face_count;
        ok = !work.drawing.failed;
    }
    work.drawing.smooth = true;
    if (ok) ms = time_of(&work, bench->rounds);
    works_free(&work);
    return ms;
}

struct task {
    bool of_pixels;
    bool wanted[COUNTS + SIDES];
};

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    const struct task *task = context;
    double last_ms = 0, last_units = 0;
    for (int i = 0; i < steps_of(task->of_pixels); i++) {
        bool next_wanted = i + 1 < steps_of(task->of_pixels) && task->wanted[i + 1];
        struct step step = {.of_pixels = task->of_pixels, .number = i};
        double units = 0;
        if (!task->wanted[i] && !next_wanted) continue;
        double ms = measure_size(bench, &step, &units);
        if (ms <= 0) return false;
        struct row row = {.ours_ms = ms, .theirs_ms = last_ms > 0 ? last_ms * units / last_units : 0};
        if (last_ms > 0) row.bar = growth_bar;
        name_row(bench, &step, row.work, sizeof row.work);
        snprintf(row.note, sizeof row.note, "%.4g ns a %s", ms * 1e6 / units, task->of_pixels ? "pixel" : "triangle");
        if (task->wanted[i]) sink_row(sink, &row);
        last_ms = ms;
        last_units = units;
    }
    return true;
}

void growth_of_work(struct bench *bench)
{
    if (bench->check_only) return;
    for (int of_pixels = 0; of_pixels < 2; of_pixels++) {
        struct task task = {.of_pixels = of_pixels};
        bool any = false;
        for (int i = 0; i < steps_of(of_pixels); i++) {
            struct step step = {.of_pixels = of_pixels, .number = i};
            char name[ROW_NAME_SIZE];
            name_row(bench, &step, name, sizeof name);
            task.wanted[i] = bench_wants(bench, name);
            any |= task.wanted[i];
        }
        if (!any) continue;
        results_begin_table(&bench->results, "growth: \"theirs\" is the row above, in proportion");
        bench_in_child(bench, measure, &task, NULL);
    }
}
