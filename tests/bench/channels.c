/* Depth in scene units against depth in the window, which is a copy of the z-buffer. */
#include "bench/growth.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/sides.h"

enum { WINDOW, UNITS, SIDES };

static const struct zr_output outputs[SIDES][2] = {{{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                                    {.channel = ZR_CHANNEL_WINDOW_DEPTH, .encoding = ZR_ENCODING_NPY}},
                                                   {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                                    {.channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_NPY}}};

static const enum works measured[] = {WORK_BUNNY, WORK_DENSE, WORK_CUBE};

static void name_row(const struct work *work, const struct variant *variant, char *name, size_t size)
{
    char drawn[80];
    works_variant_name(work, variant, drawn, sizeof drawn);
    snprintf(name, size, "metric depth: %.60s 1T %s", drawn, machine_isa_name());
}

static bool run_round(void *context, struct series *series)
{
    for (int side = WINDOW; side < SIDES; side++) {
        double begin = now_ms();
        if (!ours_render(context, outputs[side], 2)) return false;
        series_add(&series[side], now_ms() - begin);
    }
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct work *work = context;
    const struct variant variant = {WORK_GOURAUD, true};
    struct ours ours;
    if (!ours_open(&ours, 1)) return false;
    ours_take(&ours, work, &variant);
    if (!series_run(series, SIDES, bench->rounds, run_round, &ours)) return false;
    struct row row = {.ours_ms = series_median(&series[UNITS]), .theirs_ms = series_median(&series[WINDOW])};
    name_row(work, &variant, row.work, sizeof row.work);
    sink_row(sink, &row);
    return true;
}

void growth_of_channels(struct bench *bench)
{
    if (bench->check_only) return;
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++) {
        struct work work;
        char name[ROW_NAME_SIZE];
        if (!works_make(measured[i], bench->models, &work)) bench->results.failed = true;
        name_row(&work, &(struct variant){WORK_GOURAUD, true}, name, sizeof name);
        if (work.corners && bench_wants(bench, name)) {
            results_begin_table(&bench->results, "channels: \"theirs\" is ours with the window's depth");
            bench_in_child(bench, measure, &work, NULL);
        }
        works_free(&work);
    }
}
