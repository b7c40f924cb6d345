/* Drake's loop: a textured glTF of 20 MB is sent anew for each frame, and only matrices of nodes differ. Ours is the
 * median frame after the first, theirs the first frame of the same daemon; the median of some daemons.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench/http/service.h"
#include "bench/series.h"
#include "server/support/client.h"
#include "support/input/base64.h"
#include "support/pictures/png.h"

enum { OBJECTS = 8, ACROSS = 4, IMAGES = 2, SIDE = 2048, COLUMNS = 110, ROWS = 100, DAEMONS = 3, FRAMES = 34 };
enum { VERTICES = COLUMNS * ROWS, INDICES = 6 * (COLUMNS - 1) * (ROWS - 1), WIDTH = 640, HEIGHT = 480 };
enum { VERTEX_BYTES = 32, MESH_BYTES = VERTICES * VERTEX_BYTES + INDICES * 4, TEXT_BYTES = 1 << 14 };
enum { FIRST, LATER, FIRST_CPU, LATER_CPU, TIMES };

static const struct bar bar = {1 / 0.3, 4};

struct task {
    const char *kind;
    char *buffer, *images[IMAGES]; /* data: URIs */
    char *body;
    size_t room, size;
};

/* ---- the file ---- */

/* Makes texels with as much detail as a photo: waves, and noise in the lower bits. */
static char *make_image(uint32_t number)
{
    uint32_t seed = number + 1;
    uint8_t *rgba = malloc((size_t)4 * SIDE * SIDE);
    size_t size = 0;
    for (uint32_t k = 0; rgba && k < SIDE * SIDE; k++) {
        const uint32_t x = k % SIDE, y = k / SIDE;
        seed = seed * 1664525u + 1013904223u;
        for (uint32_t c = 0; c < 3; c++)
            rgba[4 * k + c] = (uint8_t)((x * (c + 1) / 8 ^ y / (4 + number)) + (seed >> (8 * c + 4) & 7));
        rgba[4 * k + 3] = 255;
    }
    uint8_t *png = rgba ? png_memory_write(rgba, SIDE, SIDE, &size) : NULL;
    char *uri = png ? base64_of("data:image/png;base64,", png, size) : NULL;
    free(png);
    free(rgba);
    return uri;
}

/* Writes positions, normals, texture coordinates and triangles of a ball. */
static void put_mesh(unsigned char *at)
{
    const float turn = 6.28318531f;
    float *positions = (void *)at, *normals = positions + 3 * VERTICES, *texcoords = normals + 3 * VERTICES;
    uint32_t *indices = (void *)(texcoords + 2 * VERTICES);
    for (int i = 0; i < VERTICES; i++) {
        const float u = (float)(i % COLUMNS) / (COLUMNS - 1), v = (float)(i / COLUMNS) / (ROWS - 1);
        const float point[3] = {cosf(turn * u) * sinf(turn * v / 2), sinf(turn * u) * sinf(turn * v / 2),
                                cosf(turn * v / 2)};
        memcpy(positions + 3 * i, point, sizeof point);
        memcpy(normals + 3 * i, point, sizeof point);
        texcoords[2 * i] = u;
        texcoords[2 * i + 1] = v;
    }
    for (uint32_t row = 0; row < ROWS - 1; row++)
        for (uint32_t column = 0; column < COLUMNS - 1; column++) {
            const uint32_t a = row * COLUMNS + column, b = a + COLUMNS;
            memcpy(indices, (const uint32_t[]){a, b, a + 1, a + 1, b, b + 1}, 6 * sizeof *indices);
            indices += 6;
        }
}

static bool make_parts(struct task *task)
{
    unsigned char *bytes = malloc((size_t)OBJECTS * MESH_BYTES);
    for (size_t i = 0; bytes && i < OBJECTS; i++)
        put_mesh(bytes + i * MESH_BYTES);
    task->buffer =
        bytes ? base64_of("data:application/octet-stream;base64,", bytes, (size_t)OBJECTS * MESH_BYTES) : NULL;
    task->room = task->buffer ? strlen(task->buffer) + TEXT_BYTES : 0;
    for (uint32_t i = 0; i < IMAGES; i++) {
        task->images[i] = make_image(i);
        if (task->images[i]) task->room += strlen(task->images[i]);
    }
    task->body = malloc(task->room);
    free(bytes);
    return task->buffer && task->images[0] && task->images[1] && task->body;
}

static void put_fields(struct task *task)
{
    static const char *const fields[][2] = {{"width", "640"},    {"height", "480"},  {"near", "0.1"},
                                            {"far", "40"},       {"focal_x", "657"}, {"focal_y", "657"},
                                            {"center_x", "320"}, {"center_y", "240"}};
    char *at = task->body, *const end = at + task->room;
#define PUT(...)               (at += snprintf(at, (size_t)(end - at), __VA_ARGS__))
#define PUT_FIELD(name, value) PUT("--b\r\nContent-Disposition: form-data; name=\"%s\"\r\n\r\n%s\r\n", name, value)
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        PUT_FIELD(fields[i][0], fields[i][1]);
    PUT_FIELD("image_type", task->kind);
    if (strcmp(task->kind, "depth") == 0) {
        PUT_FIELD("min_depth", "0.1");
        PUT_FIELD("max_depth", "20");
    }
    task->size = (size_t)(at - task->body);
}

/* Writes the form of a frame. Its keys are in the order of their names, as those of VTK's files are. */
static void put_form(struct task *task, int frame)
{
    put_fields(task);
    char *at = task->body + task->size, *const end = task->body + task->room;
    PUT("--b\r\nContent-Disposition: form-data; name=\"scene\"; filename=\"a.gltf\"\r\n\r\n{\"accessors\":[");
    for (int i = 0; i < 4 * OBJECTS; i++)
        PUT("%s{\"bufferView\":%d,\"componentType\":%d,\"count\":%d,\"type\":\"%s\"}", i ? "," : "", i,
            i % 4 == 3 ? 5125 : 5126, i % 4 == 3 ? INDICES : VERTICES,
            (const char *const[]){"VEC3", "VEC3", "VEC2", "SCALAR"}[i % 4]);
    PUT("],\"asset\":{\"version\":\"2.0\"},\"bufferViews\":[");
    for (int i = 0; i < 4 * OBJECTS; i++)
        PUT("%s{\"buffer\":0,\"byteOffset\":%d,\"byteLength\":%d}", i ? "," : "",
            i / 4 * MESH_BYTES + (const int[]){0, 12, 24, 32}[i % 4] * VERTICES,
            i % 4 == 3 ? 4 * INDICES : (i % 4 == 2 ? 8 : 12) * VERTICES);
    PUT("],\"buffers\":[{\"byteLength\":%d,\"uri\":\"%s\"}],\"cameras\":[{\"type\":\"perspective\",\"perspective\":{"
        "\"yfov\":0.7,\"znear\":0.1,\"zfar\":40}}],\"images\":[{\"uri\":\"%s\"},{\"uri\":\"%s\"}],\"materials\":[",
        OBJECTS * MESH_BYTES, task->buffer, task->images[0], task->images[1]);
    for (int i = 0; i < IMAGES; i++)
        PUT("%s{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":%d}}}", i ? "," : "", i);
    PUT("],\"meshes\":[");
    for (int i = 0; i < OBJECTS; i++)
        PUT("%s{\"primitives\":[{\"attributes\":{\"NORMAL\":%d,\"POSITION\":%d,\"TEXCOORD_0\":%d},\"indices\":%d,"
            "\"material\":%d}]}",
            i ? "," : "", 4 * i + 1, 4 * i, 4 * i + 2, 4 * i + 3, i % IMAGES);
    PUT("],\"nodes\":[");
    for (int i = 0; i < OBJECTS; i++) {
        const double angle = 0.07 * frame + i, c = cos(angle), s = sin(angle);
        PUT("{\"matrix\":[%.17g,%.17g,0,0,%.17g,%.17g,0,0,0,0,1,0,%.17g,%.17g,%.17g,1],\"mesh\":%d},", c, s, -s, c,
            2.2 * (i % ACROSS) - 3.3 + 0.1 * c, 2.2 * (i / ACROSS) - 1.1, 0.1 * s, i);
    }
    PUT("{\"camera\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,%.17g,0,9,1]}],\"scene\":0,\"scenes\":[{\"nodes\":["
        "0,1,2,3,4,5,6,7,8]}],\"textures\":[{\"source\":0},{\"source\":1}]}\r\n--b--\r\n",
        0.02 * sin(frame));
#undef PUT_FIELD
#undef PUT
    task->size = (size_t)(at - task->body);
}

/* ---- frames ---- */

/* Returns the milliseconds of processor time that a process has taken. */
static double cpu_ms(pid_t pid)
{
    clockid_t clock;
    struct timespec time = {0, 0};
    if (clock_getcpuclockid(pid, &clock) == 0) clock_gettime(clock, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

static bool draw(struct task *task, const struct daemon *daemon, int frame, struct series *wall, struct series *cpu)
{
    static const char *const type[] = {"Content-Type: multipart/form-data; boundary=b", "Expect:", NULL};
    put_form(task, frame);
    const double begin = now_ms(), begin_cpu = cpu_ms(daemon->pid);
    struct reply reply = client_send(daemon, "POST", "/render", type, task->body, task->size);
    series_add(wall, now_ms() - begin);
    series_add(cpu, cpu_ms(daemon->pid) - begin_cpu);
    const bool ok = reply.status == 200;
    if (!ok) bench_complain("the daemon answered %ld: %.*s", reply.status, (int)reply.size, reply.body);
    reply_free(&reply);
    return ok;
}

static bool run_daemon(struct task *task, struct series *series)
{
    struct daemon daemon = daemon_start((const char *const[]){"--threads=2", NULL});
    static struct series wall, cpu;
    wall.count = cpu.count = 0;
    bool ok = draw(task, &daemon, 0, &series[FIRST], &series[FIRST_CPU]);
    for (int i = 1; ok && i < FRAMES; i++)
        ok = draw(task, &daemon, i, &wall, &cpu);
    daemon_stop(&daemon);
    series_add(&series[LATER], series_median(&wall));
    series_add(&series[LATER_CPU], series_median(&cpu));
    return ok;
}

static void add_row(const struct sink *sink, const struct task *task, const struct series *first,
                    const struct series *later, const char *what)
{
    struct row row = {.ours_ms = series_median(later), .theirs_ms = series_median(first), .bar = bar};
    snprintf(row.work, sizeof row.work, "HTTP: Drake's %s, later frames, %s 2T", task->kind, what);
    snprintf(row.note, sizeof row.note, "%.2f of it; %dx%d, a form of %.1f MB", row.ours_ms / row.theirs_ms, WIDTH,
             HEIGHT, 1e-6 * (double)task->size);
    sink_row(sink, &row);
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[TIMES];
    struct task task = {.kind = context};
    bool ok = make_parts(&task) || bench_complain("no memory");
    (void)bench;
    for (int i = 0; ok && i < DAEMONS; i++)
        ok = run_daemon(&task, series);
    free(task.buffer);
    free(task.images[0]);
    free(task.images[1]);
    free(task.body);
    if (!ok) return false;
    add_row(sink, &task, &series[FIRST], &series[LATER], "wall");
    add_row(sink, &task, &series[FIRST_CPU], &series[LATER_CPU], "processor time");
    return true;
}

void service_for_drake(struct bench *bench)
{
    static const char *const images[] = {"color", "depth", "label"};
    for (size_t i = 0; i < sizeof images / sizeof *images; i++) {
        char kind[8], name[ROW_NAME_SIZE];
        snprintf(kind, sizeof kind, "%s", images[i]);
        snprintf(name, sizeof name, "HTTP: Drake's %s", kind);
        if (bench->check_only || !bench_wants(bench, name)) continue;
        results_begin_table(&bench->results, "Drake's loop: the same glTF again with other matrices of nodes");
        bench_in_child(bench, measure, kind, NULL);
    }
}
