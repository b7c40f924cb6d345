/* How long a small request takes while large ones are at work. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/input/documents.h"
#include "bench/series.h"
#include "bench/works.h"
#include "server/support/client.h"

enum { LARGE_MAX = 4, LARGE_MS = 1500, FIRST_POLYGONS = 40, POLYGONS_MAX = 100000, SMALL_MAX = 200, PAUSE_MS = 5 };

static const int counts[] = {0, 1, LARGE_MAX};
enum { COUNTS = sizeof counts / sizeof counts[0] };

static void name_row(int larges, char *name, size_t size)
{
    static const char *const where[] = {[0] = "alone", [1] = "beside a large one", [LARGE_MAX] = "beside 4 large ones"};
    snprintf(name, size, "HTTP: a cube 256x256 to PNG, %s", where[larges]);
}

struct large {
    unsigned port;
    const char *scene;
    pthread_t thread;
    double took_ms;
    atomic_bool over;
    bool ok;
};

static void *run_large(void *argument)
{
    struct large *large = argument;
    struct wire wire;
    struct wire_answer answer = {0};
    double begin = now_ms();
    large->ok = wire_open(&wire, large->port) &&
                wire_ask(&wire, "POST", "/v1/render", large->scene, strlen(large->scene), &answer) &&
                answer.status == 200;
    large->took_ms = now_ms() - begin;
    wire_close(&wire);
    atomic_store(&large->over, true);
    return NULL;
}

/* As many polygons as take about LARGE_MS here; how long they take, in *alone_ms. NULL on failure. */
static char *make_large(unsigned port, double *alone_ms)
{
    double polygons = FIRST_POLYGONS;
    for (int tries = 0; tries < 3; tries++) {
        struct large large = {.port = port, .scene = scene_slow("halfspace", SLOW_SIDE, (int)polygons)};
        run_large(&large);
        *alone_ms = large.took_ms;
        if (large.ok && (large.took_ms > LARGE_MS / 2.0 || tries == 2)) return (char *)(uintptr_t)large.scene;
        free((char *)(uintptr_t)large.scene);
        if (!large.ok) return NULL;
        polygons *= LARGE_MS / large.took_ms;
        if (polygons > POLYGONS_MAX) polygons = POLYGONS_MAX;
    }
    return NULL;
}

static bool any_runs(const struct large *larges, int count)
{
    for (int i = 0; i < count; i++)
        if (!atomic_load(&larges[i].over)) return true;
    return count == 0;
}

static bool measure_beside(struct wire *wire, const struct document *small, const char *scene, unsigned port, int count,
                           double alone_ms, struct row *row)
{
    static struct series series;
    struct large larges[LARGE_MAX];
    int begun = 0;
    bool ok = true;
    series.count = 0;
    for (; begun < count && ok; begun++) {
        larges[begun] = (struct large){.port = port, .scene = scene};
        ok = pthread_create(&larges[begun].thread, NULL, run_large, &larges[begun]) == 0;
        if (!ok) break;
    }
    nanosleep(&(struct timespec){.tv_nsec = 100 * 1000000L}, NULL);
    while (ok && series.count < SMALL_MAX && any_runs(larges, begun)) {
        struct wire_answer answer = {0};
        double begin = now_ms();
        ok = wire_ask(wire, "POST", "/v1/render", small->bytes, small->size, &answer) && answer.status == 200;
        series_add(&series, now_ms() - begin);
        nanosleep(&(struct timespec){.tv_nsec = PAUSE_MS * 1000000L}, NULL);
    }
    double longest = 0;
    for (int i = 0; i < begun; i++) {
        pthread_join(larges[i].thread, NULL);
        ok &= larges[i].ok;
        if (larges[i].took_ms > longest) longest = larges[i].took_ms;
    }
    if (!ok || series.count == 0) return false;
    row->ours_ms = series_median(&series);
    int used = snprintf(row->note, sizeof row->note, "99 of 100 within %.1f ms", series_percentile(&series, 99));
    if (count > 0)
        snprintf(row->note + used, sizeof row->note - (size_t)used, "; a large one: %.2g s alone, %.2g s here",
                 alone_ms / 1000, longest / 1000);
    return true;
}

struct task {
    const struct document *small;
    bool wanted[COUNTS];
};

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    const struct task *task = context;
    struct daemon daemon = daemon_start(
        (const char *const[]){"--max-per-client=0", ANY_COST, "--render-timeout-ms=120000", "--queue=8", NULL});
    struct wire wire;
    struct wire_answer answer = {0};
    double alone_ms = 0;
    char *scene = make_large(daemon.port, &alone_ms);
    bool ok = wire_open(&wire, daemon.port) && scene;
    for (int i = 0; ok && i < 3; i++)
        ok = wire_ask(&wire, "POST", "/v1/render", task->small->bytes, task->small->size, &answer);
    for (int i = 0; ok && i < COUNTS; i++) {
        struct row row = {.work = ""};
        if (!task->wanted[i]) continue;
        name_row(counts[i], row.work, sizeof row.work);
        ok = measure_beside(&wire, task->small, scene, daemon.port, counts[i], alone_ms, &row);
        if (ok) sink_row(sink, &row);
    }
    wire_close(&wire);
    free(scene);
    daemon_stop(&daemon);
    return ok || bench_complain("a small request beside large ones was not answered");
}

void service_beside_large(struct bench *bench)
{
    struct work work;
    struct task task = {.wanted = {false}};
    bool any = false;
    if (bench->check_only) return;
    for (int i = 0; i < COUNTS; i++) {
        char name[ROW_NAME_SIZE];
        name_row(counts[i], name, sizeof name);
        task.wanted[i] = bench_wants(bench, name);
        any |= task.wanted[i];
    }
    if (!any) return;
    if (!works_make(WORK_CUBE, bench->models, &work)) bench->results.failed = true;
    struct document document = work.corners ? document_indexed(&work.drawing, true) : (struct document){NULL, 0};
    task.small = &document;
    if (document.bytes) {
        results_begin_table(&bench->results, "a small request beside large ones");
        bench_in_child(bench, measure, &task, NULL);
    }
    free(document.bytes);
    works_free(&work);
}
