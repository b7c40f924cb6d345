/* The daemon as the camera of a physics simulator, against llvmpipe in the simulator's own process. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "bench/http/service.h"
#include "bench/http/wire.h"
#include "bench/machine.h"
#include "bench/series.h"
#include "bench/shaded.h"
#include "bench/simulator_scene.h"
#include "bench/versus/likeness.h"
#include "core.h"
#include "render_request.h"
#include "scene/output.h"
#include "server/support/daemon.h"

enum { OURS, PARSE, RENDER, ENCODE, THEIRS, TIMES };
enum { AT_MOST_MS = 5, PIXELS = SIMULATOR_WINDOW * SIMULATOR_WINDOW };

/* So far colours may be apart where it is timed, and llvmpipe samples textures in bytes; else they are equal. */
enum { STEPS = 2, ONE_IN = 100 };

static const size_t ARENA_BYTES = (size_t)1 << 30;

struct task {
    struct document document;
    bool wrong[BENCH_CHECKS_MAX];
};

static void name_row(char *name, size_t size)
{
    snprintf(name, size, "HTTP: colour, depth, ids of %d objects, %dx%d 1T %s", SIMULATOR_OBJECTS, SIMULATOR_WINDOW,
             SIMULATOR_WINDOW, machine_isa_name());
}

/* ---- both sides ---- */

struct cameras {
    const struct document *document;
    struct zr_arena arena;
    const struct zr_scene *scene; /* read from the document */
    struct wire wire;
    struct shaded theirs;
    uint8_t rgba[4 * PIXELS];
    float depth[PIXELS];
    uint32_t ids[PIXELS];
};

static bool open_cameras(struct cameras *c, const struct document *document, bool exact, unsigned port)
{
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .bytes = document->bytes, .size = document->size};
    const struct zr_limits limits = zr_limits_default();
    struct zr_error error = {.status = ZR_OK};
    c->document = document;
    zr_arena_init(&c->arena, ARENA_BYTES);
    if (zr_scene_read(&(struct zr_run){.arena = &c->arena, .error = &error}, &request, &limits, &c->scene) != ZR_OK)
        return bench_complain("the scene: %s", error.count ? error.items[0].detail : "is not read");
    return wire_open(&c->wire, port) && shaded_open(&c->theirs, exact, 1) && shaded_take(&c->theirs, c->scene);
}

static bool ask(struct cameras *c, struct wire_answer *answer)
{
    return (wire_ask(&c->wire, "POST", "/v1/render", c->document->bytes, c->document->size, answer) &&
            answer->status == 200) ||
           bench_complain("the daemon answered %d: %.*s", answer->status, (int)answer->size, answer->body);
}

/* Window depth becomes depth, as ours is. */
static void make_metric(const zr_mat4 *projection, float *depth)
{
    const float a = projection->m[10], b = projection->m[14];
    for (int i = 0; i < PIXELS; i++)
        depth[i] = depth[i] < 1.0f ? b / (2.0f * depth[i] - 1.0f + a) : INFINITY;
}

/* Colour and depth, then ids. */
static bool draw_theirs(struct cameras *c)
{
    struct reference_error error = {""};
    struct reference *reference = c->theirs.reference;
    if (!shaded_draw(&c->theirs)) return false;
    if (!reference_read(reference, c->rgba, c->depth, &error)) return bench_complain("llvmpipe: %s", error.text);
    make_metric(&c->theirs.camera.projection, c->depth);
    if (!shaded_draw_ids(&c->theirs)) return false;
    return reference_read(reference, (uint8_t *)c->ids, NULL, &error) || bench_complain("llvmpipe: %s", error.text);
}

/* ---- is it the same? ---- */

static const struct zr_frame *render(struct cameras *c, const struct zr_scene *scene)
{
    struct zr_error error = {.status = ZR_OK};
    const struct zr_frame *frame = NULL;
    return zr_render(&(struct zr_run){.arena = &c->arena, .error = &error}, scene, NULL, &frame) == ZR_OK ? frame
                                                                                                          : NULL;
}

/* With what is compared beside. */
static const struct zr_frame *render_all(struct cameras *c)
{
    static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_COLOR, .encoding = ZR_ENCODING_PNG},
                                               {.channel = ZR_CHANNEL_DEPTH, .encoding = ZR_ENCODING_NPY},
                                               {.channel = ZR_CHANNEL_WINDOW_DEPTH, .encoding = ZR_ENCODING_NPY},
                                               {.channel = ZR_CHANNEL_INSTANCE_ID, .encoding = ZR_ENCODING_NPY}};
    struct zr_scene scene = *c->scene;
    scene.views[0].outputs = outputs;
    scene.views[0].output_count = sizeof outputs / sizeof *outputs;
    return render(c, &scene);
}

/* Whether the daemon's answer is what the renderer makes of the same scene. */
static bool is_answer_ours(struct cameras *c)
{
    struct zr_error error = {.status = ZR_OK};
    struct zr_answer want;
    struct wire_answer got = {0};
    const struct zr_frame *frame = render(c, c->scene);
    return frame && zr_encode(&(struct zr_run){.arena = &c->arena, .error = &error}, c->scene, frame, &want) == ZR_OK &&
           ask(c, &got) && got.size == want.size && memcmp(got.body, want.bytes, want.size) == 0;
}

/* Depths that are more than a thousandth off, or ids that differ. */
static size_t count_others(const struct cameras *c, const struct zr_frame *frame)
{
    const uint32_t *ids = frame->channels[ZR_CHANNEL_INSTANCE_ID];
    size_t others = 0;
    for (int i = 0; i < PIXELS; i++)
        others += ids[i] != c->ids[i] ||
                  !(c->depth[i] == frame->depth[i] || fabsf(c->depth[i] - frame->depth[i]) < 1e-3f * frame->depth[i]);
    return others;
}

static bool compare(const struct bench *bench, void *context, const struct sink *sink)
{
    (void)bench;
    static struct cameras cameras = {.wire.fd = -1};
    const struct task *task = context;
    struct likeness likeness;
    struct row row = {.work = ""};
    struct daemon daemon = daemon_start((const char *const[]){"--workers=1", "--threads=1", NULL});
    bool ok = open_cameras(&cameras, &task->document, true, daemon.port);
    const bool is_ours = ok && is_answer_ours(&cameras);
    daemon_stop(&daemon);
    const struct zr_frame *frame = ok ? render_all(&cameras) : NULL;
    ok = frame && shaded_draw(&cameras.theirs) && likeness_find(frame, cameras.theirs.reference, 0, &likeness) &&
         draw_theirs(&cameras);
    if (!ok) return false;
    const size_t others = count_others(&cameras, frame);
    row.wrong = !is_ours || likeness.off > 0 || likeness.deep > 0 || others > 0 || likeness.seen == 0;
    name_row(row.work, sizeof row.work);
    snprintf(row.note, sizeof row.note, "of %zu pixels %zu, %zu, %zu differ in colour, depth, ids%s", likeness.seen,
             likeness.off, likeness.deep, others, is_ours ? "" : "; other bytes");
    sink_row(sink, &row);
    wire_close(&cameras.wire);
    return true;
}

/* ---- is it fast? ---- */

static bool run_round(void *context, struct series *series)
{
    static const char *const steps[] = {[PARSE] = "parse", [RENDER] = "render", [ENCODE] = "encode"};
    struct cameras *c = context;
    struct wire_answer answer = {0};
    double begin = now_ms();
    if (!draw_theirs(c)) return false;
    series_add(&series[THEIRS], now_ms() - begin);
    begin = now_ms();
    if (!ask(c, &answer)) return false;
    series_add(&series[OURS], now_ms() - begin);
    for (int i = PARSE; i <= ENCODE; i++)
        series_add(&series[i], wire_step_ms(&answer, steps[i]));
    return true;
}

/* What is timed is not what was compared to the last bit. */
static bool is_alike(struct cameras *c)
{
    struct likeness likeness;
    const struct zr_frame *frame = render_all(c);
    return frame && shaded_draw(&c->theirs) && likeness_find(frame, c->theirs.reference, STEPS, &likeness) &&
           likeness.off <= likeness.seen / ONE_IN;
}

static bool measure(const struct bench *bench, void *context, const struct sink *sink)
{
    static struct series series[TIMES];
    static struct cameras cameras = {.wire.fd = -1};
    const struct task *task = context;
    struct daemon daemon = daemon_start((const char *const[]){"--workers=1", "--threads=1", NULL});
    const bool ok = open_cameras(&cameras, &task->document, false, daemon.port) &&
                    series_run(series, TIMES, bench->rounds, run_round, &cameras);
    wire_close(&cameras.wire);
    daemon_stop(&daemon);
    if (!ok) return false;
    struct row row = {.ours_ms = series_median(&series[OURS]),
                      .theirs_ms = series_median(&series[THEIRS]),
                      .wrong = task->wrong[0] || !is_alike(&cameras)};
    snprintf(row.note, sizeof row.note, "%s %d ms: parse %.2f, render %.2f, encode %.2f; body %zu KB",
             row.ours_ms <= AT_MOST_MS ? "within" : "OVER", AT_MOST_MS, series_median(&series[PARSE]),
             series_median(&series[RENDER]), series_median(&series[ENCODE]), task->document.size / 1000);
    name_row(row.work, sizeof row.work);
    sink_row(sink, &row);
    return true;
}

void service_for_simulator(struct bench *bench)
{
    static struct task task;
    char name[ROW_NAME_SIZE];
    name_row(name, sizeof name);
    if (!bench_wants(bench, name)) return;
    task.document = simulator_scene_make();
    if (!task.document.bytes) bench->results.failed = true;
    if (task.document.bytes) bench_check_in_child(bench, compare, &task, task.wrong);
    if (task.document.bytes && !bench->check_only) {
        results_begin_table(
            &bench->results,
            "a simulator's camera, 5 ms at most: \"theirs\" is llvmpipe alone, with arrays and textures "
            "that it has already");
        bench_in_child(bench, measure, &task, NULL);
    }
    free(task.document.bytes);
}
