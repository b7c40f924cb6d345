/* What a daemon on one processor serves while its metrics are asked for twice a second, as by two Prometheus that are
 * in a hurry, against what it serves without. In turns, each first in every other round. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench/http/load.h"
#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/input/documents.h"
#include "bench/series.h"
#include "bench/works.h"
#include "server/support/client.h"

static const char NAME[] = "HTTP: two scrapes a second";
/* Many short turns: a difference of 1 % is less than what turns differ by. */
enum { CONNECTIONS = 16, EVERY_MS = 500, ROUNDS = 41 };
static const double SECONDS = 0.5; /* EVERY_MS: one scrape in a turn */

enum { SCRAPED, ALONE, SIDES };

struct scraper {
    struct wire wire;
    pthread_t thread;
    atomic_bool is_over;
    bool failed;
    struct series took;
    size_t bytes;
};

struct task {
    struct daemon daemon;
    struct scraper scraper;
    struct load load;
    int round;
};

static bool scrape(struct scraper *scraper)
{
    struct wire_answer answer = {0};
    const double begin = now_ms();
    if (!wire_ask(&scraper->wire, "GET", "/metrics", NULL, 0, &answer) || answer.status != 200) return false;
    series_add(&scraper->took, now_ms() - begin);
    scraper->bytes = answer.size;
    return true;
}

static void *scrape_on(void *argument)
{
    struct scraper *scraper = argument;
    const struct timespec pause = {.tv_nsec = EVERY_MS * 1000000L};
    while (!atomic_load(&scraper->is_over) && !scraper->failed) {
        scraper->failed = !scrape(scraper);
        nanosleep(&pause, NULL);
    }
    return NULL;
}

static bool run_side(struct task *task, bool is_scraped, struct series *series)
{
    struct scraper *scraper = &task->scraper;
    struct load_result result;
    atomic_store(&scraper->is_over, false);
    if (is_scraped && pthread_create(&scraper->thread, NULL, scrape_on, scraper) != 0) return false;
    const bool ok = load_run(&task->load, &result) && result.served > 0 && result.failed <= 0 && result.refused <= 0;
    atomic_store(&scraper->is_over, true);
    if (is_scraped) pthread_join(scraper->thread, NULL);
    if (ok) series_add(series, 1000.0 / result.served);
    return (ok && !scraper->failed) || bench_complain("%s: a request was not answered well", NAME);
}

static bool run_round(void *context, struct series *series)
{
    struct task *task = context;
    const int first = task->round++ % SIDES;
    return run_side(task, first == SCRAPED, &series[first]) &&
           run_side(task, first != SCRAPED, &series[SIDES - 1 - first]);
}

/* Requests of all kinds, so that /metrics has the series of a daemon that works. */
static bool fill(const struct task *task)
{
    static const char *const targets[] = {"/", "/none", "/healthz", "/readyz", "/v1/limits", "/v1/looks", "/docs/"};
    static const char *const methods[] = {"GET", "OPTIONS", "DELETE"};
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
        for (size_t j = 0; j < sizeof methods / sizeof *methods; j++) {
            struct reply reply = client_send(&task->daemon, methods[j], targets[i], NULL, NULL, 0);
            const bool is_answered = reply.status > 0;
            reply_free(&reply);
            if (!is_answered) return false;
        }
    return true;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct task task;
    const struct document *body = context;
    struct series series[SIDES] = {{.count = 0}};
    load_take_first_processor();
    task.daemon = daemon_start(LIST("--workers=1", "--threads=1"));
    load_take_other_processors();
    size_t size = 0;
    char *request = load_make_request("/v1/render", "application/json", body->bytes, body->size, &size);
    task.load = (struct load){
        .port = task.daemon.port, .connections = CONNECTIONS, .request = request, .size = size, .seconds = SECONDS};
    bool ok = request && wire_open(&task.scraper.wire, task.daemon.port) && fill(&task);
    for (int i = 0; ok && i < 20; i++)
        ok = scrape(&task.scraper); /* while nothing else is at work */
    const double alone_ms = series_median(&task.scraper.took);
    ok = ok && series_run(series, SIDES, bench->rounds ? bench->rounds : ROUNDS, run_round, &task);
    wire_close(&task.scraper.wire);
    free(request);
    daemon_stop(&task.daemon);
    if (!ok) return false;
    struct row row = {
        .bar = {0.99, 0.995}, .ours_ms = series_median(&series[SCRAPED]), .theirs_ms = series_median(&series[ALONE])};
    snprintf(row.work, sizeof row.work, "%s", NAME);
    snprintf(row.note, sizeof row.note, "%.0f a second, %.0f without; a scrape of %.0f kB alone: %.2f ms",
             1000.0 / row.ours_ms, 1000.0 / row.theirs_ms, (double)task.scraper.bytes / 1000.0, alone_ms);
    sink_row(sink, &row);
    return true;
}

void service_while_scraped(struct bench *bench)
{
    struct work work;
    if (bench->check_only || !bench_wants(bench, NAME)) return;
    if (!works_make(WORK_CUBE, bench->models, &work)) bench->results.failed = true;
    struct document body = work.corners ? document_indexed(&work.drawing, true) : (struct document){NULL, 0};
    if (body.bytes) {
        results_begin_table(&bench->results, "a daemon on one processor whose metrics are asked for: time per picture "
                                             "under load, against that without scrapes");
        bench_in_child(bench, measure, &body, NULL);
    }
    free(body.bytes);
    works_free(&work);
}
