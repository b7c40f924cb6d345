/* How long a small request takes while others read large assets, or send small bodies that take long to read: the
 * daemon on one processor, all its clients on another. */
#include <isa-l/igzip_lib.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "bench/http/load.h"
#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/input/documents.h"
#include "bench/series.h"
#include "bench/works.h"
#include "server/support/client.h"
#include "support/input/base64.h"

enum { ASSET_BYTES = 60000000, INFLATED_BYTES = 62000000, OTHERS = 6, SMALL_MAX = 400, PAUSE_MS = 5, BEGIN_MS = 300 };
enum { BUFFER_BYTES = 1 << 20 };

enum beside { NOTHING, ASSETS, GZIP, IMAGES, BESIDE_COUNT };

static const char *const names[BESIDE_COUNT] = {[NOTHING] = "HTTP: a cube 256x256 to PNG, nobody else there",
                                                [ASSETS] = "HTTP: a cube 256x256 to PNG, beside 6 GETs of 60 MB",
                                                [GZIP] = "HTTP: a cube 256x256 to PNG, beside 6 gzips of 62 MB",
                                                [IMAGES] = "HTTP: a cube 256x256 to PNG, beside 6 images of 500x500"};

/* One of the others: sends the same request again and again, each on a new connection that its answer ends. */
struct other {
    const struct daemon *daemon;
    const char *request;
    size_t size;
    atomic_bool *over;
    pthread_t thread;
    int answers;
    double bytes;
};

static void *run_other(void *argument)
{
    struct other *other = argument;
    char *buffer = malloc(BUFFER_BYTES);
    while (buffer && !atomic_load(other->over)) {
        const int fd = client_connect(other->daemon);
        ssize_t count = client_write(fd, other->request, other->size) ? 1 : 0;
        bool any = false;
        while (count > 0 && !atomic_load(other->over) && (count = recv(fd, buffer, BUFFER_BYTES, 0)) > 0) {
            other->bytes += (double)count;
            any = true;
        }
        other->answers += any && count == 0;
        close(fd);
    }
    free(buffer);
    return NULL;
}

static bool measure_small(struct wire *wire, const struct document *small, struct series *series)
{
    series->count = 0;
    while (series->count < SMALL_MAX) {
        struct wire_answer answer = {0};
        const double begin = now_ms();
        if (!wire_ask(wire, "POST", "/v1/render", small->bytes, small->size, &answer) || answer.status != 200)
            return false;
        series_add(series, now_ms() - begin);
        nanosleep(&(struct timespec){.tv_nsec = PAUSE_MS * 1000000L}, NULL);
    }
    return true;
}

static bool measure_row(const struct daemon *daemon, const struct document *small, enum beside beside,
                        const struct document *request, struct row *row)
{
    static struct series series;
    struct other others[OTHERS];
    struct wire wire;
    atomic_bool over = false;
    int begun = 0, answers = 0;
    double bytes = 0.0;
    bool ok = wire_open(&wire, daemon->port);
    for (; ok && beside != NOTHING && begun < OTHERS; begun++) {
        others[begun] =
            (struct other){.daemon = daemon, .request = request->bytes, .size = request->size, .over = &over};
        ok = pthread_create(&others[begun].thread, NULL, run_other, &others[begun]) == 0;
        if (!ok) break;
    }
    nanosleep(&(struct timespec){.tv_nsec = BEGIN_MS * 1000000L}, NULL);
    ok = ok && measure_small(&wire, small, &series);
    atomic_store(&over, true);
    for (int i = 0; i < begun; i++) {
        pthread_join(others[i].thread, NULL);
        answers += others[i].answers;
        bytes += others[i].bytes;
    }
    wire_close(&wire);
    if (!ok) return false;
    row->ours_ms = series_median(&series);
    snprintf(row->work, sizeof row->work, "%s", names[beside]);
    const int used = snprintf(row->note, sizeof row->note, "99 of 100 within %.1f ms", series_percentile(&series, 99));
    if (beside != NOTHING)
        snprintf(row->note + used, sizeof row->note - (size_t)used, "; of the others: %d answers, %.0f MB", answers,
                 bytes / 1e6);
    return true;
}

/* Keeps an asset there, and asks for it; .bytes NULL on failure. */
static struct document ask_for_asset(const struct daemon *daemon)
{
    struct document request = {NULL, 0};
    char *asset = malloc(ASSET_BYTES);
    if (!asset) return request;
    for (size_t i = 0; i < ASSET_BYTES; i++)
        asset[i] = (char)(i * 2654435761u >> 13);
    struct reply reply =
        client_send(daemon, "POST", "/v1/assets", (const char *const[]){"Content-Type: application/octet-stream", NULL},
                    asset, ASSET_BYTES);
    const char *where = reply_header(&reply, "Location");
    FILE *out = reply.status == 201 ? open_memstream(&request.bytes, &request.size) : NULL;
    if (out) {
        fprintf(out, "GET %s HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n", where);
        fclose(out);
    }
    reply_free(&reply);
    free(asset);
    return request;
}

/* A render of white space: its body is some tens of KB; .bytes NULL on failure. */
static struct document ask_with_gzip(void)
{
    struct document request = {NULL, 0};
    struct isal_zstream stream;
    char *spaces = malloc(INFLATED_BYTES), *packed = malloc(BUFFER_BYTES);
    FILE *out = spaces && packed ? open_memstream(&request.bytes, &request.size) : NULL;
    if (out) {
        memset(spaces, ' ', INFLATED_BYTES);
        isal_deflate_stateless_init(&stream);
        stream.gzip_flag = IGZIP_GZIP;
        stream.next_in = (uint8_t *)spaces;
        stream.avail_in = INFLATED_BYTES;
        stream.next_out = (uint8_t *)packed;
        stream.avail_out = BUFFER_BYTES;
        if (isal_deflate_stateless(&stream) == COMP_OK) {
            fprintf(out,
                    "POST /v1/render HTTP/1.1\r\nHost: a\r\nConnection: close\r\nContent-Type: application/json\r\n"
                    "Content-Encoding: gzip\r\nContent-Length: %u\r\n\r\n",
                    stream.total_out);
            fwrite(packed, 1, stream.total_out, out);
        }
        fclose(out);
    }
    free(spaces);
    free(packed);
    return request;
}

/* A render with a texture of as many pixels as a small request may have; .bytes NULL on failure. */
static struct document ask_with_image(const struct daemon *daemon)
{
    static const char PICTURE[] =
        "{\"window\":{\"width\":500,\"height\":500},\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],"
        "[0,1,0]]}]}";
    static const char SCENE[] =
        "{\"window\":{\"width\":64,\"height\":64},\"meshes\":[{\"material\":\"m\",\"positions\":"
        "[[0,0,0],[1,0,0],[0,1,0]],\"texcoords\":[[0,0],[1,0],[0,1]],\"faces\":[[0,1,2]]}],"
        "\"materials\":[{\"name\":\"m\",\"baseColorTexture\":{\"uri\":\"";
    struct document request = {NULL, 0};
    struct reply reply = client_render(daemon, PICTURE);
    char *uri = reply.status == 200 ? base64_of("data:image/png;base64,", reply.body, reply.size) : NULL;
    FILE *out = uri ? open_memstream(&request.bytes, &request.size) : NULL;
    if (out) {
        fprintf(out,
                "POST /v1/render HTTP/1.1\r\nHost: a\r\nConnection: close\r\nContent-Type: application/json\r\n"
                "Content-Length: %zu\r\n\r\n%s%s\"}}]}",
                strlen(SCENE) + strlen(uri) + strlen("\"}}]}"), SCENE, uri);
        fclose(out);
    }
    free(uri);
    reply_free(&reply);
    return request;
}

struct task {
    const struct document *small;
    bool wanted[BESIDE_COUNT];
};

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    const struct task *task = context;
    char folder[] = "/tmp/zraster-bench-XXXXXX", flag[64], command[64];
    if (!mkdtemp(folder)) return bench_complain("no folder for assets can be made");
    snprintf(flag, sizeof flag, "--assets-dir=%s", folder);
    load_take_first_processor();
    struct daemon daemon = daemon_start(LIST(flag, "--max-per-client=0"));
    load_take_other_processors();
    struct document requests[BESIDE_COUNT] = {
        [ASSETS] = ask_for_asset(&daemon), [GZIP] = ask_with_gzip(), [IMAGES] = ask_with_image(&daemon)};
    bool ok = requests[ASSETS].bytes && requests[GZIP].bytes && requests[IMAGES].bytes;
    for (int i = 0; ok && i < BESIDE_COUNT; i++) {
        struct row row = {.work = ""};
        if (!task->wanted[i]) continue;
        ok = measure_row(&daemon, task->small, (enum beside)i, &requests[i], &row);
        if (ok) sink_row(sink, &row);
    }
    daemon_stop(&daemon);
    for (int i = 0; i < BESIDE_COUNT; i++)
        free(requests[i].bytes);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (system(command) != 0) return bench_complain("%s cannot be removed", folder);
    return ok || bench_complain("a small request beside large transfers was not answered");
}

void service_beside_io(struct bench *bench)
{
    struct work work;
    struct task task = {.wanted = {false}};
    bool any = false;
    if (bench->check_only) return;
    for (int i = 0; i < BESIDE_COUNT; i++)
        any |= task.wanted[i] = bench_wants(bench, names[i]);
    if (!any) return;
    if (!works_make(WORK_CUBE, bench->models, &work)) bench->results.failed = true;
    struct document document = work.corners ? document_indexed(&work.drawing, true) : (struct document){NULL, 0};
    task.small = &document;
    if (document.bytes) {
        results_begin_table(&bench->results, "a small request beside large transfers");
        bench_in_child(bench, measure, &task, NULL);
    }
    free(document.bytes);
    works_free(&work);
}
