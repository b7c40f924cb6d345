/* The daemon's cheapest answer against libmicrohttpd alone. */
#include <stdlib.h>
#include <string.h>

#include "bench/http/process.h"
#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/series.h"
#include "server/support/daemon.h"

enum { OURS, THEIRS, SIDES };
enum { A_ROUND = 200, HEADERS_MAX = 16, TEXT_SIZE = 4096 };

static const char name[] = "HTTP: GET /healthz, one connection, mean of 200 requests";
static const char target[] = "/healthz";

/* Arguments for the other server: the daemon's own body and headers, but for those that libmicrohttpd adds. */
struct answer {
    char body[TEXT_SIZE], headers[TEXT_SIZE];
    const char *arguments[HEADERS_MAX + 3];
};

static bool learn(struct wire *wire, const char *program, struct answer *answer)
{
    struct wire_answer got = {0};
    char *save = NULL;
    int count = 0;
    if (!wire_ask(wire, "GET", target, NULL, 0, &got) || got.status != 200) return false;
    snprintf(answer->body, sizeof answer->body, "%.*s", (int)got.size, got.body);
    snprintf(answer->headers, sizeof answer->headers, "%s", got.headers);
    answer->arguments[count++] = program;
    answer->arguments[count++] = answer->body;
    strtok_r(answer->headers, "\r\n", &save); /* the status */
    for (char *line; (line = strtok_r(NULL, "\r\n", &save)) && count < HEADERS_MAX + 2;) {
        char *colon = strstr(line, ": ");
        if (!colon || strncasecmp(line, "Date", 4) == 0 || strncasecmp(line, "Content-Length", 14) == 0 ||
            strncasecmp(line, "Connection", 10) == 0)
            continue;
        *colon = '=';
        memmove(colon + 1, colon + 2, strlen(colon + 2) + 1);
        answer->arguments[count++] = line;
    }
    return true;
}

/* Adds the mean of many requests. */
static bool ask_often(struct wire *wire, struct series *series)
{
    struct wire_answer answer = {0};
    double begin = now_ms();
    for (int i = 0; i < A_ROUND; i++)
        if (!wire_ask(wire, "GET", target, NULL, 0, &answer) || answer.status != 200) return false;
    series_add(series, (now_ms() - begin) / A_ROUND);
    return true;
}

static bool run_round(void *context, struct series *series)
{
    struct wire *wires = context;
    return ask_often(&wires[OURS], &series[OURS]) && ask_often(&wires[THEIRS], &series[THEIRS]);
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)context;
    static struct series series[SIDES];
    static struct answer answer;
    char program[600], line[64] = "";
    struct process process;
    struct wire wires[SIDES] = {{.fd = -1}, {.fd = -1}};
    bench_path_of(bench, "bare_http", program, sizeof program);
    struct daemon daemon = daemon_start(NULL);
    bool started = wire_open(&wires[OURS], daemon.port) && learn(&wires[OURS], program, &answer) &&
                   process_start(&process, answer.arguments, false);
    if (!started) {
        daemon_stop(&daemon);
        return bench_complain("%s cannot be run", program);
    }
    bool ok = process_wait(&process, line, sizeof line) &&
              wire_open(&wires[THEIRS], (unsigned)strtoul(line, NULL, 10)) &&
              series_run(series, SIDES, bench->rounds, run_round, wires);
    struct row row = {.ours_ms = series_median(&series[OURS]), .theirs_ms = series_median(&series[THEIRS])};
    snprintf(row.work, sizeof row.work, "%s", name);
    if (ok) sink_row(sink, &row);
    wire_close(&wires[OURS]);
    wire_close(&wires[THEIRS]);
    daemon_stop(&daemon);
    return process_end(&process, 0) && ok;
}

void service_against_bare_http(struct bench *bench)
{
    if (bench->check_only || !bench_wants(bench, name)) return;
    results_begin_table(&bench->results, "the daemon against libmicrohttpd alone");
    bench_in_child(bench, measure, NULL, NULL);
}
