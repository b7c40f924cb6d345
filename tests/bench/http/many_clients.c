/* What a daemon on one processor serves to many clients, whose load comes from another processor: as much with many
 * kept connections as with few, and as much where ten times more is asked for than it can do. */
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "bench/http/load.h"
#include "bench/http/service.h"
#include "bench/input/documents.h"
#include "bench/series.h"
#include "bench/works.h"
#include "server/support/client.h"

static const int kept[] = {64, 128, 256, 512};
static const int crowds[] = {64, 256};
static const int ready[] = {127, 128, 256, 1024};
enum {
    KEPT = sizeof kept / sizeof kept[0],
    CROWDS = sizeof crowds / sizeof crowds[0],
    READY = sizeof ready / sizeof ready[0],
    PEAK_CONNECTIONS = 16
};
enum { ROUNDS = 3, READY_ROUNDS = 9 };

static const char JSON[] = "application/json";
/* HEALTH_MS: orchestrators count a longer check as failed. */
static const double SECONDS = 1.5, TIMES = 10.0, HEALTH_MS = 50.0, READY_MS = 100.0;

static void name_kept(int connections, char *name, size_t size)
{
    snprintf(name, size, "HTTP: a cube 256x256 to PNG, %d kept connections", connections);
}

static void name_crowd(int connections, char *name, size_t size)
{
    snprintf(name, size, "HTTP: bodies of 300 KB, ten times too many, %d connections", connections);
}

/* In turns with the peak, so that both meet the same weather: the best of some rounds each. */
static bool measure_row(struct load load, struct load peak_load, const char *name, bool is_crowd,
                        const struct sink *sink)
{
    struct load_result peak = {.served = 0}, best = {.served = 0};
    double probe_p99_ms = 1e9;
    for (int round = 0; round < ROUNDS; round++) {
        struct load_result result;
        if (!load_run(&peak_load, &result)) return false;
        if (result.served > peak.served) peak = result;
        if (is_crowd) load.per_second = TIMES * peak.served;
        if (!load_run(&load, &result)) return false;
        if (result.served > best.served) best = result;
        if (result.probe_p99_ms < probe_p99_ms) probe_p99_ms = result.probe_p99_ms;
    }
    if (peak.served <= 0) return bench_complain("%s: nothing was served", name);
    struct row row = {.bar = {0.9, 0.95}};
    snprintf(row.work, sizeof row.work, "%s", name);
    row.ours_ms = best.served > 0 ? 1000.0 / best.served : 1e6;
    row.theirs_ms = 1000.0 / peak.served;
    if (is_crowd)
        snprintf(row.note, sizeof row.note, "%.0f of %.0f/s; %.0f/s refused, %.0f failed; /healthz p99 %.1f ms",
                 best.served, peak.served, best.refused, best.failed, probe_p99_ms);
    else
        snprintf(row.note, sizeof row.note, "%.0f a second, %.0f at %d connections; p99 %.1f ms", best.served,
                 peak.served, PEAK_CONNECTIONS, best.p99_ms);
    sink_row(sink, &row);
    if (!is_crowd) return true;
    struct row health = {.bar = {1.0, 5.0}, .ours_ms = probe_p99_ms, .theirs_ms = HEALTH_MS};
    snprintf(health.work, sizeof health.work, "%.60s, /healthz", name + sizeof "HTTP: " - 1);
    snprintf(health.note, sizeof health.note, "99 of 100 within, against %.0f ms", HEALTH_MS);
    sink_row(sink, &health);
    return true;
}

static void name_ready(int connections, char *name, size_t size)
{
    snprintf(name, size, "HTTP: /healthz, all of %d connections ready at once", connections);
}

/* All requests are there before the daemon looks: until the last has its answer. */
static bool measure_ready(const struct daemon *daemon, int connections, const struct sink *sink)
{
    static const char REQUEST[] = "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n";
    static int clients[LOAD_CONNECTIONS_MAX];
    struct series series = {.count = 0};
    bool ok = true;
    for (int i = 0; i < connections; i++)
        ok &= (clients[i] = client_connect(daemon)) >= 0;
    for (int round = 0; ok && round < READY_ROUNDS; round++) {
        kill(daemon->pid, SIGSTOP);
        for (int i = 0; i < connections; i++)
            ok &= client_write(clients[i], REQUEST, sizeof REQUEST - 1);
        const double begun = now_ms();
        kill(daemon->pid, SIGCONT);
        for (int i = 0; ok && i < connections; i++) {
            char *text = client_read(clients[i], "ok\"}", 10000);
            ok = raw_status(text) == 200;
            free(text);
        }
        series_add(&series, now_ms() - begun);
    }
    for (int i = 0; i < connections; i++)
        if (clients[i] >= 0) close(clients[i]);
    if (!ok) return bench_complain("of %d connections ready at once one was not answered", connections);
    struct row row = {.bar = {1.0, 2.0}, .ours_ms = series_median(&series), .theirs_ms = READY_MS};
    name_ready(connections, row.work, sizeof row.work);
    snprintf(row.note, sizeof row.note, "the last answer, against %.0f ms", READY_MS);
    sink_row(sink, &row);
    return true;
}

static const char EQUAL[] = "HTTP: bodies of 300 KB, 16 equal requests at once, against different ones";

/* In turns, the best of some rounds each. */
static bool measure_equal(struct load load, const struct sink *sink)
{
    double best[2] = {0, 0}; /* different, equal */
    for (int i = 0; i < 2 * ROUNDS; i++) {
        struct load_result result;
        load.is_equal = i % 2;
        if (!load_run(&load, &result)) return false;
        if (result.served > best[i % 2]) best[i % 2] = result.served;
    }
    if (best[0] <= 0 || best[1] <= 0) return bench_complain("%s: nothing was served", EQUAL);
    struct row row = {.bar = {4.0, 8.0}, .ours_ms = 1000.0 / best[1], .theirs_ms = 1000.0 / best[0]};
    snprintf(row.work, sizeof row.work, "%s", EQUAL);
    snprintf(row.note, sizeof row.note, "%.0f a second, %.0f different ones", best[1], best[0]);
    sink_row(sink, &row);
    return true;
}

struct task {
    const struct document *small, *large;
    bool kept[KEPT], crowds[CROWDS], ready[READY], equal;
};

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    const struct task *task = context;
    struct rlimit limit;
    getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max < 4096 ? limit.rlim_max : 4096;
    setrlimit(RLIMIT_NOFILE, &limit);
    load_take_first_processor();
    struct daemon daemon = daemon_start(LIST("--workers=1", "--threads=1", "--queue=2048"));
    struct daemon usual = daemon_start(LIST("--workers=1", "--threads=1"));
    load_take_other_processors();
    size_t small_size = 0, large_size = 0;
    char *small = load_make_request("/v1/render", JSON, task->small->bytes, task->small->size, &small_size);
    char *large = load_make_request("/v1/render", JSON, task->large->bytes, task->large->size, &large_size);
    bool ok = small && large;
    for (int i = 0; ok && i < KEPT; i++) {
        char name[ROW_NAME_SIZE];
        const struct load peak = {.port = daemon.port,
                                  .connections = PEAK_CONNECTIONS,
                                  .request = small,
                                  .size = small_size,
                                  .seconds = SECONDS};
        struct load load = peak;
        load.connections = kept[i];
        name_kept(kept[i], name, sizeof name);
        if (task->kept[i]) ok = measure_row(load, peak, name, false, sink);
    }
    for (int i = 0; ok && i < READY; i++)
        if (task->ready[i]) ok = measure_ready(&daemon, ready[i], sink);
    for (int i = 0; ok && i < CROWDS; i++) {
        char name[ROW_NAME_SIZE];
        const struct load peak = {
            .port = usual.port, .connections = 2, .request = large, .size = large_size, .seconds = SECONDS};
        struct load load = peak;
        load.connections = crowds[i];
        load.seconds = 2 * SECONDS;
        load.probe = true;
        name_crowd(crowds[i], name, sizeof name);
        if (task->crowds[i]) ok = measure_row(load, peak, name, true, sink);
    }
    if (ok && task->equal)
        ok = measure_equal((struct load){.port = daemon.port,
                                         .connections = PEAK_CONNECTIONS,
                                         .request = large,
                                         .size = large_size,
                                         .seconds = SECONDS},
                           sink);
    free(small);
    free(large);
    daemon_stop(&daemon);
    daemon_stop(&usual);
    return ok;
}

/* A grid of heights, about 300 KB of JSON. */
static struct document make_large(void)
{
    enum { SIDE = 204 };
    struct document document = {NULL, 0};
    FILE *out = open_memstream(&document.bytes, &document.size);
    if (!out) return document;
    fputs("{\"window\":{\"width\":256,\"height\":256},\"meshes\":[{\"heights\":[", out);
    for (int y = 0; y < SIDE; y++) {
        fputs(y ? ",[" : "[", out);
        for (int x = 0; x < SIDE; x++)
            fprintf(out, "%s%.4f", x ? "," : "", 0.5 * ((x * 7 + y * 3) % 10));
        fputc(']', out);
    }
    fputs("]}]}", out);
    fclose(out);
    return document;
}

void service_for_many(struct bench *bench)
{
    struct work work;
    struct task task = {.kept = {false}};
    bool any = false;
    char name[ROW_NAME_SIZE];
    if (bench->check_only) return;
    for (int i = 0; i < KEPT; i++) {
        name_kept(kept[i], name, sizeof name);
        any |= task.kept[i] = bench_wants(bench, name);
    }
    for (int i = 0; i < READY; i++) {
        name_ready(ready[i], name, sizeof name);
        any |= task.ready[i] = bench_wants(bench, name);
    }
    for (int i = 0; i < CROWDS; i++) {
        name_crowd(crowds[i], name, sizeof name);
        any |= task.crowds[i] = bench_wants(bench, name);
    }
    any |= task.equal = bench_wants(bench, EQUAL);
    if (!any) return;
    if (!works_make(WORK_CUBE, bench->models, &work)) bench->results.failed = true;
    struct document small = work.corners ? document_indexed(&work.drawing, true) : (struct document){NULL, 0};
    struct document large = make_large();
    task.small = &small;
    task.large = &large;
    if (small.bytes && large.bytes) {
        results_begin_table(&bench->results, "many clients of a daemon on one processor: requests served, against few "
                                             "clients; times against what they may be");
        bench_in_child(bench, measure, &task, NULL);
    }
    free(small.bytes);
    free(large.bytes);
    works_free(&work);
}
