/* Capacity: the pictures that a daemon on one processor serves in a second, beside the processor time that one of them
 * takes alone. Notes have what a machine must have for a rate: memory, bytes of an answer, and the wait of a client at
 * 70 % of the rate.
 */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/http/load.h"
#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/input/documents.h"
#include "bench/series.h"
#include "bench/works.h"
#include "server/support/client.h"

/* `scene` has a place for the name of the stored model; NULL: the model itself is the body. */
static const struct kind {
    const char *name, *target, *scene;
} kinds[] = {
    {"capacity: cube, textbook 256x256, JSON of 12 faces", "/v1/render", ""},
    {"capacity: bunny by its hash, textbook 640x480", "/v1/render",
     "{\"look\":\"textbook\",\"window\":{\"width\":640,\"height\":480},\"meshes\":[{\"asset\":\"sha256:%s\"}]}"},
    {"capacity: bunny by its hash, studio 256x256", "/v1/render",
     "{\"look\":\"studio\",\"window\":{\"width\":256,\"height\":256},\"meshes\":[{\"asset\":\"sha256:%s\"}]}"},
    {"capacity: bunny by its hash, studio 640x480", "/v1/render",
     "{\"look\":\"studio\",\"window\":{\"width\":640,\"height\":480},\"meshes\":[{\"asset\":\"sha256:%s\"}]}"},
    {"capacity: bunny by its hash, studio 1920x1080", "/v1/render",
     "{\"look\":\"studio\",\"window\":{\"width\":1920,\"height\":1080},\"meshes\":[{\"asset\":\"sha256:%s\"}]}"},
    {"capacity: bunny by its hash, depth 640x480, NPY", "/v1/render",
     "{\"look\":\"textbook\",\"window\":{\"width\":640,\"height\":480},\"outputs\":[{\"channel\":\"depth\"}],"
     "\"meshes\":[{\"asset\":\"sha256:%s\"}]}"},
    {"capacity: bunny as binary STL, studio 640x480", "/v1/render?look=studio&width=640&height=480", NULL},
};
enum {
    KINDS = sizeof kinds / sizeof *kinds,
    HASH_SIZE = 65,
    TEXT_SIZE = 1024,
    CONNECTIONS = 3,
    ROUNDS = 3,
    ALONE = 15
};

static const double SECONDS = 3.0, SHARE = 0.7;

struct task {
    const struct kind *kind;
    struct document cube, model;
};

/* Stores the model, and writes the scene that names it. */
static bool write_scene(const struct task *task, unsigned port, struct document *scene)
{
    char hash[HASH_SIZE] = "", text[TEXT_SIZE];
    struct wire wire;
    struct wire_answer answer = {0};
    const bool ok = wire_open(&wire, port) &&
                    wire_ask(&wire, "POST", "/v1/assets", task->model.bytes, task->model.size, &answer) &&
                    sscanf(answer.body, "{\"sha256\":\"%64[0-9a-f]", hash) == 1;
    wire_close(&wire);
    if (!ok) return bench_complain("the model is not stored");
    snprintf(text, sizeof text, task->kind->scene, hash);
    scene->bytes = strdup(text);
    scene->size = strlen(text);
    return scene->bytes;
}

/* Sends the request some times, each after the answer to the one before; what the steps of the daemon took. */
static bool time_alone(const struct daemon *daemon, const struct kind *kind, const struct document *body,
                       struct series *series, size_t *answer_bytes)
{
    const char *const type = kind->scene ? JSON_TYPE : "Content-Type: model/stl";
    bool ok = true;
    for (int i = 0; ok && i < ALONE; i++) {
        struct reply reply =
            client_send(daemon, "POST", kind->target, (const char *const[]){type, NULL}, body->bytes, body->size);
        const struct wire_answer answer = {.headers = reply.headers};
        ok = reply.status == 200;
        if (ok && i >= 3) /* the daemon keeps a model from the second time on */
            series_add(series, wire_step_ms(&answer, "parse") + wire_step_ms(&answer, "render") +
                                   wire_step_ms(&answer, "encode"));
        *answer_bytes = reply.size;
        if (!ok) bench_complain("the daemon answered %ld: %s", reply.status, reply.body ? reply.body : "");
        reply_free(&reply);
    }
    return ok;
}

static bool measure_with(const struct task *task, const struct daemon *daemon, const struct sink *sink)
{
    const struct kind *kind = task->kind;
    struct document scene = {NULL, 0};
    const bool is_stored = kind->scene && *kind->scene;
    if (is_stored && !write_scene(task, daemon->port, &scene)) return false;
    const struct document *body = is_stored ? &scene : kind->scene ? &task->cube : &task->model;
    struct series alone = {.count = 0};
    struct load_result best = {.served = 0}, calm = {.served = 0};
    size_t size = 0, answer_bytes = 0;
    char *request =
        load_make_request(kind->target, kind->scene ? "application/json" : "model/stl", body->bytes, body->size, &size);
    bool ok = request && time_alone(daemon, kind, body, &alone, &answer_bytes);
    for (int round = 0; ok && round < ROUNDS; round++) {
        struct load load = {
            .port = daemon->port, .connections = CONNECTIONS, .request = request, .size = size, .seconds = SECONDS};
        struct load_result result = {.served = 0};
        ok = load_run(&load, &result);
        if (result.served > best.served) best = result;
        load.per_second = SHARE * best.served;
        ok = ok && load_run(&load, &result);
        if (round == 0 || result.p99_ms < calm.p99_ms) calm = result;
    }
    struct row row = {.ours_ms = best.served > 0 ? 1000.0 / best.served : 1e6, .theirs_ms = series_median(&alone)};
    snprintf(row.work, sizeof row.work, "%s", kind->name);
    const int used = snprintf(
        row.note, sizeof row.note, "%.4g/s; at 70 %% p50 %.3g, p99 %.3g ms; %.0f kB; peak %.0f MiB", best.served,
        calm.p50_ms, calm.p99_ms, (double)answer_bytes / 1000.0, (double)daemon_memory_kib(daemon, "VmHWM:") / 1024.0);
    ok = ok && used < (int)sizeof row.note;
    if (ok) sink_row(sink, &row);
    free(scene.bytes);
    free(request);
    return ok;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    char folder[] = "/tmp/zraster-bench-XXXXXX", flag[64], command[64];
    if (!mkdtemp(folder)) return bench_complain("no folder for assets can be made");
    snprintf(flag, sizeof flag, "--assets-dir=%s", folder);
    load_take_first_processor();
    struct daemon daemon = daemon_start(LIST("--workers=1", "--threads=1", flag));
    load_take_other_processors();
    const bool ok = measure_with(context, &daemon, sink);
    daemon_stop(&daemon);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return (system(command) == 0 || bench_complain("%s cannot be removed", folder)) && ok;
}

void service_capacity(struct bench *bench)
{
    struct work cube, animal;
    bool any = false;
    for (int i = 0; i < KINDS && !bench->check_only; i++)
        any |= bench_wants(bench, kinds[i].name);
    if (!any) return;
    if (!works_make(WORK_CUBE, bench->models, &cube) || !works_make(WORK_BUNNY, bench->models, &animal))
        bench->results.failed = true;
    struct task task = {.cube = document_indexed(&cube.drawing, true), .model = document_stl(&animal.drawing)};
    results_begin_table(&bench->results, "capacity of a daemon on one processor: time per picture under load, against "
                                         "the processor time of one picture alone");
    for (int i = 0; i < KINDS && task.cube.bytes && task.model.bytes; i++) {
        task.kind = &kinds[i];
        if (bench_wants(bench, kinds[i].name)) bench_in_child(bench, measure, &task, NULL);
    }
    free(task.cube.bytes);
    free(task.model.bytes);
    works_free(&cube);
    works_free(&animal);
}
