/* The daemon against the stock path. */
#include <stdlib.h>
#include <string.h>

#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/versus/stock_path.h"
#include "bench/works.h"
#include "server/support/daemon.h"
#include "support/pictures/png.h"

enum { THREADS_MAX = 2 };

static const struct bar http_bar = {12, 20};

struct task {
    const struct work *work;
    const struct document *document;
    int threads;
    bool wrong[BENCH_CHECKS_MAX];
};

static void name_row(const struct task *task, char *name, size_t size)
{
    snprintf(name, size, "HTTP: %s, indexed JSON to PNG %dT %s", task->work->name, task->threads, machine_isa_name());
}

/* What a round takes: the daemon, what it tells of its steps in Server-Timing, and the stock path. */
enum { OURS, PARSE, RENDER, ENCODE, THEIRS, TIMES };
static const char *const step_names[] = {[PARSE] = "parse", [RENDER] = "render", [ENCODE] = "encode"};

static bool ask(struct wire *wire, const struct document *document, struct series *series, struct wire_answer *answer)
{
    double begin = now_ms();
    bool ok = wire_ask(wire, "POST", "/v1/render", document->bytes, document->size, answer) && answer->status == 200;
    series_add(&series[OURS], now_ms() - begin);
    for (int s = PARSE; ok && s <= ENCODE; s++)
        series_add(&series[s], wire_step_ms(answer, step_names[s]));
    return ok || bench_complain("the daemon answered %d", answer->status);
}

static struct daemon start_daemon(int threads)
{
    char flag[32];
    snprintf(flag, sizeof flag, "--threads=%d", threads);
    return daemon_start((const char *const[]){"--workers=1", flag, NULL});
}

/* ---- is it the same picture? ---- */

/* As PNG_AS_RGB, to be freed; NULL where it is none of the drawing's size. */
static uint8_t *read_picture(const void *bytes, size_t size, const struct drawing *drawing)
{
    uint32_t width, height;
    uint8_t *pixels = png_memory_read(bytes, size, PNG_AS_RGB, &width, &height);
    if (pixels && width == drawing->width && height == drawing->height) return pixels;
    free(pixels);
    return NULL;
}

static bool compare(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    static struct series series[TIMES];
    const struct task *task = context;
    const struct drawing *drawing = &task->work->drawing;
    size_t bytes = (size_t)drawing->width * drawing->height * 3, differing = 0, covered = 0;
    struct daemon daemon = start_daemon(task->threads);
    struct stock_path path;
    struct wire wire;
    struct wire_answer answer = {0};
    bool ok = wire_open(&wire, daemon.port) && ask(&wire, task->document, series, &answer) &&
              stock_path_open(&path, true, 1, drawing) && stock_path_answer(&path, task->document);
    daemon_stop(&daemon);
    if (!ok) return false;
    uint8_t *got = read_picture(answer.body, answer.size, drawing);
    uint8_t *want = read_picture(path.file.bytes, path.file.size, drawing);
    for (size_t i = 0; got && want && i < bytes; i += 3) {
        differing += memcmp(got + i, want + i, 3) != 0;
        covered += (want[i] | want[i + 1] | want[i + 2]) != 0;
    }
    struct row row = {.wrong = !got || !want || differing > 0 || covered == 0};
    name_row(task, row.work, sizeof row.work);
    snprintf(row.note, sizeof row.note, "%zu of %zu pixels differ from the stock path's, %zu covered", differing,
             bytes / 3, covered);
    sink_row(sink, &row);
    free(got);
    free(want);
    wire_close(&wire);
    stock_path_close(&path);
    return true;
}

/* ---- is it fast? ---- */

/* What the daemon foresaw over what it took, the median of its log lines. */
static double prediction(const struct daemon *daemon)
{
    static struct series ratios;
    char *log = daemon_log(daemon), *save = NULL;
    for (char *line = log ? strtok_r(log, "\n", &save) : NULL; line; line = strtok_r(NULL, "\n", &save)) {
        static const char *const keys[] = {"\"predictedMs\":", "\"renderMs\":", "\"encodeMs\":"};
        double ms[3] = {0};
        for (int k = 0; k < 3; k++) {
            const char *at = strstr(line, keys[k]);
            if (at) ms[k] = strtod(at + strlen(keys[k]), NULL);
        }
        if (ms[0] > 0 && ms[1] + ms[2] > 0) series_add(&ratios, ms[0] / (ms[1] + ms[2]));
    }
    free(log);
    return series_median(&ratios);
}

struct paths {
    struct wire wire;
    struct stock_path stock;
    const struct document *document;
};

static bool run_round(void *context, struct series *series)
{
    struct paths *paths = context;
    struct wire_answer answer = {0};
    double begin = now_ms();
    if (!stock_path_answer(&paths->stock, paths->document)) return false;
    series_add(&series[THEIRS], now_ms() - begin);
    return ask(&paths->wire, paths->document, series, &answer);
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[TIMES];
    const struct task *task = context;
    struct daemon daemon = start_daemon(task->threads);
    struct paths paths = {.document = task->document};
    bool ok = wire_open(&paths.wire, daemon.port) &&
              stock_path_open(&paths.stock, false, task->threads, &task->work->drawing) &&
              series_run(series, TIMES, bench->rounds, run_round, &paths);
    struct row row = {
        .ours_ms = series_median(&series[OURS]), .theirs_ms = series_median(&series[THEIRS]), .bar = http_bar};
    row.wrong = task->wrong[0];
    name_row(task, row.work, sizeof row.work);
    snprintf(row.note, sizeof row.note, "parse %.1f, render %.1f, encode %.1f ms; predicted %.1fx of the last two",
             series_median(&series[PARSE]), series_median(&series[RENDER]), series_median(&series[ENCODE]),
             prediction(&daemon));
    daemon_stop(&daemon);
    if (ok) sink_row(sink, &row);
    return ok;
}

void service_against_stock(struct bench *bench)
{
    struct work work;
    if (!works_make(WORK_BUNNY, bench->models, &work)) bench->results.failed = true;
    struct document document = work.corners ? document_indexed(&work.drawing, true) : (struct document){NULL, 0};
    struct task task = {.work = &work, .document = &document};
    for (task.threads = 1; document.bytes && task.threads <= THREADS_MAX; task.threads++) {
        char name[ROW_NAME_SIZE];
        name_row(&task, name, sizeof name);
        if (!bench_wants(bench, name)) continue;
        bench_check_in_child(bench, compare, &task, task.wrong);
        if (bench->check_only) continue;
        results_begin_table(&bench->results, "the daemon, over HTTP, against stock parts in one process");
        bench_in_child(bench, measure, &task, NULL);
    }
    free(document.bytes);
    works_free(&work);
}
