/* zraster-bench: the bunny over HTTP, beside llvmpipe.
 *
 * First every pixel of the daemon's answer is held against the reference; then both
 * sides are timed in turns, in one run, with the same number of threads. Times drift
 * from run to run and from machine to machine: the ratio is what counts.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/over_http.h"
#include "reference/compare.h"
#include "reference/models.h"
#include "reference/subject.h"
#include "shade/frame.h"

enum { WIDTH = 1920, HEIGHT = 1080, ROUNDS = 21, VIEW = 0 };

struct options {
    const char *models;
    bool check_only;
};

static int by_value(const void *a, const void *b)
{
    double d = *(const double *)a - *(const double *)b;
    return (d > 0) - (d < 0);
}

static double median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, by_value);
    return values[count / 2];
}

/* All triangles in one call, indexed, as a program that wants to be fast would. */
static struct reference_arrays indexed(const struct drawing *drawing, struct reference_batch *batch)
{
    *batch = (struct reference_batch){
        .mode = REFERENCE_TRIANGLES, .count = drawing->corner_count, .modelview = &drawing->modelview, .smooth = true};
    return (struct reference_arrays){.positions = drawing->positions,
                                     .front = drawing->colors,
                                     .indices = drawing->indices,
                                     .batch_count = 1,
                                     .batches = batch,
                                     .projection = drawing->projection,
                                     .background = {0, 0, 0, 1}};
}

static struct daemon start_daemon(int threads)
{
    char flag[32];
    snprintf(flag, sizeof flag, "--threads=%d", threads);
    return daemon_start((const char *const[]){"--workers=1", flag, NULL});
}

static struct reference *open_reference(bool native, int threads, const struct drawing *drawing)
{
    struct reference_error error = {""};
    struct reference_options options = {.driver = "llvmpipe", .native = native, .threads = threads};
    struct reference *reference = reference_open(&options, &error);
    if (reference && reference_resize(reference, drawing->width, drawing->height, false, &error)) return reference;
    fprintf(stderr, "no reference: %s\n", error.text);
    return NULL;
}

/* ---- is it right? ---- */

static int compare_with_reference(const struct drawing *drawing, const uint8_t *rgba, const float *depth)
{
    size_t pixels = (size_t)drawing->width * drawing->height, differing = 0, covered = 0;
    uint8_t *want_rgba = malloc(pixels * 4);
    float *want_depth = malloc(pixels * sizeof *want_depth);
    struct reference_batch batch;
    struct reference_arrays arrays = indexed(drawing, &batch);
    struct reference_error error = {""};
    struct reference *reference = open_reference(false, 1, drawing);
    bool ok = want_rgba && want_depth && reference && reference_draw(reference, &arrays, &error) &&
              reference_read(reference, want_rgba, want_depth, &error);
    for (size_t i = 0; ok && i < pixels; i++) {
        covered += want_depth[i] < 1.0f;
        bool equal = memcmp(want_rgba + 4 * i, rgba + 4 * i, 4) == 0 && compare_ulp(want_depth[i], depth[i]) == 0;
        if (!equal && differing++ < 5)
            printf("# pixel %zu, %zu: want %02x%02x%02x depth %.9g, got %02x%02x%02x depth %.9g\n", i % drawing->width,
                   i / drawing->width, want_rgba[4 * i], want_rgba[4 * i + 1], want_rgba[4 * i + 2],
                   (double)want_depth[i], rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], (double)depth[i]);
    }
    if (reference) reference_close(reference);
    free(want_rgba);
    free(want_depth);
    ok = ok && differing == 0 && covered > 0;
    printf("%s 1 - bunny over HTTP at %dx%d: %zu of %zu pixels differ from OSMesa in colour or depth, %zu covered\n",
           ok ? "ok" : "not ok", WIDTH, HEIGHT, differing, pixels, covered);
    return ok ? 0 : 1;
}

static int check(const struct drawing *drawing, const char *json)
{
    struct daemon daemon = start_daemon(2);
    struct http_times times;
    uint8_t *rgba = NULL;
    float *depth = NULL;
    bool ok = render_over_http(&daemon, json, drawing->width, drawing->height, &rgba, &depth, &times);
    daemon_stop(&daemon);
    int status = ok ? compare_with_reference(drawing, rgba, depth) : 1;
    free(rgba);
    free(depth);
    return status;
}

/* ---- is it fast? ---- */

struct series {
    double core[ROUNDS], llvmpipe[ROUNDS], total[ROUNDS], parse[ROUNDS], render[ROUNDS], encode[ROUNDS];
};

static bool one_round(int round, struct series *s, const struct daemon *daemon, const char *json,
                      struct reference *reference, struct zr_arena *arena, struct zr_team *team,
                      const struct drawing *drawing)
{
    struct reference_batch batch;
    struct reference_arrays arrays = indexed(drawing, &batch);
    struct reference_error error = {""};
    struct http_times times;
    if (!render_over_http(daemon, json, drawing->width, drawing->height, NULL, NULL, &times)) return false;
    struct subject subject;
    subject_make(&subject, drawing);
    double begin = now_ms();
    if (!reference_draw(reference, &arrays, &error)) return false;
    double middle = now_ms();
    bool ok = subject_render(arena, team, &subject.scene) != NULL;
    double end = now_ms();
    zr_arena_reset(arena, (size_t)1 << 30);
    if (round < 0) return ok; /* warming up */
    s->llvmpipe[round] = middle - begin;
    s->core[round] = end - middle;
    s->total[round] = times.total;
    s->parse[round] = times.parse;
    s->render[round] = times.render;
    s->encode[round] = times.encode;
    return ok;
}

/* A number of a JSON line; below 0 where it has none. */
static double number_of(const char *line, const char *key)
{
    const char *at = strstr(line, key), *end = strchr(line, '\n');
    return at && (!end || at < end) ? strtod(at + strlen(key), NULL) : -1.0;
}

/* What the daemon foresaw over what it took, the median of its log lines. */
static double foresight(const struct daemon *daemon)
{
    static double ratios[ROUNDS];
    int count = 0;
    char *log = daemon_log(daemon);
    for (const char *line = log; line && *line && count < ROUNDS;
         line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        double foreseen = number_of(line, "\"foreseenMs\":");
        double took = number_of(line, "\"renderMs\":") + number_of(line, "\"encodeMs\":");
        if (foreseen > 0 && took > 0) ratios[count++] = foreseen / took;
    }
    free(log);
    return count ? median(ratios, count) : 0.0;
}

static int measure(const struct drawing *drawing, const char *json, int threads)
{
    static struct series s;
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)1 << 30);
    struct zr_team *team = zr_team_create(threads);
    struct daemon daemon = start_daemon(threads);
    struct reference *reference = open_reference(true, threads, drawing);
    bool ok = team && reference;
    for (int round = -3; ok && round < ROUNDS; round++)
        ok = one_round(round, &s, &daemon, json, reference, &arena, team, drawing);
    if (reference) reference_close(reference);
    double foreseen = foresight(&daemon);
    daemon_stop(&daemon);
    zr_team_destroy(team);
    zr_arena_free(&arena);
    if (!ok) return 1;
    double llvmpipe = median(s.llvmpipe, ROUNDS), core = median(s.core, ROUNDS), render = median(s.render, ROUNDS);
    printf("%7d %10.2f %10.2f %8.2fx %10.2f %8.2fx %9.2f %9.2f %9.2f %8.2fx\n", threads, llvmpipe, core,
           llvmpipe / core, render, llvmpipe / render, median(s.parse, ROUNDS), median(s.encode, ROUNDS),
           median(s.total, ROUNDS), foreseen);
    return 0;
}

/* One reference context a process, and its settings come from the environment: each
 * job gets a process of its own. */
static int in_child(const struct drawing *drawing, const char *json, int threads)
{
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        int status = threads ? measure(drawing, json, threads) : check(drawing, json);
        fflush(stdout);
        _exit(status);
    }
    int status = -1;
    if (child < 0 || waitpid(child, &status, 0) != child) return 1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

static int usage(void)
{
    fputs("usage: zraster-bench --models DIR [--check-only]\n"
          "DIR holds stanford-bunny.obj; ZRASTERD names the daemon (build/zrasterd).\n",
          stderr);
    return 2;
}

int main(int count, char **arguments)
{
    struct options options = {NULL, false};
    for (int i = 1; i < count; i++) {
        if (strcmp(arguments[i], "--check-only") == 0)
            options.check_only = true;
        else if (strcmp(arguments[i], "--models") == 0 && i + 1 < count)
            options.models = arguments[++i];
        else
            return usage();
    }
    if (!options.models) return usage();
    struct drawing drawing = {0};
    if (!models_drawing(&drawing, options.models, "stanford-bunny", VIEW, WIDTH, HEIGHT)) return 1;
    drawing.smooth = true;
    char *json = scene_json(&drawing);
    if (!json) return 1;

    int status = in_child(&drawing, json, 0);
    if (status == 0 && !options.check_only) {
        printf("\nbunny, %u triangles, unlit smooth colours, both sides, %dx%d; medians of %d rounds, ms\n",
               drawing_triangles(&drawing), WIDTH, HEIGHT, ROUNDS);
        printf("%7s %10s %10s %9s %10s %9s %9s %9s %9s %9s\n", "threads", "llvmpipe", "zr_render", "ratio", "over HTTP",
               "ratio", "parse", "encode", "in all", "foreseen");
        const int threads[] = {1, 2};
        for (size_t i = 0; i < sizeof threads / sizeof *threads && status == 0; i++)
            status = in_child(&drawing, json, threads[i]);
        printf(
            "llvmpipe: clear, draw, finish. zr_render: the same into RGBA8, float depth and face ids. over HTTP: the\n"
            "daemon's render step; in all: a POST of %.1f MB of JSON and an answer of PNG and NPY in a ZIP; foreseen: "
            "what\n"
            "the daemon expected render and encode to take on one thread, over what they took.\n",
            (double)strlen(json) / 1e6);
    }
    free(json);
    drawing_free(&drawing);
    return status;
}
