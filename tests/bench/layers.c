#include "bench/layers.h"

#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/sides.h"
#include "raster/fragments.h"

enum { OURS, THEIRS, OPAQUE, SIDES, THREADS_MAX = 2 };

/* Of llvmpipe, which sorts nothing. */
static const struct bar BAR = {2.0, 4.0};

struct task {
    struct work work;
    int threads;
};

static void name_row(const struct task *task, char *name, size_t size)
{
    const struct variant flat = {WORK_FLAT, false};
    char what[80];
    works_variant_name(&task->work, &flat, what, sizeof what);
    snprintf(name, size, "layers: %.48s %dT %s", what, task->threads, machine_isa_name());
}

struct blending {
    struct ours ours;
    struct theirs theirs;
};

static bool draw_ours(struct blending *b, enum zr_alpha_mode mode, struct series *series)
{
    static const struct zr_output color = {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG};
    const double begin = now_ms();
    b->ours.subject.materials[0].alpha_mode = mode;
    if (!ours_render(&b->ours, &color, 1)) return false;
    series_add(series, now_ms() - begin);
    return true;
}

static bool run_round(void *context, struct series *series)
{
    struct blending *b = context;
    const double begin = now_ms();
    if (!theirs_draw(&b->theirs)) return false;
    series_add(&series[THEIRS], now_ms() - begin);
    return draw_ours(b, ZR_ALPHA_BLEND, &series[OURS]) && draw_ours(b, ZR_ALPHA_OPAQUE, &series[OPAQUE]);
}

/* Of all pixels. */
static double count_fragments(struct blending *b)
{
    static const struct zr_output layers = {.channel = ZR_CHANNEL_LAYERS, .encoding = ZR_ENCODING_NPY};
    const struct zr_frame *frame = ours_render(&b->ours, &layers, 1);
    double sum = 0.0;
    for (size_t i = 0; frame && i < (size_t)frame->width * frame->height; i++)
        sum += (double)((const uint32_t *)frame->channels[ZR_CHANNEL_LAYERS])[i];
    return sum;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct task *task = context;
    const struct variant flat = {WORK_FLAT, false};
    struct blending b;
    if (!ours_open(&b.ours, task->threads) || !theirs_open(&b.theirs, false, task->threads)) return false;
    for (uint32_t i = 0; i < task->work.drawing.position_count; i++)
        task->work.drawing.colors[i].w = 0.5f;
    ours_take(&b.ours, &task->work, &flat);
    const bool ok = theirs_take(&b.theirs, &task->work, &flat);
    b.theirs.arrays.blended = true;
    if (!ok || !series_run(series, SIDES, bench->rounds, run_round, &b)) return false;
    struct row row = {.ours_ms = series_median(&series[OURS]), .theirs_ms = series_median(&series[THEIRS])};
    row.bar = (struct bar){BAR.must / machine_bar_divisor(), BAR.goal / machine_bar_divisor()};
    const double fragments = count_fragments(&b);
    snprintf(row.note, sizeof row.note, "%.1f M fragments of %zu bytes, %.1f ns each; opaque %.3g ms", fragments / 1e6,
             sizeof(uint64_t), row.ours_ms * 1e6 / fragments, series_median(&series[OPAQUE]));
    row.wrong = !(fragments > 0.0);
    name_row(task, row.work, sizeof row.work);
    ours_close(&b.ours);
    sink_row(sink, &row);
    return true;
}

void layers_against_llvmpipe(struct bench *bench)
{
    struct task task;
    if (!works_make(WORK_DENSE, bench->models, &task.work)) bench->results.failed = true;
    for (task.threads = 1; task.work.corners && task.threads <= THREADS_MAX; task.threads++) {
        char name[ROW_NAME_SIZE];
        name_row(&task, name, sizeof name);
        if (!bench_wants(bench, name) || bench->check_only) continue;
        results_begin_table(&bench->results,
                            "every layer sorted and blended, against llvmpipe's blending as they come");
        bench_in_child(bench, measure, &task, NULL);
    }
    works_free(&task.work);
}
