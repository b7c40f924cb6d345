#include "bench/versus/versus_libpng.h"

#include <stdlib.h>
#include <string.h>

#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/sides.h"
#include "bench/versus/stock_png.h"
#include "support/pictures/png.h"

enum { OURS, THEIRS, SIDES };
enum { THREADS_MAX = 2 };

static const struct bar time_bar = {20, 40}, bytes_bar = {1.3, 0};

static const struct picture_kind {
    const char *name;
    enum work_shade shade;
    enum stock_pixels pixels;
    struct zr_output output;
} kinds[] = {{"flat RGB", WORK_FLAT, STOCK_RGB, {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG}},
             {"smooth RGB", WORK_GOURAUD, STOCK_RGB, {.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG}},
             {"16-bit depth", WORK_FLAT, STOCK_GREY16, {.channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_PNG16}}};
enum { KINDS = sizeof kinds / sizeof *kinds };

struct task {
    const struct work *work;
    int threads;
    bool wanted[KINDS];
};

static void name_row(const struct task *task, int kind, char *name, size_t size)
{
    snprintf(name, size, "PNG of %s %s %dT %s", task->work->name, kinds[kind].name, task->threads, machine_isa_name());
}

/* NULL where it is none of the frame's size. */
static void *read_picture(const struct zr_answer *answer, const struct picture_kind *kind, const struct zr_frame *frame)
{
    uint32_t width, height;
    enum png_pixels pixels = kind->pixels == STOCK_RGB ? PNG_AS_RGB : PNG_AS_GREY16;
    void *read = png_memory_read(answer->bytes, answer->size, pixels, &width, &height);
    if (read && width == frame->width && height == frame->height) return read;
    free(read);
    return NULL;
}

/* Colours as they are in the frame. Depth has its own unit, which the encoder alone knows: it has to be there where the
 * frame has any, and to grow with it. */
static bool is_right(const struct zr_frame *frame, const struct picture_kind *kind, const void *read)
{
    size_t pixels = (size_t)frame->width * frame->height;
    const uint8_t *rgb = read;
    const uint16_t *depth = read;
    float nearest_step = 0, farthest_step = HUGE_VALF;
    if (!read) return false;
    for (size_t i = 0; i < pixels; i++) {
        if (kind->pixels == STOCK_RGB) {
            if (memcmp(rgb + 3 * i, frame->color + 4 * i, 3) != 0) return false;
        } else if ((depth[i] > 0) != (frame->depth[i] < HUGE_VALF))
            return false;
        else if (depth[i] > 0) {
            nearest_step = fmaxf(nearest_step, frame->depth[i] / ((float)depth[i] + 0.5f));
            farthest_step = fminf(farthest_step, frame->depth[i] / ((float)depth[i] - 0.5f));
        }
    }
    return kind->pixels == STOCK_RGB || nearest_step <= farthest_step * 1.00001f;
}

/* One picture, by both. */
struct writing {
    struct ours *ours;
    const struct zr_frame *frame;
    struct zr_answer answer;
    struct stock_image image;
    struct stock_file file;
};

static bool run_round(void *context, struct series *series)
{
    struct writing *writing = context;
    double begin = now_ms();
    if (!stock_png_write(&writing->image, &writing->file)) return false;
    double middle = now_ms();
    if (!ours_encode(writing->ours, writing->frame, &writing->answer)) return false;
    series_add(&series[THEIRS], middle - begin);
    series_add(&series[OURS], now_ms() - middle);
    return true;
}

static bool measure(const struct bench *bench, const struct task *task, struct ours *ours, int number, struct row *row)
{
    struct series series[SIDES] = {{.count = 0}, {.count = 0}};
    const struct picture_kind *kind = &kinds[number];
    ours_take(ours, task->work, &(struct variant){kind->shade, true});
    struct writing w = {.ours = ours, .frame = ours_render(ours, &kind->output, 1)};
    if (!w.frame || !ours_encode(ours, w.frame, &w.answer)) return false;
    void *read = read_picture(&w.answer, kind, w.frame);
    w.image = (struct stock_image){kind->pixels, w.frame->width, w.frame->height, false, read};
    name_row(task, number, row->work, sizeof row->work);
    row->wrong = !is_right(w.frame, kind, read);
    bool ok = !read || bench->check_only || series_run(series, SIDES, bench->rounds, run_round, &w);
    free(read);
    free(w.file.bytes);
    row->ours_ms = series_median(&series[OURS]);
    row->theirs_ms = series_median(&series[THEIRS]);
    row->bar = time_bar;
    row->side = ROW_BYTES;
    row->side_bar = bytes_bar;
    if (w.file.size) row->side_ratio = (double)w.answer.size / (double)w.file.size;
    if (bench->check_only)
        snprintf(row->note, sizeof row->note, "read back by libpng, it is %sthe frame", row->wrong ? "not " : "");
    else
        snprintf(row->note, sizeof row->note, "%zu KB, theirs %zu KB", w.answer.size / 1000, w.file.size / 1000);
    return ok;
}

static bool measure_all(const struct bench *bench, void *context, const struct sink *sink)
{
    const struct task *task = context;
    struct ours ours;
    bool ok = ours_open(&ours, task->threads);
    for (int i = 0; ok && i < KINDS; i++) {
        struct row row = {.work = ""};
        if (!task->wanted[i]) continue;
        ok = measure(bench, task, &ours, i, &row);
        if (ok) sink_row(sink, &row);
    }
    ours_close(&ours);
    return ok;
}

void versus_libpng(struct bench *bench)
{
    struct work work;
    struct task task = {.work = &work};
    if (!works_make(WORK_BUNNY, bench->models, &work)) bench->results.failed = true;
    for (task.threads = 1; work.corners && task.threads <= THREADS_MAX; task.threads++) {
        bool here = false;
        for (int i = 0; i < KINDS; i++) {
            char name[ROW_NAME_SIZE];
            name_row(&task, i, name, sizeof name);
            task.wanted[i] = bench_wants(bench, name);
            here |= task.wanted[i];
        }
        if (here && bench->check_only) bench_check_in_child(bench, measure_all, &task, NULL);
        if (!here || bench->check_only) continue;
        results_begin_table(&bench->results, "zr_encode against libpng with its default settings");
        bench_in_child(bench, measure_all, &task, NULL);
    }
    works_free(&work);
}
