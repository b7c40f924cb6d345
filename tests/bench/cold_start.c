/* From exec to the first picture. */
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/alone/first_frame.h"
#include "bench/http/process.h"
#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/input/documents.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/works.h"
#include "server/support/daemon.h"

enum { OURS, THEIRS, SIDES };

static const struct bar cold_bar = {2, 5};

static void name_row(const struct work *work, char *name, size_t size)
{
    snprintf(name, size, "exec to the first picture, %.40s %s", work->name, machine_isa_name());
}

static bool is_png(const struct wire_answer *answer)
{
    return answer->status == 200 && answer->size > 8 && memcmp(answer->body, "\x89PNG\r\n\x1a\n", 8) == 0;
}

static bool run_ours(const char *binary, const struct document *document, struct series *series)
{
    const char *const arguments[] = {binary, "--port", "0", NULL};
    struct process process;
    struct wire wire;
    struct wire_answer answer = {0};
    char line[128] = "";
    unsigned port = 0;
    double begin = now_ms();
    if (!process_start(&process, arguments, true)) return bench_complain("%s cannot be run", binary);
    bool ok = process_wait(&process, line, sizeof line) &&
              sscanf(line, "listening on http://127.0.0.1:%u", &port) == 1 && wire_open(&wire, port) &&
              wire_ask(&wire, "POST", "/v1/render", document->bytes, document->size, &answer) && is_png(&answer);
    series_add(series, now_ms() - begin);
    if (port) wire_close(&wire);
    return process_end(&process, SIGTERM) && ok;
}

static bool give(int fd, const void *bytes, size_t size)
{
    return write(fd, bytes, size) == (ssize_t)size; /* far less than a pipe holds */
}

static bool run_theirs(const char *program, const struct work *work, struct series *series)
{
    const char *const arguments[] = {program, NULL};
    const struct drawing *d = &work->drawing;
    const struct first_frame frame = {d->width,           d->height,    d->position_count,
                                      work->corner_count, d->modelview, d->projection};
    struct process process;
    double begin = now_ms();
    if (!process_start(&process, arguments, false)) return bench_complain("%s cannot be run", program);
    bool ok = give(process.in, &frame, sizeof frame) &&
              give(process.in, d->positions, d->position_count * sizeof *d->positions) &&
              give(process.in, d->colors, d->position_count * sizeof *d->colors) &&
              give(process.in, work->corners, work->corner_count * sizeof *work->corners) &&
              process_wait(&process, NULL, 0);
    series_add(series, now_ms() - begin);
    return process_end(&process, 0) && ok;
}

/* A cache of shaders for the other side, whatever home directory there is. */
static void keep_shaders(const struct bench *bench)
{
    char path[600];
    bench_path_of(bench, "shaders", path, sizeof path);
    setenv("MESA_SHADER_CACHE_DIR", path, 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "false", 1);
}

struct start {
    const struct work *work;
    const struct document *document;
    const char *binary, *program;
};

static bool run_round(void *context, struct series *series)
{
    const struct start *start = context;
    return run_theirs(start->program, start->work, &series[THEIRS]) &&
           run_ours(start->binary, start->document, &series[OURS]);
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[SIDES];
    const struct work *work = context;
    char program[600];
    struct document document = document_indexed(&work->drawing, true);
    bench_path_of(bench, "first_frame", program, sizeof program);
    keep_shaders(bench);
    struct start start = {work, &document, daemon_binary(), program};
    bool ok = document.bytes && series_run(series, SIDES, bench->rounds, run_round, &start);
    struct row row = {
        .ours_ms = series_median(&series[OURS]), .theirs_ms = series_median(&series[THEIRS]), .bar = cold_bar};
    name_row(work, row.work, sizeof row.work);
    if (ok) sink_row(sink, &row);
    free(document.bytes);
    return ok;
}

void service_cold_start(struct bench *bench)
{
    struct work work;
    char name[ROW_NAME_SIZE];
    if (bench->check_only) return;
    if (!works_make(WORK_CUBE, bench->models, &work)) bench->results.failed = true;
    name_row(&work, name, sizeof name);
    if (work.corners && bench_wants(bench, name)) {
        results_begin_table(&bench->results, "a new daemon against a new process with Mesa");
        bench_in_child(bench, measure, &work, NULL);
    }
    works_free(&work);
}
