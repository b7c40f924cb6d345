/* Model files that the daemon keeps as read: the same file again with another view, against a daemon that keeps none.
 * The note tells how much longer a whole request takes than drawing and encoding alone.
 */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/input/documents.h"
#include "bench/input/meshes.h"
#include "bench/series.h"
#include "server/support/client.h"

enum { OURS, ALONE, THEIRS, TIMES };
enum { SIDES = 2, LARGE_RINGS = 525, SMALL_RINGS = 60, OBJECTS = 32, SCENE_SIZE = 1 << 15, HASH_SIZE = 65 };

/* 4 * 525 * 524 = 1 100 400 triangles; 14 160. */
static const struct kind {
    const char *name;
    struct document (*write)(const struct drawing *drawing);
    uint32_t rings;
    int objects;
    const char *header; /* of the file, which is sent with each request; NULL: it is stored before */
} kinds[] = {
    {"HTTP: kept GLB of 1.1 M by its hash, 512x512 1T", document_glb, LARGE_RINGS, 1, NULL},
    {"HTTP: kept STL of 1.1 M by its hash, 512x512 1T", document_stl, LARGE_RINGS, 1, NULL},
    {"HTTP: kept PLY of 1.1 M by its hash, 512x512 1T", document_ply, LARGE_RINGS, 1, NULL},
    {"HTTP: kept OBJ of 1.1 M by its hash, 512x512 1T", document_obj, LARGE_RINGS, 1, NULL},
    {"HTTP: kept GLB of 1.1 M, sent again, 512x512 1T", document_glb, LARGE_RINGS, 1,
     "Content-Type: model/gltf-binary"},
    {"HTTP: kept STL of 1.1 M, sent again, 512x512 1T", document_stl, LARGE_RINGS, 1, "Content-Type: model/stl"},
    {"HTTP: kept OBJ of 1.1 M, sent again, 512x512 1T", document_obj, LARGE_RINGS, 1, "Content-Type: model/obj"},
    {"HTTP: kept GLBs of 14 k by hashes, 32 of them, moved, 512x512 1T", document_glb, SMALL_RINGS, OBJECTS, NULL},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

struct side {
    struct daemon daemon;
    struct wire wire;
};

struct task {
    const struct kind *kind;
    struct side sides[SIDES]; /* that keeps meshes, and that does not */
    char hashes[OBJECTS][HASH_SIZE];
    struct document sent; /* the file, if it is not stored */
    int number;           /* of the request */
};

/* Makes the file of an object. Their positions differ a little. */
static struct document make_file(const struct kind *kind, int object)
{
    struct drawing drawing = {.failed = false};
    meshes_ball(&drawing, kind->rings);
    meshes_look(&drawing, false, 1.0f, 512, 512);
    drawing.positions[0].x += 1e-3f * (float)object;
    const struct document document = kind->write(&drawing);
    drawing_free(&drawing);
    return document;
}

static bool upload(struct task *task, struct side *side)
{
    for (int i = 0; i < task->kind->objects; i++) {
        struct wire_answer answer = {0};
        struct document document = make_file(task->kind, i);
        const bool ok = document.bytes &&
                        wire_ask(&side->wire, "POST", "/v1/assets", document.bytes, document.size, &answer) &&
                        sscanf(answer.body, "{\"sha256\":\"%64[0-9a-f]", task->hashes[i]) == 1;
        free(document.bytes);
        if (!ok) return bench_complain("the daemon answered %d: %.*s", answer.status, (int)answer.size, answer.body);
    }
    return true;
}

/* The objects in a row, which moves from request to request. */
static size_t write_scene(const struct task *task, char *text)
{
    const int objects = task->kind->objects;
    size_t used =
        (size_t)snprintf(text, SCENE_SIZE, "{\"window\":{\"width\":512,\"height\":512},\"look\":\"clay\",\"meshes\":[");
    for (int i = 0; i < objects; i++)
        used += (size_t)snprintf(text + used, SCENE_SIZE - used, "%s{\"asset\":\"sha256:%s\"}", i ? "," : "",
                                 task->hashes[i]);
    used += (size_t)snprintf(text + used, SCENE_SIZE - used, "],\"nodes\":[");
    for (int i = 0; i < objects; i++)
        used += (size_t)snprintf(text + used, SCENE_SIZE - used,
                                 "%s{\"mesh\":%d,\"translation\":[%d,%d,0],\"rotation\":[0,0,%.4f,1]}", i ? "," : "", i,
                                 3 * (i % 8), 3 * (i / 8), 0.01 * (task->number % 50 + i));
    used += (size_t)snprintf(text + used, SCENE_SIZE - used, "]}");
    return used;
}

static bool ask(const struct task *task, struct side *side, struct wire_answer *answer)
{
    char text[SCENE_SIZE];
    const size_t size = write_scene(task, text);
    return (wire_ask(&side->wire, "POST", "/v1/render", text, size, answer) && answer->status == 200) ||
           bench_complain("the daemon answered %d: %.*s", answer->status, (int)answer->size, answer->body);
}

/* Sends the file with another view. */
static bool send(struct task *task, struct series *series)
{
    struct reply replies[SIDES];
    char target[80];
    snprintf(target, sizeof target, "/v1/render?width=512&height=512&look=clay&azimuth=%d", task->number % 360);
    for (int i = 0; i < SIDES; i++) {
        const double begin = now_ms();
        replies[i] = client_send(&task->sides[i].daemon, "POST", target,
                                 (const char *const[]){task->kind->header, NULL}, task->sent.bytes, task->sent.size);
        series_add(&series[i == 0 ? OURS : THEIRS], now_ms() - begin);
    }
    const struct wire_answer timing = {.headers = replies[0].headers};
    series_add(&series[ALONE], wire_step_ms(&timing, "render") + wire_step_ms(&timing, "encode"));
    const bool ok = replies[0].status == 200 && reply_is_same(&replies[0], &replies[1]);
    reply_free(&replies[0]);
    reply_free(&replies[1]);
    return ok;
}

static bool run_round(void *context, struct series *series)
{
    struct task *task = context;
    struct wire_answer answers[SIDES] = {{0}, {0}};
    task->number++;
    if (task->kind->header) return send(task, series);
    for (int i = 0; i < SIDES; i++) {
        const double begin = now_ms();
        if (!ask(task, &task->sides[i], &answers[i])) return false;
        series_add(&series[i == 0 ? OURS : THEIRS], now_ms() - begin);
    }
    series_add(&series[ALONE], wire_step_ms(&answers[0], "render") + wire_step_ms(&answers[0], "encode"));
    return answers[0].size == answers[1].size && memcmp(answers[0].body, answers[1].body, answers[0].size) == 0;
}

static bool open_sides(struct task *task, char folders[SIDES][32])
{
    bool ok = true;
    if (task->kind->header) task->sent = make_file(task->kind, 0);
    for (int i = 0; i < SIDES; i++) {
        struct side *side = &task->sides[i];
        char flag[64];
        snprintf(flag, sizeof flag, "--assets-dir=%s", folders[i]);
        side->daemon = daemon_start((const char *const[]){
            "--workers=1", "--threads=1", "--keep-memory-bytes=1000000000",
            i == 0 ? "--keep-mesh-bytes=500000000" : "--keep-mesh-bytes=0", flag, "--body-max-bytes=500000000", NULL});
        ok = ok && wire_open(&side->wire, side->daemon.port) && (task->kind->header || upload(task, side));
    }
    return ok;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[TIMES];
    struct task task = {.kind = context, .sides = {{.wire.fd = -1}, {.wire.fd = -1}}};
    char folders[SIDES][32] = {"/tmp/zraster-bench-XXXXXX", "/tmp/zraster-bench-XXXXXX"}, command[80];
    if (!mkdtemp(folders[0]) || !mkdtemp(folders[1])) return bench_complain("no folder for assets can be made");
    const bool ok = open_sides(&task, folders) && series_run(series, TIMES, bench->rounds, run_round, &task);
    for (int i = 0; i < SIDES; i++) {
        wire_close(&task.sides[i].wire);
        daemon_stop(&task.sides[i].daemon);
    }
    free(task.sent.bytes);
    snprintf(command, sizeof command, "rm -rf %s %s", folders[0], folders[1]);
    if (system(command) != 0) return bench_complain("%s cannot be removed", folders[0]);
    if (!ok) return bench_complain("an answer is missing, or its bytes depend on kept meshes");
    struct row row = {.ours_ms = series_median(&series[OURS]), .theirs_ms = series_median(&series[THEIRS])};
    const double alone = series_median(&series[ALONE]);
    snprintf(row.work, sizeof row.work, "%s", task.kind->name);
    snprintf(row.note, sizeof row.note, "%.2f times drawing and encoding alone, %.2f ms", row.ours_ms / alone, alone);
    sink_row(sink, &row);
    return true;
}

void service_with_kept_meshes(struct bench *bench)
{
    for (int i = 0; i < KINDS; i++) {
        struct kind kind = kinds[i];
        if (bench->check_only || !bench_wants(bench, kind.name)) continue;
        results_begin_table(&bench->results, "the daemon with meshes that it keeps against one that reads them anew");
        bench_in_child(bench, measure, &kind, NULL);
    }
}
