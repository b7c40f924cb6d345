/* Several views by one request to the daemon, against a request for each: with the mesh, and by the hash of the mesh,
 * which the daemon then keeps as read. Views are a turntable's, whose cameras the single requests only resemble.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/series.h"
#include "server/support/client.h"
#include "support/files.h"

enum { OURS, SENT, OURS_BY_HASH, BY_HASH, TIMES };
enum { VIEWS = 36 };

static const char *const kinds[] = {"textbook", "studio", "technical"};

struct task {
    const char *look;
    struct daemon daemon;
    struct wire wire;
    char *mesh, hash[65];
    size_t size;
};

static bool ask_mesh(const struct task *task, const char *query)
{
    char target[160];
    snprintf(target, sizeof target, "/v1/render?width=512&height=512&look=%s&%s", task->look, query);
    struct reply reply = client_send(&task->daemon, "POST", target,
                                     (const char *const[]){"Content-Type: model/obj", NULL}, task->mesh, task->size);
    const bool ok = reply.status == 200;
    if (!ok) bench_complain("the daemon answered %ld: %.*s", reply.status, (int)reply.size, reply.body);
    reply_free(&reply);
    return ok;
}

/* `keys`: of the views. */
static bool ask_hash(struct task *task, const char *keys)
{
    char text[400];
    struct wire_answer answer;
    const int size = snprintf(text, sizeof text,
                              "{\"window\":{\"width\":512,\"height\":512},\"look\":\"%s\",\"meshes\":[{\"asset\":"
                              "\"sha256:%s\"}],%s}",
                              task->look, task->hash, keys);
    return (wire_ask(&task->wire, "POST", "/v1/render", text, (size_t)size, &answer) && answer.status == 200) ||
           bench_complain("the daemon answered %d: %.*s", answer.status, (int)answer.size, answer.body);
}

static bool run_round(void *context, struct series *series)
{
    struct task *task = context;
    char query[80];
    double begin = now_ms();
    snprintf(query, sizeof query, "turntable=%d", VIEWS);
    bool ok = ask_mesh(task, query);
    series_add(&series[OURS], now_ms() - begin);
    begin = now_ms();
    for (int i = 0; ok && i < VIEWS; i++) {
        snprintf(query, sizeof query, "azimuth=%d&elevation=20", 10 * i);
        ok = ask_mesh(task, query);
    }
    series_add(&series[SENT], now_ms() - begin);
    begin = now_ms();
    snprintf(query, sizeof query, "\"turntable\":{\"frames\":%d}", VIEWS);
    ok = ok && ask_hash(task, query);
    series_add(&series[OURS_BY_HASH], now_ms() - begin);
    begin = now_ms();
    for (int i = 0; ok && i < VIEWS; i++) {
        snprintf(query, sizeof query, "\"view\":{\"azimuthDegrees\":%d,\"elevationDegrees\":20}", 10 * i);
        ok = ask_hash(task, query);
    }
    series_add(&series[BY_HASH], now_ms() - begin);
    return ok;
}

static bool open_daemon(struct task *task, const char *folder)
{
    char flag[64];
    struct wire_answer answer = {0};
    snprintf(flag, sizeof flag, "--assets-dir=%s", folder);
    task->daemon =
        daemon_start((const char *const[]){"--workers=2", "--threads=2", "--keep-memory-bytes=1000000000", flag, NULL});
    return wire_open(&task->wire, task->daemon.port) &&
           wire_ask(&task->wire, "POST", "/v1/assets", task->mesh, task->size, &answer) &&
           sscanf(answer.body, "{\"sha256\":\"%64[0-9a-f]", task->hash) == 1;
}

static void add_row(const struct sink *sink, const struct task *task, const struct series *ours,
                    const struct series *theirs, const char *what)
{
    struct row row = {.ours_ms = series_median(ours), .theirs_ms = series_median(theirs)};
    snprintf(row.work, sizeof row.work, "HTTP: 36 views of the bunny in %s against 36 requests %s, 512x512 2T",
             task->look, what);
    snprintf(row.note, sizeof row.note, "%.1f views a second", 1e3 * VIEWS / row.ours_ms);
    sink_row(sink, &row);
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[TIMES];
    struct task task = {.look = *(const char *const *)context, .wire.fd = -1};
    char folder[] = "/tmp/zraster-bench-XXXXXX", path[4096], command[60];
    snprintf(path, sizeof path, "%s/stanford-bunny.obj", bench->models);
    task.mesh = file_read(path, &task.size);
    if (!task.mesh) return bench_complain("%s is not there", path);
    if (!mkdtemp(folder)) return bench_complain("no folder for assets can be made");
    const bool ok = open_daemon(&task, folder) && series_run(series, TIMES, bench->rounds, run_round, &task);
    wire_close(&task.wire);
    daemon_stop(&task.daemon);
    free(task.mesh);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (system(command) != 0) return bench_complain("%s cannot be removed", folder);
    if (!ok) return false;
    add_row(sink, &task, &series[OURS], &series[SENT], "with the mesh");
    add_row(sink, &task, &series[OURS_BY_HASH], &series[BY_HASH], "by its hash");
    return true;
}

void service_with_views(struct bench *bench)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (bench->check_only || !bench_wants(bench, "HTTP: 36 views")) continue;
        results_begin_table(&bench->results, "several views by one request to the daemon, against a request for each");
        const char *look = kinds[i];
        bench_in_child(bench, measure, &look, NULL);
    }
}
